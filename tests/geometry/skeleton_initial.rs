//! `topology.initial`: grids, files, meshes written out, and how they are fitted to the domain; symmetries of domains.

use quadrille::domain::{Domain, DomainParams, Symmetry};
use quadrille::io::Inputs;
use quadrille::mesh::{BaseMesh, InitialMesh};
use quadrille::skeleton;
use quadrille::skeleton::params::TopologyParams;
use quadrille::surface::{self, SurfaceParams};
use std::path::Path;

fn domain(text: &str, surface: &str) -> Domain {
    let params: DomainParams = toml::from_str(text).unwrap();
    let surface: SurfaceParams = toml::from_str(surface).unwrap();
    let surface = surface::build(&surface, &Inputs::default()).unwrap();
    Domain::resolve(&params, &surface, &Inputs::default()).unwrap()
}

fn initial(topology: &str, domain: &Domain) -> Result<BaseMesh, String> {
    let params: TopologyParams = toml::from_str(topology).map_err(|e| e.to_string())?;
    skeleton::initial(&params, domain, &Inputs::read(Path::new("tests/data/skeleton"), params.files()))
        .map_err(|e| e.to_string())
}

const SQUARE: &str = "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [6, 0], [6, 4], [0, 4]]\n";
const HOLES: &str = "[[loop]]\nkind = 'circle'\ncenter_m = [4.5, 2]\nradius_m = 0.5\n\
                     [[loop]]\nkind = 'circle'\ncenter_m = [1.5, 2]\nradius_m = 0.5\n";

#[test]
fn a_grid() {
    let square = domain(SQUARE, "kind = 'paraboloid'\nhalf_spans_m = [6, 4]\nrise_m = 1");
    let base = initial("initial = { grid = [3, 2] }", &square).unwrap();
    assert_eq!((base.vertices.len(), base.faces.len()), (12, 6));
    assert_eq!(base.corners, [[0], [3], [11], [8]]);
    assert_eq!(base.faces[0], [0, 1, 5, 4]);
    for &[x, y, z] in &base.vertices {
        assert!((z - square.height(x, y).unwrap()).abs() < 1e-12);
    }
    assert_eq!(
        initial("initial = { grid = [3, 2] }\nmarker = [4, 5]", &square).unwrap().marker,
        Some([4, 5])
    );
    let holed = domain(&format!("{SQUARE}{HOLES}"), "kind = 'plane'");
    for (topology, domain, part) in [
        ("initial = { grid = [0, 2] }", &square, "between 1 and 1000"),
        ("initial = { grid = [2, 2] }", &holed, "4 corners and 2 holes"),
        ("initial = { grid = [2, 2] }\nmarker = [0, 8]", &square, "marker"),
    ] {
        let error = initial(topology, domain).unwrap_err();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn files_in_three_formats_are_one_mesh() {
    let square = domain(SQUARE, "kind = 'plane'");
    let of = |file: &str| initial(&format!("initial = {{ file = 'files/{file}' }}"), &square).unwrap();
    let base = of("two.json");
    assert_eq!(base.corners, [[0], [2], [3], [5]]);
    for file in ["two_compas.json", "two_compas_old.json", "two.obj", "two_from_below.obj"] {
        let other = of(file);
        let code = |b: &BaseMesh| quadrille::mesh::code::code(&InitialMesh::from_base(b).unwrap().mesh, true);
        assert_eq!(code(&other), code(&base), "{file}");
        assert_eq!(other.corners, base.corners, "{file}");
    }
}

/// Loop labels follow vertex numbers (docs/reference/grammar.md §1.6): a file that numbers its holes otherwise than the domain is
/// renumbered.
#[test]
fn holes_take_the_order_of_the_domain() {
    let text = format!("{SQUARE}{HOLES}");
    let right_first = domain(&text, "kind = 'plane'");
    let base = skeleton::initial_mesh(&right_first).unwrap();
    let mut swapped = text.clone();
    swapped =
        swapped.replace("[4.5, 2]", "[9, 9]").replace("[1.5, 2]", "[4.5, 2]").replace("[9, 9]", "[1.5, 2]");
    let left_first = domain(&swapped, "kind = 'plane'");
    let inline = TopologyParams {
        initial: skeleton::params::InitialMesh::Inline {
            vertices: base.vertices.clone(),
            faces: base.faces.iter().map(|f| f.iter().map(|&v| v as usize).collect()).collect(),
            poles: Default::default(),
        },
        ..TopologyParams::default()
    };
    for domain in [right_first, left_first] {
        let fitted = skeleton::initial(&inline, &domain, &Inputs::default()).unwrap();
        let mesh = InitialMesh::from_base(&fitted).unwrap().mesh;
        for (label, darts) in mesh.loops().iter().enumerate() {
            for &d in darts {
                let p = fitted.vertices[mesh.origin(d).index()];
                let q = domain.loops[label].closest_point(p);
                assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e-9, "loop {label}");
            }
        }
    }
}

/// Three holes and all their orders, over a grid whose numbers say nothing of them: to renumber one vertex of each is not
/// enough, since its neighbours have small numbers too.
#[test]
fn three_holes_take_the_order_of_the_domain() {
    let number = |i: usize, j: usize| j * 8 + i;
    let cells = (0..21).map(|k| (k % 7, k / 7)).filter(|&(i, j)| j != 1 || ![1, 3, 5].contains(&i));
    let faces: Vec<Vec<usize>> = cells
        .map(|(i, j)| vec![number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)])
        .collect();
    let vertices: Vec<[f64; 3]> =
        (0..32).map(|k| [4.0 * f64::from(k % 8), 4.0 * f64::from(k / 8), 0.0]).collect();
    let inline = TopologyParams {
        initial: skeleton::params::InitialMesh::Inline { vertices, faces, poles: Default::default() },
        ..TopologyParams::default()
    };
    for order in [[6, 14, 22], [14, 22, 6], [22, 6, 14], [22, 14, 6], [14, 6, 22], [6, 22, 14]] {
        let outer = "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [28, 0], [28, 12], [0, 12]]\n";
        let hole = |x: &i32| format!("[[loop]]\nkind = 'circle'\ncenter_m = [{x}, 6]\nradius_m = 1.8\n");
        let holes: String = order.iter().map(hole).collect();
        let domain = domain(&format!("{outer}{holes}"), "kind = 'plane'");
        let fitted = skeleton::initial(&inline, &domain, &Inputs::default()).unwrap();
        let mesh = InitialMesh::from_base(&fitted).unwrap().mesh;
        for (darts, x) in mesh.loops()[1..].iter().zip(order) {
            let middle = darts.iter().map(|&d| fitted.vertices[mesh.origin(d).index()][0]).sum::<f64>() / 4.0;
            assert_eq!((darts.len(), middle), (4, f64::from(x)), "{order:?}");
        }
    }
}

#[test]
fn meshes_that_do_not_fit_are_refused() {
    let square = domain(SQUARE, "kind = 'plane'");
    let moved = domain(
        "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [6, 0], [6, 4.01], [0, 4]]",
        "kind = 'plane'",
    );
    let holed = domain(&format!("{SQUARE}{HOLES}"), "kind = 'plane'");
    for (topology, domain, part) in [
        (
            "initial = { file = 'files/two.obj' }",
            &moved,
            "corner 2 of the domain, at (6, 4.01), has no boundary vertex",
        ),
        ("initial = { file = 'files/two.obj' }", &holed, "1 boundary loops, the domain has 3"),
        ("initial = { file = 'files/none.obj' }", &square, "none.obj"),
        ("initial = { file = 'files/pentagon.obj' }", &square, "files/pentagon.obj:7: face 0 has 5 vertices"),
        (
            "initial = { vertices = [[0,0,0],[6,0,0],[6,4,0],[0,4,0]], faces = [[0,1,2,7]] }",
            &square,
            "vertex 7",
        ),
        (
            "initial = { vertices = [[0,0,0],[6,0,0],[6,4,0]], faces = [[0,1,2]], poles = { a = 0 } }",
            &square,
            "\"a\" is not a face",
        ),
        ("initial = { vertices = [[0,0,0],[6,0,0],[6,4,0]], faces = [[0,1,2]] }", &square, "without a pole"),
    ] {
        let error = initial(topology, domain).unwrap_err();
        assert!(error.contains(part), "{topology}\n{error}");
    }
}

#[test]
fn symmetries_carry_loops_and_corners() {
    let holed = domain(
        &format!("{SQUARE}{HOLES}"),
        "kind = 'paraboloid'\ncenter_m = [3, 2]\nhalf_spans_m = [6, 4]\nrise_m = 1",
    );
    let x = holed.symmetry(Symmetry::MirrorX).unwrap();
    assert_eq!((x.loops, x.corners, x.reversed), (vec![0, 2, 1], vec![1, 0, 3, 2], true));
    let y = holed.symmetry(Symmetry::MirrorY).unwrap();
    assert_eq!((y.loops, y.corners), (vec![0, 1, 2], vec![3, 2, 1, 0]));
    let turn = holed.symmetry(Symmetry::Rotate180).unwrap();
    assert_eq!((turn.loops, turn.corners, turn.reversed), (vec![0, 2, 1], vec![2, 3, 0, 1], false));
    // Two mirrors make the half turn.
    assert_eq!(holed.symmetries(&[Symmetry::MirrorX, Symmetry::MirrorY]).unwrap().len(), 3);
    assert_eq!(holed.symmetries(&[Symmetry::MirrorX]).unwrap().len(), 1);

    let court = "[[loop]]\nkind = 'polyline'\npoints_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]\n\
                 [[loop]]\nkind = 'circle'\ncenter_m = [0, 0]\nradius_m = 22.245\n";
    let court = domain(court, "kind = 'great-court'");
    assert!(court.symmetry(Symmetry::MirrorX).is_ok());
    let error = court.symmetry(Symmetry::MirrorY).unwrap_err().to_string();
    assert!(error.contains("`mirror-y`: loop 1 has no image"), "{error}");
    let tilted = domain(SQUARE, "kind = 'height'\nexpression = 'x'");
    assert!(tilted.symmetry(Symmetry::MirrorX).unwrap_err().to_string().contains("loop 0 has no image"));
    assert!(tilted.symmetry(Symmetry::MirrorY).is_ok());
    // Zero along the boundary, odd inside.
    let wave = domain(SQUARE, "kind = 'height'\nexpression = 'y * (4 - y) * sin(pi * x / 3)'");
    assert!(wave.symmetry(Symmetry::MirrorX).unwrap_err().to_string().contains("the surface is"));
    assert!(wave.symmetry(Symmetry::MirrorY).is_ok());
    let disc = domain("[[loop]]\nkind = 'circle'\ncenter_m = [0, 0]\nradius_m = 2", "kind = 'plane'");
    assert!(disc.symmetry(Symmetry::MirrorY).is_ok());
    assert!(disc.symmetry(Symmetry::MirrorX).unwrap_err().to_string().contains("mark"));
}
