//! Initial meshes from the medial axis: the domains named in the specification, and odd ones.

use quadrille::config::ResolvedConfig;
use quadrille::domain::params::{CornerRule, Corners};
use quadrille::domain::{Domain, DomainParams, LoopParams};
use quadrille::io::Inputs;
use quadrille::mesh::{BaseMesh, InitialMesh, base_json};
use quadrille::random::{self, Rng};
use quadrille::surface::SurfaceParams;
use quadrille::{skeleton, surface};
use std::collections::BTreeSet;
use std::path::PathBuf;

fn data(name: &str) -> PathBuf {
    PathBuf::from(format!("tests/data/skeleton/{name}.toml"))
}

fn domain(name: &str) -> Domain {
    let config = ResolvedConfig::open(&data(name), &[]).unwrap();
    let surface = surface::build(&config.config().surface, config.inputs()).unwrap();
    Domain::resolve(&config.config().domain, &surface, config.inputs()).unwrap()
}

fn mesh(name: &str) -> (Domain, BaseMesh, InitialMesh) {
    let domain = domain(name);
    let base = skeleton::initial_mesh(&domain).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mesh = InitialMesh::from_base(&base).unwrap();
    (domain, base, mesh)
}

/// Valences of inner vertices other than 4 and of boundary vertices other than 3, corners left out.
fn singularities(base: &BaseMesh, mesh: &InitialMesh) -> Vec<(usize, usize)> {
    let m = &mesh.mesh;
    let mut valence = vec![0; m.vertex_count()];
    let mut boundary = BTreeSet::new();
    for d in m.darts() {
        valence[m.origin(d).index()] += 1;
        if m.is_outside(d) {
            boundary.insert(m.origin(d).index());
        }
    }
    let corners: BTreeSet<usize> = base.corners.iter().flatten().map(|&v| v as usize).collect();
    let irregular = |v: &usize| valence[*v] != if boundary.contains(v) { 3 } else { 4 };
    (0..valence.len()).filter(|v| !corners.contains(v)).filter(irregular).map(|v| (v, valence[v])).collect()
}

/// docs/reference/geometry.md §1.3: 12 faces, 20 vertices, four 5-valent singularities equally far from two walls and the circle.
#[test]
fn the_great_court() {
    let (_, base, mesh) = mesh("great_court");
    assert_eq!((base.faces.len(), base.vertices.len()), (12, 20));
    let singular = singularities(&base, &mesh);
    assert_eq!(singular.iter().map(|s| s.1).collect::<Vec<_>>(), [5; 4]);
    let (north, south) =
        ([21.385_506_244_736_58, 30.785_506_244_736_58], [19.573_982_053_708_03, 34.073_982_053_708_03]);
    for (v, _) in singular {
        let [x, y, _] = base.vertices[v];
        let expected = if y > 0.0 { north } else { south };
        assert!((x.abs() - expected[0]).abs() < 1e-9 && (y.abs() - expected[1]).abs() < 1e-9, "({x}, {y})");
        let to_wall = 36.625 - x.abs();
        assert!((x.hypot(y) - 22.245 - to_wall).abs() < 1e-9, "equally far");
    }
    // The same mesh as the reference case, marker and corners included.
    let text = std::fs::read_to_string("tests/data/grammar/bases/great_court.json").unwrap();
    let reference = InitialMesh::from_base(&base_json::read(&text).unwrap()).unwrap();
    let code = |m: &InitialMesh| quadrille::mesh::code::code(&m.mesh, true);
    let rooted = |m: &InitialMesh| quadrille::mesh::code::rooted_code(&m.mesh, m.marker, false);
    assert_eq!(code(&mesh), code(&reference));
    assert_eq!(rooted(&mesh), rooted(&reference));
}

/// Faces and vertices of each, as looked at in pictures.
#[test]
fn domains_named_in_the_specification() {
    for (name, vertices, faces, singular) in [
        ("rectangle", 12, 6, vec![]),
        ("square", 9, 4, vec![]),
        ("l", 17, 9, vec![5]),
        ("disc", 8, 5, vec![3, 3, 3, 3]),
        ("ring", 8, 4, vec![]),
        ("star", 11, 5, vec![5]),
        ("frei_otto", 28, 18, vec![5, 5, 5, 5, 6, 6]),
        ("ellipse", 12, 8, vec![3, 3, 3, 3]),
    ] {
        let (_, base, mesh) = mesh(name);
        assert_eq!((base.vertices.len(), base.faces.len()), (vertices, faces), "{name}");
        let mut found: Vec<usize> = singularities(&base, &mesh).iter().map(|s| s.1).collect();
        found.sort_unstable();
        assert_eq!(found, singular, "{name}");
    }
}

/// What holds for every domain: valid quads, loops in order, every corner or the mark on its vertex, no pinched vertex, the same
/// mesh twice.
#[test]
fn every_domain_gets_a_sound_mesh() {
    let mut seen = 0;
    for entry in std::fs::read_dir("tests/data/skeleton").unwrap() {
        let path = entry.unwrap().path();
        let Some(name) = path
            .file_stem()
            .and_then(|s| s.to_str())
            .filter(|_| path.extension().is_some_and(|e| e == "toml"))
        else {
            continue;
        };
        seen += 1;
        let (domain, base, mesh) = mesh(name);
        assert!(base.faces.iter().all(|f| f.len() == 4) && base.poles.is_empty(), "{name}");
        assert_eq!(mesh.mesh.loop_count(), domain.loops.len(), "{name}");
        let marks: Vec<[f64; 3]> = match domain.mark() {
            Some(s) => vec![domain.loops[0].point(s)],
            None => (0..domain.corner_count())
                .map(|c| domain.corner(c).unwrap())
                .map(|(l, s)| domain.loops[l].point(s))
                .collect(),
        };
        assert_eq!(base.corners.len(), marks.len(), "{name}");
        for (corner, at) in base.corners.iter().zip(&marks) {
            assert_eq!(corner.len(), 1, "{name}");
            assert_eq!(base.vertices[corner[0] as usize], *at, "{name}");
        }
        let corners: BTreeSet<u32> = base.corners.iter().flatten().copied().collect();
        let faces_at = |v: u32| base.faces.iter().filter(|f| f.contains(&v)).count();
        for (label, darts) in mesh.mesh.loops().iter().enumerate() {
            for &d in darts {
                let v = mesh.mesh.origin(d).0;
                assert!(faces_at(v) > 1 || corners.contains(&v), "{name}: vertex {v} is pinched");
                let p = base.vertices[v as usize];
                let q = domain.loops[label].closest_point(p);
                assert!((0..3).all(|k| (p[k] - q[k]).abs() < 1e-9), "{name}: vertex {v} is off loop {label}");
            }
        }
        assert_eq!(skeleton::initial_mesh(&domain).unwrap(), base, "{name}: the same twice");
    }
    assert!(seen >= 30, "{seen} domains");
}

/// A closed polyline around the origin, its radius anywhere between 3 and 10 (all points corners), or smooth and without corners.
fn random_outline(rng: &mut Rng) -> LoopParams {
    let corners = random::below(rng, 2) == 0;
    let count = if corners { 3 + random::below(rng, 12) } else { 90 };
    let waves: [f64; 8] = std::array::from_fn(|_| random::unit(rng));
    let points_m = (0..count)
        .map(|k| {
            let t = std::f64::consts::TAU * k as f64 / count as f64;
            let wave = |n: usize| waves[2 * n - 2] * (n as f64 * t + 6.0 * waves[2 * n - 1]).cos() / n as f64;
            let radius = if corners {
                3.0 + 7.0 * random::unit(rng)
            } else {
                8.0 + 2.0 * (wave(1) + wave(2) + wave(3) + wave(4))
            };
            vec![1.5 * radius * t.cos(), radius * t.sin()]
        })
        .collect();
    let corners = if corners { Corners::Rule(CornerRule::All) } else { Corners::Indices(Vec::new()) };
    LoopParams::Polyline { points_m, corners, corner_angle_deg: 30.0 }
}

/// A circle, an ellipse or a triangle somewhere near the middle.
fn random_hole(rng: &mut Rng) -> LoopParams {
    let kind = random::below(rng, 3);
    let [x, y, r]: [f64; 3] = std::array::from_fn(|_| random::unit(rng));
    let (x, y, r) = (12.0 * x - 6.0, 8.0 * y - 4.0, 0.3 + 1.5 * r);
    match kind {
        0 => LoopParams::Circle { center_m: vec![x, y], radius_m: r },
        1 => LoopParams::Ellipse { center_m: vec![x, y], semi_axes_m: [r, 0.6 * r], rotation_deg: 100.0 * r },
        _ => LoopParams::Polyline {
            points_m: vec![vec![x - r, y], vec![x + r, y - 0.3 * r], vec![x, y + r]],
            corners: Corners::default(),
            corner_angle_deg: 30.0,
        },
    }
}

/// Random polygons and smooth outlines with up to three holes: a valid mesh for at least 99 of 100, and for the others a message that
/// names the cure.
#[test]
fn random_domains() {
    let plane = surface::build(&SurfaceParams::Plane { z_m: 0.0 }, &Inputs::default()).unwrap();
    let (mut tried, mut failed, mut seed) = (0, 0, 0);
    while tried < 300 {
        seed += 1;
        let mut rng = random::stream(11, seed, 0);
        let mut loops = vec![random_outline(&mut rng)];
        loops.extend((0..random::below(&mut rng, 4)).map(|_| random_hole(&mut rng)).collect::<Vec<_>>());
        let params = DomainParams { symmetries: Vec::new(), mark_m: None, loops };
        let Ok(domain) = Domain::resolve(&params, &plane, &Inputs::default()) else { continue };
        tried += 1;
        match skeleton::initial_mesh(&domain) {
            Ok(base) => {
                let mesh = InitialMesh::from_base(&base).unwrap();
                assert_eq!(mesh.mesh.loop_count(), domain.loops.len(), "seed {seed}");
                assert!(base.corners.iter().all(|c| c.len() == 1), "seed {seed}");
            }
            Err(error) => {
                eprintln!("seed {seed}: {error}");
                assert!(error.to_string().contains("give an initial mesh"), "seed {seed}: {error}");
                failed += 1;
            }
        }
    }
    assert!(failed <= 3, "{failed} of {tried} failed");
}
