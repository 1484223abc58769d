//! Everything after the grammar is a function of the canonical code (docs/reference/geometry.md §0.5).

use crate::support::great_court;
use quadrille::domain::params::Pinched;
use quadrille::geometry::params::RelaxParams;
use quadrille::geometry::{PatternParams, Shaped, metrics, shape, topological_rejection};
use quadrille::grammar::random::{self, Shares};
use quadrille::grammar::{Rules, Tokens, decode};
use quadrille::mesh::isomorphism::canonical_mesh;
use quadrille::mesh::{BaseMesh, CanonicalMesh, Code, InitialMesh, QuadMesh};
use quadrille::random::{Rng, below, stream};
use quadrille::search::operators::Growth;
use quadrille::search::params::TokenBounds;
use quadrille::study::Study;
use std::collections::BTreeMap;

/// Coarse and quickly relaxed: what is compared is bytes, not beauty.
fn params() -> PatternParams {
    let relax = RelaxParams { sweeps: 10, ..RelaxParams::default() };
    PatternParams { panels: 300, relax, ..PatternParams::default() }
}

fn random_string(initial: &InitialMesh, index: u32) -> Tokens {
    let bounds = TokenBounds { min: 6, max: 20 };
    let growth = Growth { initial, rules: Rules::Domain, bounds };
    let mut rng = stream(11, 0, index);
    match index.is_multiple_of(2) {
        true => random::structured(&mut rng, bounds.min..=bounds.max, &Shares::default()),
        false => growth.random(&mut rng),
    }
}

/// All numbers of a developed design, or why it has none, to the last bit.
fn fingerprint(court: &Study, mesh: &CanonicalMesh) -> String {
    let Study { domain, surface, .. } = court;
    if let Some(rejection) = topological_rejection(mesh, domain, Pinched::Allow, None) {
        return rejection.to_string();
    }
    match shape(mesh, domain, surface.as_ref(), &params()) {
        Ok(Shaped { pattern, .. }) => {
            format!("{:?} {:?}", metrics::measure(&pattern, mesh, domain), pattern.positions)
        }
        Err(rejection) => rejection.to_string(),
    }
}

#[test]
fn strings_of_one_code_give_the_same_bytes() {
    let court = great_court();
    let mut first: BTreeMap<Code, (Tokens, CanonicalMesh)> = BTreeMap::new();
    let mut pairs = 0;
    for index in 0.. {
        if pairs == 1000 {
            break;
        }
        let tokens = random_string(&court.initial, index);
        let decoded = decode(&court.initial, &tokens, Rules::Domain);
        let mesh = canonical_mesh(&decoded.mesh);
        let Some((other, known)) = first.get(&mesh.code) else {
            first.insert(mesh.code, (decoded.expressed, mesh));
            continue;
        };
        if *other == decoded.expressed {
            continue;
        }
        assert_eq!(*known, mesh, "{other} and {tokens}");
        assert_eq!(fingerprint(&court, known), fingerprint(&court, &mesh), "{other} and {tokens}");
        pairs += 1;
    }
}

#[test]
fn numbers_of_vertices_and_faces_do_not_matter() {
    let court = great_court();
    for index in 0..1000 {
        let tokens = random_string(&court.initial, 100_000 + index);
        let decoded = decode(&court.initial, &tokens, Rules::Domain);
        let renumbered = renumbered(&decoded.mesh, &mut stream(12, 0, index));
        let again = InitialMesh::from_base(&renumbered).expect("a valid mesh");
        let (before, after) = (canonical_mesh(&decoded.mesh), canonical_mesh(&again.mesh));
        assert_eq!(before, after, "{tokens}");
        assert_eq!(fingerprint(&court, &before), fingerprint(&court, &after), "{tokens}");
    }
}

/// The same mesh with vertices, faces and the first corner of each face in another order.
///
/// Loop labels come from the areas in plan, which grammar does not keep up; so boundary vertices are put on two circles.
fn renumbered(mesh: &QuadMesh, rng: &mut Rng) -> BaseMesh {
    let mut order: Vec<u32> = (0..mesh.vertex_count() as u32).collect();
    shuffle(&mut order, rng);
    let mut vertices = vec![[0.0; 3]; order.len()];
    for (label, darts) in mesh.loops().iter().enumerate() {
        let radius = if label == 0 { 2.0 } else { 1.0 };
        for (i, &d) in darts.iter().enumerate() {
            let turn = std::f64::consts::TAU * i as f64 / darts.len() as f64;
            let at = order[mesh.origin(d).index()] as usize;
            vertices[at] = [radius * libm::cos(turn), radius * libm::sin(turn), 0.0];
        }
    }
    let mut faces: Vec<(Vec<u32>, Option<u32>)> = canonical_faces(mesh, &order, rng);
    shuffle(&mut faces, rng);
    let poles = faces.iter().enumerate().filter_map(|(f, (_, pole))| Some((f as u32, (*pole)?))).collect();
    let corners = mesh.corners().iter().map(|at| at.iter().map(|v| order[v.index()]).collect()).collect();
    BaseMesh {
        vertices,
        faces: faces.into_iter().map(|(face, _)| face).collect(),
        poles,
        marker: None,
        corners,
    }
}

fn canonical_faces(mesh: &QuadMesh, order: &[u32], rng: &mut Rng) -> Vec<(Vec<u32>, Option<u32>)> {
    mesh.face_darts()
        .iter()
        .map(|&d| {
            let darts: Vec<_> = mesh.along(d).collect();
            let pole = darts.iter().find(|&&d| mesh.dart(d).pole).map(|&d| order[mesh.origin(d).index()]);
            let mut face: Vec<u32> = darts.iter().map(|&d| order[mesh.origin(d).index()]).collect();
            let turn = below(rng, face.len());
            face.rotate_left(turn);
            (face, pole)
        })
        .collect()
}

fn shuffle<T>(items: &mut [T], rng: &mut Rng) {
    for i in (1..items.len()).rev() {
        items.swap(i, below(rng, i + 1));
    }
}
