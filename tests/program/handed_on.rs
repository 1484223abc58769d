//! Designs handed on to other programs: the frame model and back, the deck for OpenSees, the workbook of SAF, the drawing.

use assert_cmd::Command;
use calamine::{Data, Reader, Xlsx};
use quadrille::output::frame_model::frame_model;
use quadrille::output::handed::Handed;
use quadrille::output::opensees::opensees;
use quadrille::output::saf::saf;
use quadrille::structure::model::{
    EndJoint, Joint, LoadCase, Material, Member, MemberKind, NodalLoad, PressureLoad, Settlement, Support,
    TemperatureLoad, UniformLoad,
};
use quadrille::structure::params::LoadParams;
use quadrille::structure::section::Section;
use quadrille::structure::{
    FrameAnalysis, FrameModel, FrameParts, FrameResult, Order, combined, file, frame,
};
use serde_json::Value;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

fn quadrille(arguments: &[&str]) -> Vec<u8> {
    let mut command = Command::cargo_bin("quadrille").unwrap();
    let output = command.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// The small run, analysed in first or second order, as exactly as `frame` does; made once.
fn run(order: u8) -> &'static Path {
    static RUNS: [OnceLock<PathBuf>; 2] = [OnceLock::new(), OnceLock::new()];
    RUNS[usize::from(order) - 1].get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("handed_on_{order}"));
        let order = format!("structure.order={order}");
        let sets = ["--set", &order, "--set", "structure.second_order_tolerance=1e-12"];
        let out = ["--generations", "0", "--quiet", "--force", "--out", folder.to_str().unwrap()];
        quadrille(&[&["run", "configs/ci.toml"], &sets[..], &out].concat());
        folder
    })
}

/// Rows of a table by column.
fn row(table: PathBuf, wanted: impl Fn(&csv::StringRecord) -> bool) -> impl Fn(&str) -> String {
    let mut reader = csv::Reader::from_path(&table).unwrap();
    let header = reader.headers().unwrap().clone();
    let record = reader.records().map(Result::unwrap).find(wanted).unwrap();
    move |column| record[header.iter().position(|name| name == column).unwrap()].to_owned()
}

/// The initial mesh: id, and its numbers.
fn initial(order: u8) -> (String, impl Fn(&str) -> f64) {
    let cell = row(run(order).join("history.csv"), |record| record[1].is_empty());
    (cell("id"), move |column: &str| cell(column).parse().unwrap())
}

fn export(order: u8, format: &str, more: &[&str]) -> Vec<u8> {
    let (id, _) = initial(order);
    let folder = run(order).to_str().unwrap();
    quadrille(&[&["export", folder, "--design", &id, "--format", format], more].concat())
}

/// Tables hold ten digits.
fn close(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() <= 1e-9 * a.abs().max(b.abs()), "{what}: {a} {b}");
}

#[test]
fn frame_gives_the_numbers_of_the_design_whose_model_was_exported() {
    for order in [1, 2] {
        let (_, own) = initial(order);
        let folder = tempfile::tempdir().unwrap();
        let answer = |combination: &str| -> Value {
            let model = folder.path().join(format!("{combination}.json"));
            std::fs::write(&model, export(order, "frame", &["--combination", combination])).unwrap();
            let answer = quadrille(&["frame", model.to_str().unwrap(), "--format", "json"]);
            serde_json::from_slice(&answer).unwrap()
        };
        let (sls, uls) = (answer("sls"), answer("uls"));
        let number = |answer: &Value, key: &str| answer[key].as_f64().unwrap();
        close(number(&sls, "max_displacement"), own("deflection_m"), "deflection");
        close(number(&uls, "utilisation"), own("utilisation_all"), "utilisation");
        close(number(&uls, "utilisation_von_mises"), own("utilisation_von_mises"), "von Mises");
        close(uls["buckling_factors"][0].as_f64().unwrap(), own("buckling_factor"), "buckling");
    }
}

/// What a deck says, read line by line: a model and its loads, by the words of OpenSees' manual.
fn model_of(deck: &str) -> FrameModel {
    let (mut nodes, mut members, mut ups, mut supports) = (vec![], vec![], vec![], vec![]);
    let (mut nodal, mut on_members, mut properties) = (vec![], vec![], [0.0; 6]);
    for line in deck.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |k: usize| words[k].parse::<f64>().unwrap();
        let tag = |k: usize| words[k].parse::<u32>().unwrap() - 1;
        match words[0] {
            "node" => nodes.push([number(2), number(3), number(4)]),
            "fix" => supports.push(Support::fixed(tag(1), std::array::from_fn(|d| number(2 + d) == 1.0))),
            "geomTransf" => ups.push([number(3), number(4), number(5)]),
            "element" => {
                properties = std::array::from_fn(|p| number(5 + p));
                members.push(Member {
                    start: tag(3),
                    end: tag(4),
                    up: ups[tag(11) as usize],
                    section: 0,
                    kind: MemberKind::RIGID,
                });
            }
            "load" => nodal.push(NodalLoad { node: tag(1), load: std::array::from_fn(|d| number(2 + d)) }),
            "eleLoad" => on_members.push((tag(2), [number(5), number(6), number(7)])),
            _ => {}
        }
    }
    let [area, e, g, j, iy, iz] = properties;
    let mut parts = FrameParts {
        nodes,
        members,
        sections: vec![Section {
            area,
            iy,
            iz,
            j,
            wy: 0.0,
            wz: 0.0,
            asy: 0.0,
            asz: 0.0,
            shear: None,
            shape: None,
        }],
        material: Material {
            youngs_modulus: e,
            shear_modulus: g,
            density: 0.0,
            strength: 1.0,
            thermal_expansion: 0.0,
        },
        shear_deformation: false,
        supports,
        load_cases: vec![],
    };
    // Loads on members are in their own axes: across, up, along.
    let axes = FrameModel::new(parts.clone()).unwrap().axes().to_vec();
    let uniform = on_members.into_iter().map(|(member, [across, up, along])| {
        let own = axes[member as usize];
        let force = own.y * across + own.z * up + own.x * along;
        UniformLoad { member, force_per_length: [force.x, force.y, force.z] }
    });
    parts.load_cases = vec![LoadCase { nodal, uniform: uniform.collect(), ..LoadCase::default() }];
    FrameModel::new(parts).unwrap()
}

fn largest(result: &FrameResult, of: impl Fn(&quadrille::structure::forces::Resultants) -> f64) -> f64 {
    let ends = result.member_forces.iter().flat_map(|forces| [&forces.start, &forces.end]);
    ends.map(|end| of(end).abs()).fold(0.0, f64::max)
}

/// The deck of this design was run in OpenSees 3.7.1 (`tests/opensees/run.py`, openseespy 3.7.1.2), which gave the numbers below.
#[test]
fn the_deck_says_what_opensees_was_told() {
    let deck = String::from_utf8(export(1, "opensees", &["--combination", "uls"])).unwrap();
    let known = [
        "#",
        "wipe",
        "model",
        "node",
        "fix",
        "geomTransf",
        "element",
        "timeSeries",
        "pattern",
        "load",
        "eleLoad",
        "}",
    ];
    let analysis = [
        "constraints",
        "numberer",
        "system",
        "test",
        "algorithm",
        "integrator",
        "analysis",
        "recorder",
        "analyze",
    ];
    for line in deck.lines() {
        let first = line.split_whitespace().next().unwrap();
        assert!(known.contains(&first) || analysis.contains(&first), "{line}");
        assert!(line.starts_with('#') || !line.contains(['$', '[', ';', '"']), "a plain command: {line}");
    }
    let result = frame(&model_of(&deck), &FrameAnalysis { order: Order::First, buckling_modes: 0 }).unwrap();
    close(result.max_displacement.0, 0.13482381826482143, "largest displacement, m");
    let corner = result.reactions[0].1.map(Option::unwrap_or_default);
    close(corner[0], 391_918.49260457925, "reaction of node 1, N");
    close(corner[2], 251_011.42319609958, "reaction of node 1, N");
    close(largest(&result, |end| end.n), 366_941.75597964425, "axial force at an end, N");
    close(largest(&result, |end| end.my), 20_958.85108534765, "moment about y at an end, Nm");
    close(largest(&result, |end| end.mz), 70_638.03266277311, "moment about z at an end, Nm");
    let second = String::from_utf8(export(2, "opensees", &["--combination", "uls"])).unwrap();
    assert!(second.contains("\ngeomTransf PDelta 1 ") && second.contains("\nalgorithm Newton\n"));
}

/// A bent frame with all that a model can have: two sections, a hinge and springs at members' ends, a truss, a spring support, a support
/// that settles, a warm member, pressure and a load on a member.
///
/// ```text
///      1────2────3      0, 4: fixed (4 settles 5 mm);  2: held by a spring in z;  5: pinned
///      │         │╲     0–1: spring 25 EI/L about y, hinge about z at its end;  3–5: truss
///      0         4  5
/// ```
fn everything() -> FrameModel {
    let beam = |start, end, section, up| Member { start, end, up, section, kind: MemberKind::RIGID };
    let joint = EndJoint { torsion: Joint::Rigid, bending_y: Joint::Relative(25.0), bending_z: Joint::HINGE };
    let mut members = vec![
        beam(0, 1, 0, [1.0, 0.0, 0.0]),
        beam(1, 2, 1, [0.0, 0.0, 1.0]),
        beam(2, 3, 1, [0.0, 0.0, 1.0]),
        beam(3, 4, 0, [1.0, 0.0, 0.0]),
        beam(3, 5, 1, [0.0, 1.0, 1.0]),
    ];
    members[0].kind = MemberKind::Beam([EndJoint::RIGID, joint]);
    members[1].kind = MemberKind::Beam([EndJoint { bending_y: Joint::Absolute(4e6), ..EndJoint::RIGID }; 2]);
    members[4].kind = MemberKind::Truss;
    let spring = Support { node: 2, fixed: [false; 6], stiffness: [0.0, 3e5, 2e6, 0.0, 0.0, 0.0] };
    let pinned = Support::fixed(5, [true, true, true, false, false, false]);
    let case = LoadCase {
        nodal: vec![NodalLoad { node: 2, load: [3e3, 5e3, -4e4, 0.0, 2e3, 1e3] }],
        uniform: vec![UniformLoad { member: 1, force_per_length: [0.0, 800.0, -6e3] }],
        gravity: 9.81,
        pressure: vec![PressureLoad { member: 3, force_per_length: 2e3 }],
        temperature: vec![TemperatureLoad { member: 2, kelvin: 25.0 }],
        settlements: vec![Settlement { node: 4, displacement: [0.0, 0.0, -5e-3, 0.0, 0.0, 0.0] }],
    };
    let parts = FrameParts {
        nodes: vec![
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 4.0],
            [3.0, 0.5, 4.6],
            [6.0, 0.0, 4.0],
            [6.0, 0.0, 0.0],
            [9.0, 1.0, 0.0],
        ],
        members,
        sections: vec![
            Section::rectangular_hollow(0.15, 0.25, 0.01).unwrap(),
            Section::tube(0.2, 0.008).unwrap(),
        ],
        material: Material {
            youngs_modulus: 210e9,
            shear_modulus: 81e9,
            density: 7850.0,
            strength: 355e6,
            thermal_expansion: 1.2e-5,
        },
        shear_deformation: false,
        supports: vec![Support::fixed(0, [true; 6]), Support::fixed(4, [true; 6]), spring, pinned],
        load_cases: vec![case],
    };
    FrameModel::new(parts).unwrap()
}

fn handed(model: &FrameModel) -> Handed<'_> {
    static LOAD: LoadParams = LoadParams::Gravity { g_m_s2: 9.81 };
    Handed {
        id: "q1",
        model,
        cases: vec![("all", &LOAD)],
        combinations: vec![("twice", vec![(0, 2.0)])],
        order: 1,
    }
}

#[test]
fn the_frame_model_says_everything_that_a_model_can_have() {
    let model = everything();
    let design = handed(&model);
    let analysis = FrameAnalysis { order: Order::First, buckling_modes: 1 };
    let own = combined(&model, &[(0, 2.0)], &analysis).unwrap();
    let bytes = frame_model(&design, ("twice", &[(0, 2.0)])).unwrap();
    let (again, asked) = file::read(std::str::from_utf8(&bytes).unwrap()).unwrap();
    assert_eq!(asked, analysis);
    let again = frame(&again, &asked).unwrap();
    let largest = own.max_displacement.0;
    for (a, b) in own.displacements.iter().flatten().zip(again.displacements.iter().flatten()) {
        assert!((a - b).abs() <= 1e-12 * largest, "{a} {b}");
    }
    close(own.utilisation().unwrap().0, again.utilisation().unwrap().0, "utilisation");
    close(own.buckling_factors[0], again.buckling_factors[0], "buckling");
}

/// The deck of this model in OpenSees 3.7.1 gives the displacements below, m. The joint that is rigid about one axis alone is a stiff spring
/// there, of 10⁷ times the member's stiffness: hence the tolerance.
#[test]
fn the_deck_says_everything_that_a_model_can_have() {
    let model = everything();
    let deck = opensees(&handed(&model), ("twice", &[(0, 2.0)]), "q1_twice");
    if let Ok(folder) = std::env::var("QUADRILLE_WRITE_DECK") {
        std::fs::write(Path::new(&folder).join("everything.tcl"), &deck).unwrap();
    }
    let deck = String::from_utf8(deck).unwrap();
    for said in [
        "\nconstraints Transformation\n",
        "\nsp 5 3 -0.01\n",
        "\nfix 5 1 1 0 1 1 1\n",
        "\nequalDOF 2 8 1 2 3\n",
        "element Truss 5 4 6 ",
        "-dir 2 3\n",
    ] {
        assert!(deck.contains(said), "{said:?} in\n{deck}");
    }
    let own =
        combined(&model, &[(0, 2.0)], &FrameAnalysis { order: Order::First, buckling_modes: 0 }).unwrap();
    for (node, theirs) in THEIRS {
        for (a, b) in own.displacements[node].iter().zip(theirs) {
            assert!((a - b).abs() <= 1e-6 * own.max_displacement.0, "node {node}: {a} {b}");
        }
    }
}

const THEIRS: [(usize, [f64; 3]); 4] = [
    (1, [-0.01937393811023589, 0.013306534266410878, -0.00011016490956966557]),
    (2, [-0.015772888820129744, 0.028545273912382887, -0.031258246081912834]),
    (3, [-0.01391508904010541, 0.0032157672038287794, -0.009955788487766197]),
    (4, [0.0, 0.0, -0.01]),
];

/// Sheets and headers of SAF 2.2.0 that it requires.
#[test]
fn the_workbook_has_the_sheets_and_columns_of_saf() {
    let bytes = export(1, "saf", &[]);
    assert_eq!(bytes, export(1, "saf", &[]), "nothing in it tells when it was made");
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).unwrap();
    let mut sheet = |name: &str| -> Vec<Vec<Data>> {
        book.worksheet_range(name).unwrap().rows().map(<[Data]>::to_vec).collect()
    };
    let model = sheet("Model");
    let said = |key: &str| model.iter().find(|row| row[0] == *key).map(|row| row[1].to_string()).unwrap();
    assert_eq!(["Global coordinate system", "System of units"].map(said), ["Z vertical", "Metric"]);
    assert_eq!(said("LCS of cross-section"), "ZYX");
    let (_, own) = initial(1);
    for (name, required, rows) in [
        ("StructuralMaterial", &["Name", "Type", "Quality", "E modulus [MPa]"][..], 1),
        (
            "StructuralCrossSection",
            &["Name", "Material", "Cross-section type", "Shape", "Parameters [mm]"],
            1,
        ),
        (
            "StructuralPointConnection",
            &["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"],
            own("nodes") as usize,
        ),
        (
            "StructuralCurveMember",
            &[
                "Name",
                "Cross section",
                "Nodes",
                "Segments",
                "LCS",
                "LCS Rotation [deg]",
                "System line",
                "Behaviour in analysis",
            ],
            own("members") as usize,
        ),
        (
            "StructuralPointSupport",
            &["Name", "Boundary condition", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz"],
            4,
        ),
        ("StructuralLoadGroup", &["Name", "Load group type", "Relation", "Load type"], 2),
        ("StructuralLoadCase", &["Name", "Action type", "Load group", "Load type"], 3),
        (
            "StructuralLoadCombination",
            &["Name", "Category", "Load factor 3", "Multiplier 3", "Load case name 3"],
            2,
        ),
        (
            "StructuralPointAction",
            &[
                "Name",
                "Direction",
                "Force action",
                "Reference node",
                "Value [kN]",
                "Load case",
                "Coordinate system",
            ],
            2 * own("nodes") as usize,
        ),
    ] {
        let found = sheet(name);
        for column in required {
            assert!(found[0].iter().any(|cell| cell == *column), "{name} has no {column}");
        }
        assert_eq!(found.len() - 1, rows, "{name}");
    }
    // 200 × 120 × 12 mm, and the whole load of glass: 0.6 kN/m² on the area of the panels.
    assert_eq!(sheet("StructuralCrossSection")[1][4], "200; 120; 12; 0; 0");
    let actions = sheet("StructuralPointAction");
    let column = |name: &str| actions[0].iter().position(|cell| cell == name).unwrap();
    let (value, case) = (column("Value [kN]"), column("Load case"));
    let glass = actions.iter().filter(|row| row[case] == "glass").map(|row| match row[value] {
        Data::Float(kilonewton) => kilonewton,
        ref other => panic!("{other}: a number that is none"),
    });
    close(glass.sum::<f64>(), -0.6 * own("panel_area_mean_m2") * own("faces"), "sum of the loads");
    // What the receiving program weighs itself.
    let cases = sheet("StructuralLoadCase");
    assert!(cases.iter().any(|row| row[0] == "self_weight" && row[4] == "Self weight"));
}

#[test]
fn the_workbook_says_everything_that_a_model_can_have() {
    let model = everything();
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(saf(&handed(&model)).unwrap())).unwrap();
    let mut sheet = |name: &str| -> Vec<Vec<String>> {
        let range = book.worksheet_range(name).unwrap();
        range.rows().skip(1).map(|row| row.iter().map(ToString::to_string).collect()).collect()
    };
    let hinges = sheet("RelConnectsStructuralMember");
    assert_eq!(hinges.len(), 3);
    assert_eq!(hinges[0][1..9], ["B0", "End", "Rigid", "Rigid", "Rigid", "Rigid", "Flexible", "Free"]);
    // 4 MNm/rad about y.
    assert_eq!((hinges[1][7].as_str(), hinges[1][13].as_str()), ("Flexible", "4"));
    let support = sheet("StructuralPointSupport").into_iter().find(|row| row[3] == "N2").unwrap();
    assert_eq!(support[4..7], ["Free", "Flexible", "Flexible"]);
    assert_eq!(support[11..13], ["0.3", "2"], "MN/m");
    assert_eq!(sheet("StructuralCurveMember")[4][17], "Axial force only");
    assert_eq!(sheet("StructuralCurveActionThermal")[0][3..6], ["25", "B2", "all"]);
    assert_eq!(sheet("StructuralPointSupportDef")[0][1..4], ["S4", "Z", "-5"], "mm");
    assert_eq!(sheet("StructuralPointMoment").len(), 2);
    assert_eq!(sheet("StructuralCurveAction").len(), 5, "weight of each member, with what else acts on it");
    assert_eq!(sheet("StructuralPointAction")[0][6], "(3;5;-40)", "kN");
    assert_eq!(sheet("StructuralCrossSection")[1][3..5], ["Pipe", "200; 8"]);
}

#[test]
fn the_drawing_has_every_member_and_panel() {
    let (_, own) = initial(1);
    let text = String::from_utf8(export(1, "dxf", &[])).unwrap();
    let count = |kind: &str| text.matches(&format!("  0\n{kind}\n")).count();
    assert_eq!(count("LINE"), own("members") as usize);
    assert_eq!(count("3DFACE"), own("faces") as usize);
    assert_eq!(count("POINT"), 4);
    let dual = String::from_utf8(export(1, "dxf", &["--pattern", "dual"])).unwrap();
    assert!(dual.contains("  8\nPANELS\n") && dual.ends_with("  0\nEOF\n"));
}

#[test]
fn combinations_that_are_none_are_refused() {
    let (id, _) = initial(1);
    let refused = |more: &[&str]| {
        let mut command = Command::cargo_bin("quadrille").unwrap();
        let output = command.arg("export").arg(run(1)).args(["--design", &id]).args(more).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8(output.stderr).unwrap()
    };
    let told = refused(&["--format", "frame", "--combination", "als"]);
    assert!(told.contains("--combination als: there is none of that name; allowed: sls, uls"), "{told}");
    let told = refused(&["--format", "opensees"]);
    assert!(told.contains("are several files; give --out DIR"), "{told}");
    let told = refused(&["--format", "obj", "--combination", "uls"]);
    assert!(told.contains("--combination is for --format frame and opensees"), "{told}");
    let told = refused(&["--format", "saf", "--pattern", "dual"]);
    assert!(told.contains("leave --pattern out"), "{told}");
}
