//! What must hold of every string, on every mesh: shared by the property tests and the fuzz targets.

use quadrille::grammar::{Effect, Rules, Tokens, Walker, decode};
use quadrille::mesh::code::rooted_code;
use quadrille::mesh::{InitialMesh, QuadMesh, strips, validate};

/// Reads a string token by token and checks the mesh after each; then its expressed form. Panics on a finding.
pub fn check_string(initial: &InitialMesh, tokens: &Tokens, rules: Rules) {
    let mut walker = Walker::new(initial, rules);
    for &token in tokens.iter() {
        let effect = walker.apply(token);
        check_walker(initial, &walker, effect.is_applied());
    }
    let decoded = decode(initial, tokens, rules);
    let again = decode(initial, &decoded.expressed, rules);
    assert!(
        !again.trace.iter().any(|effect| matches!(effect, Effect::Skipped(_))),
        "skipped in {}: {:?}",
        decoded.expressed,
        again.trace
    );
    assert_eq!(unmarked(&decoded.mesh), unmarked(&again.mesh), "{tokens} and its expressed form");
}

fn unmarked(mesh: &QuadMesh) -> quadrille::mesh::Code {
    quadrille::mesh::code::code(mesh, true)
}

/// The mesh is valid and has the topology of the initial one; the polyedge is a path that ends at the position.
fn check_walker(initial: &InitialMesh, walker: &Walker, changed: bool) {
    let mesh = walker.mesh();
    if changed {
        check_mesh(initial, mesh);
    }
    if let Some(darts) = walker.polyedge() {
        for pair in darts.windows(2) {
            assert_eq!(mesh.end(pair[0]), mesh.origin(pair[1]));
        }
        if let Some(&last) = darts.last() {
            assert_eq!(mesh.end(last), walker.position());
        }
    }
}

/// The mesh is valid, has the topology of the initial one, and its labels are right.
pub fn check_mesh(initial: &InitialMesh, mesh: &QuadMesh) {
    validate::check(mesh).unwrap_or_else(|invalid| panic!("{invalid}"));
    validate::check_invariants(mesh).unwrap_or_else(|fault| panic!("{fault}"));
    assert_eq!(mesh.euler_characteristic(), initial.mesh.euler_characteristic());
    assert_eq!(mesh.loop_count(), initial.mesh.loop_count());
    check_labels(mesh);
}

/// Labels kept through the rules and strips collected anew agree as partitions of the edges.
pub fn check_labels(mesh: &QuadMesh) {
    let anew = strips::collect_anew(mesh);
    let mut label_of = std::collections::BTreeMap::new();
    let mut labels = std::collections::BTreeSet::new();
    for d in mesh.darts() {
        let label = mesh.strip(d);
        assert_eq!(*label_of.entry(anew[d.index()]).or_insert(label), label, "one strip, two labels");
        labels.insert(label);
    }
    assert_eq!(label_of.len(), labels.len(), "one label, two strips");
}

/// A mesh survives being printed and read: same mesh, same marker.
#[allow(dead_code, reason = "not every user of the oracle prints")]
pub fn check_marker(a: (&QuadMesh, quadrille::mesh::DartId), b: (&QuadMesh, quadrille::mesh::DartId)) {
    assert_eq!(rooted_code(a.0, a.1, true), rooted_code(b.0, b.1, true));
}
