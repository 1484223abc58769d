//! Meshes as surfaces: the upper skin counts, however faces are wound, ordered and layered (issue 15).

use quadrille::config::ResolvedConfig;
use quadrille::random::{below, stream, unit};
use quadrille::study::{Effort, Study};
use quadrille::surface::{MeshSurface, Surface};
use std::fs;
use std::path::Path;

type Mesh = (Vec<[f64; 3]>, Vec<Vec<u32>>);
type Height = Box<dyn Fn(f64, f64) -> f64>;

fn study(file: &Path, sets: &[String]) -> Study {
    let config = ResolvedConfig::open(file, sets).unwrap();
    Study::of(&config).unwrap()
}

/// Positions of the pattern of a string, and whether it keeps all limits.
fn pattern(study: &Study, string: &str) -> (Vec<[f64; 3]>, bool) {
    let tokens = string.parse().unwrap();
    let design = study.develop(study.topology(&tokens), Effort::Pattern).unwrap();
    let violation = study.evaluate_topology(study.topology(&tokens), Effort::Everything).violation;
    (design.pattern.positions, violation.is_feasible())
}

fn pyramid([x0, y0]: [f64; 2], half: f64, low: f64, high: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| high - (high - low) * (x - x0).abs().max((y - y0).abs()) / half
}

#[test]
fn every_vertex_is_on_the_upper_skin() {
    let roofs: [(&str, Height); 3] = [
        ("surface_mixed_winding.toml", Box::new(|_, y| 3.0 - 3.0 * f64::abs(y) / 12.0)),
        ("surface_closed_solid.toml", Box::new(pyramid([1.1, 2.3], 13.2, 0.0, 3.0))),
        ("surface_two_layers.toml", Box::new(pyramid([0.3, 0.7], 12.0, 2.0, 3.0))),
    ];
    for (file, height) in &roofs {
        let file = Path::new("tests/data/faults").join(file);
        for kind in ["optimise", "area", "uniform", "cotangent"] {
            let study = study(&file, &[format!("pattern.relax.kind={kind}")]);
            for string in ["", "ATTTA", "TTATA"] {
                let (positions, is_feasible) = pattern(&study, string);
                for [x, y, z] in positions {
                    let off = (z - height(x, y)).abs();
                    assert!(off < 1e-9, "{file:?} {kind} {string}: ({x}, {y}, {z}) is {off} off");
                }
                assert!(is_feasible || kind != "optimise" || !string.is_empty(), "{file:?} {string}");
            }
        }
    }
}

fn obj((vertices, faces): &Mesh) -> String {
    let mut text: String = vertices.iter().map(|[x, y, z]| format!("v {x:?} {y:?} {z:?}\n")).collect();
    for face in faces {
        let corners: Vec<String> = face.iter().map(|v| (v + 1).to_string()).collect();
        text += &format!("f {}\n", corners.join(" "));
    }
    text
}

/// A roof with a ridge along x.
fn gable(height: f64) -> Mesh {
    let plan = [[-12.0, -12.0], [12.0, -12.0], [12.0, 12.0], [-12.0, 12.0], [-12.0, 0.0], [12.0, 0.0]];
    let vertices = plan.iter().map(|&[x, y]| [x, y, if y == 0.0 { height } else { 0.0 }]).collect();
    (vertices, vec![vec![0, 1, 5, 4], vec![4, 5, 2, 3]])
}

/// With the normal of one of its two faces, a vertex on the ridge is drawn off to that side: by 0.10 m here.
#[test]
fn vertices_on_a_ridge_stay_there() {
    let folder = tempfile::tempdir().unwrap();
    for (height, panels, rows) in [(6.0, 64, 8), (3.0, 260, 16), (1.5, 144, 12)] {
        for sign in [1.0, -1.0] {
            let name = folder.path().join("c.toml");
            fs::write(folder.path().join("roof.obj"), obj(&gable(sign * height))).unwrap();
            fs::write(
                &name,
                format!(
                    "version = 1\n[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[-10, -10], [10, -10], [10, 10], [-10, 10]]\n\
                     [surface]\nkind = \"mesh\"\nfile = \"roof.obj\"\n[topology]\ninitial = {{ grid = [2, 2] }}\n\
                     [pattern]\npanels = {panels}\n"
                ),
            )
            .unwrap();
            let (positions, is_feasible) = pattern(&study(&name, &[]), "");
            let side = positions.iter().filter(|p| (p[0] + 10.0).abs() < 1e-9).count();
            assert_eq!(side, rows + 1, "an even number of rows, so that one lies on the ridge");
            let mut away: Vec<f64> = positions.iter().map(|p| p[1].abs()).collect();
            away.sort_by(f64::total_cmp);
            let on_ridge = positions.len() / (rows + 1);
            assert!(away[on_ridge - 1] < 1e-9, "{height} {panels}: slipped by {}", away[on_ridge - 1]);
            assert!(is_feasible);
        }
    }
}

/// A wavy roof of triangles and quads.
fn waves() -> Mesh {
    let n = 9;
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let vertices = (0..=n)
        .flat_map(|j| (0..=n).map(move |i| (f64::from(i), f64::from(j))))
        .map(|(x, y)| [x, y, 0.3 * (1.3 * x).sin() + 0.2 * (0.7 * x + 1.9 * y).cos()])
        .collect();
    let cell = |(i, j): (u32, u32)| {
        let quad = vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        match (i + j) % 3 {
            0 => vec![vec![quad[0], quad[1], quad[2]], vec![quad[0], quad[2], quad[3]]],
            _ => vec![quad],
        }
    };
    (vertices, (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).flat_map(cell).collect())
}

/// The order of faces, where each begins and which way it is wound changes no bit.
#[test]
fn a_surface_is_what_its_faces_are_not_how_they_are_listed() {
    let (vertices, faces) = waves();
    let given = MeshSurface::new(&vertices, &faces).unwrap();
    for seed in 0..20 {
        let mut rng = stream(31, seed, 0);
        let mut shuffled = faces.clone();
        for i in (1..shuffled.len()).rev() {
            shuffled.swap(i, below(&mut rng, i + 1));
        }
        for face in &mut shuffled {
            let turn = below(&mut rng, face.len());
            face.rotate_left(turn);
            if unit(&mut rng) < 0.5 {
                face.reverse();
            }
        }
        let other = MeshSurface::new(&vertices, &shuffled).unwrap();
        for k in 0..400 {
            // Every second point on the mesh, where faces meet.
            let mut p = [9.0, 9.0, 1.0].map(|size| size * unit(&mut rng));
            if k % 2 == 0 {
                p = vertices[below(&mut rng, vertices.len())];
            }
            assert_eq!(given.foot(p), other.foot(p), "{p:?}");
            assert_eq!(given.height(p[0], p[1]), other.height(p[0], p[1]), "{p:?}");
            let n = given.foot(p).1;
            assert!(n[2] > 0.0 && (n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}

/// Exactly on an edge rounding puts a point beside both faces: it must not fall through.
#[test]
fn points_on_edges_are_found_above_a_lower_layer() {
    let (mut vertices, mut faces) = waves();
    let count = vertices.len() as u32;
    let upper: Vec<_> = faces.clone();
    vertices.extend(vertices.clone().into_iter().map(|[x, y, z]| [x, y, z - 5.0]));
    faces.extend(upper.iter().map(|face| face.iter().map(|v| v + count).collect::<Vec<u32>>()));
    let surface = MeshSurface::new(&vertices, &faces).unwrap();
    let mut rng = stream(32, 0, 0);
    for face in &upper {
        for k in 0..face.len() {
            let (a, b) = (vertices[face[k] as usize], vertices[face[(k + 1) % face.len()] as usize]);
            for _ in 0..20 {
                let share = unit(&mut rng);
                let [x, y, z] = [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]));
                let height = surface.height(x, y).unwrap();
                assert!((height - z).abs() < 1e-6, "({x}, {y}): {height} is not {z}");
                let normal = surface.foot([x, y, z]).1;
                assert!(normal[2] > 0.0);
            }
        }
    }
    // From below everything, and from between the layers, nearer to the lower one.
    for k in 0..200 {
        let below = if k % 2 == 0 { -9.0 } else { -4.0 };
        let [x, y, z] = surface.project([9.0 * unit(&mut rng), 9.0 * unit(&mut rng), below]);
        assert!((surface.height(x, y).unwrap() - z).abs() < 1e-6 && z > -1.0, "({x}, {y}, {z})");
    }
}

/// Faces of patches that were cut apart end at other points of their common edge: a slit of 0.5 mm in a roof of 20 m, over its ceiling.
#[test]
fn slits_of_the_upper_layer_are_no_way_down() {
    let s = 0.000_5;
    let vertices = vec![
        [0.0, 0.0, 4.0],
        [10.0 - s, 0.0, 4.0],
        [10.0 - s, 20.0, 4.0],
        [0.0, 20.0, 4.0],
        [10.0, 0.0, 4.0],
        [20.0, 0.0, 4.0],
        [20.0, 20.0, 4.0],
        [10.0, 20.0, 4.0],
        [0.0, 0.0, 3.5],
        [20.0, 0.0, 3.5],
        [20.0, 20.0, 3.5],
        [0.0, 20.0, 3.5],
    ];
    let faces = vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7], vec![8, 9, 10, 11]];
    let surface = MeshSurface::new(&vertices, &faces).unwrap();
    for k in 0..=100 {
        let y = 0.2 * f64::from(k);
        assert_eq!(surface.height(10.0 - 0.5 * s, y), Some(4.0), "{y}");
        assert_eq!(surface.project([10.0 - 0.5 * s, y, 3.6])[2], 4.0, "{y}");
    }
}

/// Walls and parapets carry nothing, and lift nothing beside them.
#[test]
fn a_box_with_a_parapet_is_its_roof() {
    let corner = |x: f64, y: f64, z: f64| [x, y, z];
    let ring = |z| [corner(0.0, 0.0, z), corner(8.0, 0.0, z), corner(8.0, 6.0, z), corner(0.0, 6.0, z)];
    let vertices: Vec<[f64; 3]> = [ring(0.0), ring(3.0), ring(4.0)].concat();
    let mut faces = vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]];
    for k in 0..4 {
        let next = (k + 1) % 4;
        faces.push(vec![k, next, next + 4, k + 4]);
        faces.push(vec![k + 4, k + 8, next + 8, next + 4]);
    }
    let surface = MeshSurface::new(&vertices, &faces).unwrap();
    for (x, y) in [(0.0, 0.0), (8.0, 3.0), (4.0, 6.0), (4.0, 3.0), (0.0, 2.7)] {
        assert_eq!(surface.height(x, y), Some(3.0));
        for z in [-1.0, 0.1, 2.0, 3.9, 7.0] {
            assert_eq!(surface.foot([x, y, z]), ([x, y, 3.0], [0.0, 0.0, 1.0]), "({x}, {y}, {z})");
        }
    }
}

/// The lowest band of a dome is as steep as a wall, 0.8 mm wide in plan and 87 mm high; it is seen from above.
#[test]
fn the_rim_of_a_dome_is_no_wall() {
    let (n, bands, radius) = (360, 90, 5.0);
    let angle = |i: u32, of: u32, whole: f64| f64::from(i) / f64::from(of) * whole;
    let vertices: Vec<[f64; 3]> = (0..bands)
        .flat_map(|j| {
            (0..n).map(move |i| {
                (angle(j, bands, 0.5 * std::f64::consts::PI), angle(i, n, std::f64::consts::TAU))
            })
        })
        .map(|(up, round)| [up.cos() * round.cos(), up.cos() * round.sin(), up.sin()].map(|x| radius * x))
        .collect();
    let at = |i: u32, j: u32| j * n + i % n;
    let face = |(i, j): (u32, u32)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    let faces: Vec<_> = (0..bands - 1).flat_map(|j| (0..n).map(move |i| (i, j))).map(face).collect();
    let dome = MeshSurface::new(&vertices, &faces).unwrap();
    for &[x, y, z] in &vertices {
        assert!((dome.height(x, y).unwrap() - z).abs() < 1e-6, "({x}, {y}, {z})");
        let foot = dome.project([1.001 * x, 1.001 * y, 1.001 * z]);
        assert!((0..3).all(|k| (foot[k] - [x, y, z][k]).abs() < 1e-9), "({x}, {y}, {z}): {foot:?}");
    }
}
