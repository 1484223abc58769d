//! Starts from the skeleton keep the limits that concern topology alone (PATTERN §1), wherever the domain is.
#![allow(clippy::unwrap_used, reason = "tests")]

mod domains;

use domains::{AS_DRAWN, KINDS, Pose, drawn, posed};
use quadrille::domain::Domain;
use quadrille::geometry::{params::Pinched, topological_rejection};
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

/// What a start breaks of PATTERN §1.
fn faults(domain: &Domain, base: &BaseMesh) -> Vec<String> {
    let mesh = InitialMesh::from_base(base).unwrap().mesh;
    let mut faults = Vec::new();
    let rejection = topological_rejection(&canonical_mesh(&mesh), domain, Pinched::Reject, None);
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

/// Two hundred and more domains of the kinds that people draw.
#[test]
fn starts_keep_the_limits() {
    let mut by_kind: BTreeMap<&str, [usize; 3]> = BTreeMap::new();
    let mut valences: BTreeMap<usize, usize> = BTreeMap::new();
    for seed in 0..16 {
        for (k, kind) in KINDS.into_iter().enumerate() {
            let mut rng = random::stream(14, seed, k as u32);
            let loops = drawn(kind, &mut rng);
            let turn_deg = [0.0, 90.0, 30.0][seed as usize % 3];
            let Some(domain) = posed(&loops, Pose { turn_deg, ..AS_DRAWN }) else {
                eprintln!("{kind} {seed}: no domain");
                continue;
            };
            let count = by_kind.entry(kind).or_default();
            count[0] += 1;
            match skeleton::initial_mesh(&domain) {
                Err(error) => eprintln!("{kind} {seed}: {error}"),
                Ok(base) => {
                    count[1] += 1;
                    let faults = faults(&domain, &base);
                    count[2] += usize::from(faults.is_empty());
                    if !faults.is_empty() {
                        eprintln!("{kind} {seed}: {}", faults.join("; "));
                    }
                    let most = (0..base.vertices.len() as u32)
                        .map(|v| base.faces.iter().filter(|f| f.contains(&v)).count())
                        .max()
                        .unwrap();
                    *valences.entry(most).or_default() += 1;
                    if let Ok(folder) = std::env::var("SKELETON_PICTURES") {
                        let svg = skeleton::picture::svg(&base, &domain, kind).unwrap();
                        std::fs::write(format!("{folder}/{kind}{seed}.svg"), svg).unwrap();
                    }
                }
            }
        }
    }
    eprintln!("{by_kind:?}\n{valences:?}");
    let total = by_kind.values().fold([0; 3], |t, c| [t[0] + c[0], t[1] + c[1], t[2] + c[2]]);
    eprintln!("{total:?}");
    assert!(total[0] >= 200 && total[2] == total[0], "{total:?}");
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
