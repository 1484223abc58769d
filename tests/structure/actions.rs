//! Loads, supports and joints of a config on patterns: sums by hand, mirror images, places that are told.

use crate::support::{dome, grid_shell};
use quadrille::geometry::Pattern;
use quadrille::structure::gridshell::{Detailed, GridshellModel, Proof};
use quadrille::structure::model::Direction;
use quadrille::structure::params::{StructureParams, SupportParams, SupportPlace};
use quadrille::structure::{AnalysisError, analyse, analyse_detailed};

const SIDE: f64 = 24.0;

/// One load case, `load`, alone on a roof with its boundary held every way.
fn params(load: &str) -> StructureParams {
    let text = format!(
        "order = 1\nheight = {{ fixed_m = 0.2 }}\nrequirement = []\n[loads]\nload = {load}\n[combinations.only]\nload = 1.0\n\
         [[support]]\nat = \"boundary\"\nfixed = [\"ux\", \"uy\", \"uz\"]\n"
    );
    toml::from_str(&text).unwrap()
}

fn detailed(pattern: &Pattern, params: &StructureParams) -> Detailed {
    analyse_detailed(pattern, params, Proof::None).unwrap()
}

/// What all supports together do to the structure, N.
fn reaction(found: &Detailed) -> [f64; 3] {
    let all = found.combinations[0].reactions.iter();
    all.fold([0.0; 3], |sum, (_, r)| std::array::from_fn(|d| sum[d] + r[d].unwrap_or(0.0)))
}

fn close(found: f64, expected: f64, scale: f64) {
    assert!((found - expected).abs() < 1e-8 * scale, "{found} instead of {expected}");
}

/// Snow on the half x > 0 of a square plan, whose grid has a line along x = 0: half of q a², and its moment about the
/// y axis is q a²/2 × a/4.
#[test]
fn half_span_snow() {
    let (q, pattern) = (750.0, dome(8, SIDE, 3.0));
    let whole = q * SIDE * SIDE;
    let found = detailed(&pattern, &params("{ kind = \"projected\", down_pa = 750, factor = \"x > 0\" }"));
    let [x, y, z] = reaction(&found);
    close(z, 0.5 * whole, whole);
    close(x, 0.0, whole);
    close(y, 0.0, whole);
    let loads = &found.model.frame.load_cases()[0].nodal;
    assert!(loads.iter().all(|l| pattern.positions[l.node as usize][0] > -1e-9), "none on the other half");
    // As much on a node of the ridge line as its panels on one side give.
    let moment: f64 = loads.iter().map(|l| pattern.positions[l.node as usize][0] * -l.load[2]).sum();
    let by_hand: f64 = panels(&pattern)
        .filter(|p| p.0[0] > 0.0)
        .map(|(_, shares, _)| {
            shares.iter().map(|(v, share)| q * share * pattern.positions[*v as usize][0]).sum::<f64>()
        })
        .sum();
    close(moment, by_hand, whole * SIDE);
}

/// Middle, plan area of each corner (its half of the two triangles about the middle, flattened), vector area, of each
/// panel: written down a second time.
fn panels(pattern: &Pattern) -> impl Iterator<Item = ([f64; 3], Vec<(u32, f64)>, [f64; 3])> + '_ {
    pattern.panels.iter().map(|panel| {
        let corners = panel.corners();
        let at = |i: usize| nalgebra::Vector3::from(pattern.positions[corners[i % 4] as usize]);
        let middle = (at(0) + at(1) + at(2) + at(3)) / 4.0;
        let cross = |i: usize| (at(i) - middle).cross(&(at(i + 1) - middle)) / 2.0;
        let area: f64 = (0..4).map(|i| cross(i).norm()).sum();
        let vector = cross(0) + cross(1) + cross(2) + cross(3);
        let share = |i: usize| vector.z * (cross((i + 3) % 4).norm() + cross(i).norm()) / (2.0 * area);
        (middle.into(), (0..4).map(|i| (corners[i], share(i))).collect(), vector.into())
    })
}

/// The two halves together are the whole, in every displacement: the answer is linear in first order.
#[test]
fn two_halves_are_the_whole() {
    let pattern = dome(6, SIDE, 3.0);
    let of = |factor: &str| {
        let load = format!("{{ kind = \"area\", down_pa = 600, factor = {factor} }}");
        detailed(&pattern, &params(&load)).combinations[0].displacements.clone()
    };
    let (left, right) = (of("\"x < 0\""), of("\"x > 0\""));
    let whole = detailed(&pattern, &params("{ kind = \"area\", down_pa = 600 }"));
    for (n, u) in whole.combinations[0].displacements.iter().enumerate() {
        (0..6).for_each(|d| assert!((left[n][d] + right[n][d] - u[d]).abs() < 1e-11, "node {n}"));
    }
    let table = of("{ expression = \"a * r\", constants = { a = 2.0 }, let = [[\"r\", \"(x < 0) / 2\"]] }");
    assert_eq!(table, left, "constants and names");
}

/// A pressure on a roof over a plane boundary has the resultant of one on its plan (Gauss): p a² downwards; a rising
/// roof under suction lifts.
#[test]
fn pressure_is_that_on_the_plan() {
    let pattern = dome(8, SIDE, 4.0);
    for p in [500.0, -800.0] {
        let found = detailed(&pattern, &params(&format!("{{ kind = \"pressure\", pressure_pa = {p} }}")));
        let [x, y, z] = reaction(&found);
        let whole = p * SIDE * SIDE;
        close(z, whole, whole.abs());
        close(x, 0.0, whole.abs());
        close(y, 0.0, whole.abs());
        assert_eq!(found.response.uplift_kn > 0.0, p < 0.0);
    }
    // Wind on the side that looks towards −x: −p Σ A over those panels.
    let wind = "{ kind = \"pressure\", pressure_pa = 500, factor = \"nx < 0\" }";
    let [x, _, z] = reaction(&detailed(&pattern, &params(wind)));
    let area =
        panels(&pattern).filter(|p| p.2[0] < 0.0).fold([0.0; 2], |a, p| [a[0] + p.2[0], a[1] + p.2[2]]);
    close(x, 500.0 * area[0], 500.0 * SIDE * SIDE);
    close(z, 500.0 * area[1], 500.0 * SIDE * SIDE);
    assert!(x < 0.0, "the supports hold against the wind, which blows along +x");
}

/// A warm dome held at its boundary rises; nothing pulls on the supports in sum; members are pressed, less than −EAα ΔT.
#[test]
fn a_warm_dome_rises() {
    let found = detailed(&dome(8, SIDE, 3.0), &params("{ kind = \"temperature\", kelvin = 30 }"));
    let most = 210e9 * found.model.frame.sections()[0].area * 1.2e-5 * 30.0;
    reaction(&found).iter().for_each(|r| close(*r, 0.0, most));
    let case = &found.combinations[0];
    let top = (4 * 9 + 4) as usize;
    assert!(case.displacements[top][2] > 0.01, "{:?}", case.displacements[top]);
    let least = case.member_forces.iter().map(|f| f.start.n).fold(0.0, f64::min);
    assert!(least < -0.02 * most && least > -most, "{least} {most}");
    // A flat one, held against shifts at its boundary alone, has all of it.
    let flat = detailed(
        &grid_shell([4, 4], [SIDE, SIDE], |_, _| 0.0),
        &params("{ kind = \"temperature\", kelvin = 30 }"),
    );
    flat.combinations[0]
        .member_forces
        .iter()
        .filter(|f| f.start.n != 0.0)
        .for_each(|f| close(f.start.n, -most, most));
}

#[test]
fn forces_at_points_go_to_the_nearest_node_and_are_told() {
    let pattern = dome(8, SIDE, 3.0);
    let load = "{ kind = \"point\", points_m = [[0.4, -0.3], [6.0, 6.0]], force_n = [0, 1000, -9000] }";
    let found = detailed(&pattern, &params(load));
    let [x, y, z] = reaction(&found);
    close(x, 0.0, 1e4);
    close(y, -2000.0, 1e4);
    close(z, 18_000.0, 1e4);
    let told = &found.model.found;
    assert_eq!(told.len(), 2);
    assert_eq!((told[0].key.as_str(), told[0].node), ("loads.load.points_m[0]", 4 * 9 + 4));
    assert!((told[0].distance - 0.5).abs() < 1e-12 && told[1].distance < 1e-9, "{told:?}");
}

/// A column under the middle, on springs.
#[test]
fn columns_inside() {
    let pattern = dome(8, SIDE, 3.0);
    let mut params = params("{ kind = \"area\", down_pa = 600 }");
    let sag = detailed(&pattern, &params).response.deflection_m;
    let column: SupportParams =
        toml::from_str("inside_near_m = [[0.5, 0.5]]\nstiffness = { uz_n_per_m = 2e6 }").unwrap();
    params.supports.push(column);
    let found = detailed(&pattern, &params);
    assert!(found.response.deflection_m < sag);
    let middle = 4 * 9 + 4;
    let (_, push) = found.combinations[0].reactions.iter().find(|(n, _)| n.0 == middle).unwrap();
    let w = found.combinations[0].displacements[middle as usize][2];
    close(push[2].unwrap(), -2e6 * w, 1e4);
    assert_eq!(push[0], None);
    assert_eq!(found.model.found[0].node, middle);
    // 1.5 m is half a target length.
    params.supports[1].inside_near_m = Some(vec![[1.5, 1.5]]);
    let far = analyse(&pattern, &params).unwrap_err();
    assert!(matches!(far, AnalysisError::NoColumn { .. }), "{far}");
    assert!(far.to_string().starts_with("structure.support[1].inside_near_m[0]: no node inside"), "{far}");
}

/// Joints of 25 and 8 EI/L make a roof softer, in that order, split members as whole ones; 1e12 EI/L is rigid.
#[test]
fn joints_of_the_config() {
    let pattern = dome(8, SIDE, 2.0);
    let of = |joints: &str, elements: &str| {
        let text =
            format!("order = 2\nheight = {{ fixed_m = 0.2 }}\nelements_per_member = {elements}\n{joints}");
        let params: StructureParams = toml::from_str(&text).unwrap();
        analyse(&pattern, &params).unwrap()
    };
    let spring =
        |k: &str| format!("[joints]\nbending_y = {{ ei_per_l = {k} }}\nbending_z = {{ ei_per_l = {k} }}\n");
    let rigid = of("", "1");
    let near = of(&spring("1e12"), "1");
    assert!((near.deflection_m / rigid.deflection_m - 1.0).abs() < 1e-6);
    assert!((near.buckling_factor / rigid.buckling_factor - 1.0).abs() < 1e-5);
    let (firm, soft) = (of(&spring("25"), "1"), of(&spring("8"), "1"));
    assert!(rigid.deflection_m < firm.deflection_m && firm.deflection_m < soft.deflection_m);
    assert!(rigid.buckling_factor > firm.buckling_factor && firm.buckling_factor > soft.buckling_factor);
    // In first order an element is exact, so that split members give the same but for their own weight between nodes.
    let split = of(&spring("8"), "3");
    assert!(
        (split.deflection_m / soft.deflection_m - 1.0).abs() < 2e-3,
        "{} {}",
        split.deflection_m,
        soft.deflection_m
    );
    let mut hinged: StructureParams = toml::from_str("[joints]\ntorsion = \"hinge\"").unwrap();
    assert_eq!(hinged.validate()[0].0, "joints.torsion");
    hinged = toml::from_str("[joints]\nbending_y = { gj_per_l = 3 }").unwrap();
    assert!(hinged.validate()[0].1.contains("ei_per_l"));
}

/// Supports that give way: as stiff as 1e15 N/m they do not, and softer ones slide further.
#[test]
fn spring_supports_of_the_config() {
    let pattern = dome(8, SIDE, 3.0);
    let mut params = params("{ kind = \"area\", down_pa = 600 }");
    let held = analyse(&pattern, &params).unwrap();
    let mut sag = held.deflection_m;
    for (k, stiffness) in [1e15, 1e8, 1e7].into_iter().enumerate() {
        let text = format!(
            "at = \"boundary\"\nfixed = [\"uz\"]\nstiffness = {{ ux_n_per_m = {stiffness}, uy_n_per_m = {stiffness} }}"
        );
        params.supports = vec![toml::from_str(&text).unwrap()];
        let found = analyse(&pattern, &params).unwrap();
        if k == 0 {
            assert!((found.deflection_m / sag - 1.0).abs() < 1e-6 && found.support_slide_m < 1e-9);
        } else {
            assert!(found.deflection_m > sag && found.support_slide_m > 1e-5, "{stiffness}");
        }
        sag = found.deflection_m;
    }
}

#[test]
fn what_cannot_be_is_told_by_key() {
    let of = |text: &str| {
        let params: StructureParams = toml::from_str(text).unwrap();
        params.validate().first().map(|(key, message)| format!("{key}: {message}")).unwrap_or_default()
    };
    for (text, expected) in [
        (
            "loads.snow = { kind = \"area\", down_pa = 1, factor = \"xx > 0\" }",
            "loads.snow.factor: expression, column 1",
        ),
        (
            "loads.snow = { kind = \"area\", down_pa = 1, factor = \"x >\" }",
            "loads.snow.factor: expression, column 4",
        ),
        ("loads.hot = { kind = \"temperature\", kelvin = nan }", "loads.hot.kelvin"),
        ("support = [{ at = \"all\" }]", "support[0].fixed: name at least one"),
        (
            "support = [{ at = \"all\", stiffness = { rx_nm_per_rad = -1 } }]",
            "support[0].stiffness.rx_nm_per_rad: -1 must be 0 or more",
        ),
        ("joints.bending_y = { nm_per_rad = -2 }", "joints.bending_y: nm_per_rad = -2 must be 0 or more"),
        ("material.thermal_expansion_per_k = inf", "material.thermal_expansion_per_k"),
    ] {
        let text = format!("combinations = {{ c = {{}} }}\nrequirement = []\n{text}");
        let found = of(&text);
        assert!(found.starts_with(expected), "{text}: {found}");
    }
    // A factor that is no number somewhere is an error of the design.
    let broken = params("{ kind = \"area\", down_pa = 1, factor = \"1 / (x > 100)\" }");
    let error = analyse(&dome(4, SIDE, 2.0), &broken).unwrap_err().to_string();
    assert!(error.contains("loads.load.factor") && error.contains("on the panel at"), "{error}");
    let free =
        SupportParams { at: Some(SupportPlace::All), fixed: vec![Direction::Uz], ..SupportParams::default() };
    assert_eq!(free.holds(), ([false, false, true, false, false, false], [0.0; 6]));
    assert!(GridshellModel::new(&dome(4, SIDE, 2.0), &broken, 0.2).is_err());
}
