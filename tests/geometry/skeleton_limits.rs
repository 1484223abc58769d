//! Starts from the skeleton keep the limits that concern topology alone (docs/reference/geometry.md §1.4), wherever the domain is.

use crate::domains::{AS_DRAWN, KINDS, Pose, drawn, posed};
use quadrille::domain::params::Pinched;
use quadrille::domain::params::{CornerRule, Corners};
use quadrille::domain::{Domain, LoopParams};
use quadrille::geometry::limits::Limits;
use quadrille::geometry::params::LimitParams;
use quadrille::geometry::topological_rejection;
use quadrille::mesh::code::code;
use quadrille::mesh::isomorphism::canonical_mesh;
use quadrille::mesh::{BaseMesh, InitialMesh};
use quadrille::{random, skeleton};
use std::collections::{BTreeMap, BTreeSet};

const MAX_VALENCE: usize = 8;
const MIN_ANGLE_DEG: f64 = 20.0;

/// The domain's angle at a corner, on the domain's side, in degrees.
fn corner_angle(domain: &Domain, corner: usize) -> f64 {
    let (label, s) = domain.corner(corner).unwrap();
    let boundary = &domain.loops[label];
    let step = 1e-7 * boundary.length();
    let direction = |s: f64| {
        let [x, y, _] = boundary.tangent(s);
        y.atan2(x).to_degrees()
    };
    let turn = (direction(s + step) - direction(s - step) + 540.0).rem_euclid(360.0) - 180.0;
    if label == 0 { 180.0 - turn } else { 180.0 + turn }
}

/// What a start breaks of docs/reference/geometry.md §1.4.
fn faults(domain: &Domain, base: &BaseMesh) -> Vec<String> {
    let mesh = InitialMesh::from_base(base).unwrap().mesh;
    let mut faults = Vec::new();
    // The project's own refusal, and beside it a count of our own.
    let limits = Limits::of(&LimitParams::default(), 1.0);
    let rejection = topological_rejection(&canonical_mesh(&mesh), domain, Pinched::Reject, Some(&limits));
    faults.extend(rejection.map(|r| r.to_string()));
    let boundary: BTreeSet<u32> = mesh.loops().iter().flatten().map(|&d| mesh.origin(d).0).collect();
    let mut angle: BTreeMap<u32, f64> = BTreeMap::new();
    if domain.mark().is_none() {
        for (corner, vertices) in base.corners.iter().enumerate() {
            angle.insert(vertices[0], corner_angle(domain, corner));
        }
    }
    for v in 0..base.vertices.len() as u32 {
        let panels = base.faces.iter().filter(|f| f.contains(&v)).count();
        let on_boundary = boundary.contains(&v);
        let members = panels + usize::from(on_boundary);
        if members > MAX_VALENCE {
            faults.push(format!("vertex {v} has {members} members"));
        }
        let available = match angle.get(&v) {
            Some(&angle) => angle,
            None if on_boundary => 180.0,
            None => 360.0,
        };
        let least = match angle.get(&v) {
            Some(&angle) => ((angle - 1e-3) / 180.0) as usize + 1,
            None => 1,
        };
        if panels > least && panels as f64 * MIN_ANGLE_DEG > available {
            faults.push(format!("vertex {v} has {panels} panels in {available:.1}°"));
        }
        if panels < least {
            faults.push(format!("corner vertex {v} has {panels} panels in {available:.1}°"));
        }
    }
    faults
}

/// Most panels at a vertex.
fn crowd(base: &BaseMesh) -> usize {
    let panels = |v: u32| base.faces.iter().filter(|f| f.contains(&v)).count();
    (0..base.vertices.len() as u32).map(panels).max().unwrap()
}

/// Two hundred and forty domains of the kinds that people draw. All have a start, it keeps the limits, and it leaves strings room for
/// two more strips at every vertex.
#[test]
fn starts_keep_the_limits() {
    let mut found = Vec::new();
    for seed in 0..16 {
        for (k, kind) in KINDS.into_iter().enumerate() {
            let loops = drawn(kind, &mut random::stream(14, seed, k as u32));
            let turn_deg = [0.0, 90.0, 30.0][seed as usize % 3];
            let domain = posed(&loops, Pose { turn_deg, ..AS_DRAWN }).unwrap();
            match skeleton::initial_mesh(&domain) {
                Err(error) => found.push(format!("{kind} {seed}: {error}")),
                Ok(base) => {
                    found.extend(faults(&domain, &base).iter().map(|f| format!("{kind} {seed}: {f}")));
                    assert!(crowd(&base) <= 6, "{kind} {seed}: {} panels at a vertex", crowd(&base));
                }
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Valences of inner vertices other than 4, ascending.
fn singular(base: &BaseMesh) -> Vec<usize> {
    let mesh = InitialMesh::from_base(base).unwrap().mesh;
    let boundary: BTreeSet<u32> = mesh.loops().iter().flatten().map(|&d| mesh.origin(d).0).collect();
    let panels = |v: u32| base.faces.iter().filter(|f| f.contains(&v)).count();
    let inner = (0..base.vertices.len() as u32).filter(|v| !boundary.contains(v));
    let mut found: Vec<usize> = inner.map(panels).filter(|&n| n != 4).collect();
    found.sort_unstable();
    found
}

fn polyline(points: &[[f64; 2]], corners: Corners) -> LoopParams {
    LoopParams::Polyline {
        points_m: points.iter().map(|p| p.to_vec()).collect(),
        corners,
        corner_angle_deg: 30.0,
    }
}

/// L-shaped walls, an ellipse and a rectangular opening, where discs of three forks touch the re-entrant corner and two of them are one:
/// a vertex of nine panels once.
fn museum() -> Vec<LoopParams> {
    let all = || Corners::Rule(CornerRule::All);
    vec![
        polyline(&[[0., 0.], [36., 0.], [36., 16.], [18., 16.], [18., 34.], [0., 34.]], all()),
        LoopParams::Ellipse { center_m: vec![26.0, 8.0], semi_axes_m: [4.5, 3.0], rotation_deg: 0.0 },
        polyline(&[[6., 20.], [12., 20.], [12., 28.], [6., 28.]], all()),
    ]
}

#[test]
fn the_museum() {
    let domain = posed(&museum(), AS_DRAWN).unwrap();
    let base = skeleton::initial_mesh(&domain).unwrap();
    assert_eq!(faults(&domain, &base), [""; 0]);
    assert_eq!(singular(&base), [5, 5, 5, 5, 5, 6, 6]);
    // No two vertices are drawn at one place, and no edge through an opening.
    for (v, p) in base.vertices.iter().enumerate() {
        let apart = base.vertices[..v].iter().map(|q| (p[0] - q[0]).hypot(p[1] - q[1]));
        assert!(apart.fold(f64::INFINITY, f64::min) > 0.5, "vertex {v}");
    }
    let svg = skeleton::picture::svg(&base, &domain, "museum", &[]).unwrap();
    let [low, high] = domain.bounds();
    let scale = 800.0 / (high[0] - low[0]);
    let mut edges = 0;
    for line in svg.lines().filter(|l| l.contains("class=\"edge\"")) {
        edges += 1;
        let path = line.split(" d=\"M").nth(1).unwrap().split('"').next().unwrap();
        let numbers: Vec<f64> = path.split(['L', ' ']).map(|n| n.parse().unwrap()).collect();
        let points: Vec<[f64; 2]> = numbers
            .chunks(2)
            .map(|p| [low[0] + (p[0] - 30.0) / scale, high[1] - (p[1] - 30.0) / scale])
            .collect();
        for pair in points.windows(2) {
            for k in 0..=20 {
                let at = [0, 1].map(|i| pair[0][i] + f64::from(k) / 20.0 * (pair[1][i] - pair[0][i]));
                assert!(domain.contains_within(at, 0.02), "{line}: {at:?}");
            }
        }
    }
    assert_eq!(edges, 38);
}

/// Three lobes, each two quads beside its axis with a layer around the end, so that its length and its width have rows of their own.
#[test]
fn the_trefoil() {
    let point = |k: i32| {
        let t = std::f64::consts::TAU * f64::from(k) / 200.0;
        let r = 7.0 + 4.0 * (3.0 * t).cos();
        [r * t.cos(), r * t.sin()]
    };
    let outline = polyline(&(0..200).map(point).collect::<Vec<_>>(), Corners::Indices(Vec::new()));
    let domain = posed(&[outline], AS_DRAWN).unwrap();
    let base = skeleton::initial_mesh(&domain).unwrap();
    assert_eq!(faults(&domain, &base), [""; 0]);
    assert_eq!(singular(&base), [3, 3, 3, 3, 3, 3, 6]);
    assert_eq!(base.faces.len(), 18);
}

/// A small hole in a wide ring: the outer loop has rows that do not end on the hole.
#[test]
fn a_small_hole_in_a_disc() {
    let circle = |radius_m: f64| LoopParams::Circle { center_m: vec![0.0, 0.0], radius_m };
    let start = |hole: f64| {
        let domain = posed(&[circle(10.0), circle(hole)], AS_DRAWN).unwrap();
        let base = skeleton::initial_mesh(&domain).unwrap();
        assert_eq!(faults(&domain, &base), [""; 0]);
        singular(&base)
    };
    assert_eq!(start(3.0), [0; 0]);
    assert_eq!(start(2.0), [3, 3, 3, 3, 5, 5, 5, 5]);
}

/// The topology of a start, whatever its numbers; mirrored or not.
fn topology(base: &BaseMesh) -> [quadrille::mesh::canonical::Code; 2] {
    let of = |base: &BaseMesh| code(&InitialMesh::from_base(base).unwrap().mesh, false);
    let mut mirrored = base.clone();
    mirrored.faces.iter_mut().for_each(|f| f.reverse());
    [of(base), of(&mirrored)]
}

#[test]
fn a_start_does_not_depend_on_the_pose() {
    let turned = |turn_deg: f64| Pose { turn_deg, ..AS_DRAWN };
    let poses = [
        turned(90.0),
        turned(180.0),
        turned(270.0),
        turned(30.0),
        turned(77.0),
        Pose { mirrored: true, ..AS_DRAWN },
        Pose { mirrored: true, turn_deg: 90.0, ..AS_DRAWN },
        Pose { scale: 1000.0, ..AS_DRAWN },
        Pose { scale: 0.001, ..AS_DRAWN },
        Pose { shift: [4e5, 5e6], ..AS_DRAWN },
        Pose { shift: [5e6, 4e5], turn_deg: 30.0, ..AS_DRAWN },
    ];
    let (mut differ, mut tried) = (0, 0);
    for seed in 0..6 {
        for (k, kind) in KINDS.into_iter().enumerate() {
            let loops = drawn(kind, &mut random::stream(14, seed, k as u32));
            let Some(domain) = posed(&loops, AS_DRAWN) else { continue };
            let Ok(base) = skeleton::initial_mesh(&domain) else { continue };
            let [plain, mirrored] = topology(&base);
            for pose in poses {
                tried += 1;
                let Some(domain) = posed(&loops, pose) else {
                    eprintln!("{kind} {seed} {pose:?}: no domain");
                    continue;
                };
                let other = skeleton::initial_mesh(&domain).map(|b| topology(&b)[0]);
                if other != Ok(if pose.mirrored { mirrored } else { plain }) {
                    differ += 1;
                    eprintln!(
                        "{kind} {seed} {pose:?}: {}",
                        match other {
                            Ok(_) => "another topology".to_owned(),
                            Err(e) => e.to_string(),
                        }
                    );
                }
            }
        }
    }
    assert_eq!(differ, 0, "of {tried}");
}
