//! What is frozen stays as it is, and no poles come where none may, whatever a string says.

use quadrille::grammar::random::{Shares, aware, uniform};
use quadrille::grammar::{Effect, Rules, Skip, Walker, decode};
use quadrille::mesh::{DartId, InitialMesh, QuadMesh, validate};
use quadrille::random::{stream, unit};

use crate::cases::bases;

/// The frozen faces by what they share: for each how many of its edges another one has on the other side, and how many vertices
/// and darts they have in all.
fn frozen(mesh: &QuadMesh) -> (Vec<usize>, usize, usize) {
    let is_frozen = |d: DartId| mesh.dart(d).frozen;
    let faces = mesh.face_darts().into_iter().filter(|&d| is_frozen(d));
    let mut shared: Vec<usize> =
        faces.map(|first| mesh.along(first).filter(|&d| is_frozen(mesh.twin(d))).count()).collect();
    shared.sort_unstable();
    let mut vertices: Vec<u32> = mesh.darts().filter(|&d| is_frozen(d)).map(|d| mesh.origin(d).0).collect();
    vertices.sort_unstable();
    vertices.dedup();
    (shared, vertices.len(), mesh.darts().filter(|&d| is_frozen(d)).count())
}

fn strings(initial: &InitialMesh, rules: Rules, k: u32) -> [quadrille::grammar::Tokens; 2] {
    let mut rng = stream(21, k, 0);
    [uniform(&mut rng, 4..=40), aware(&mut rng, 4..=40, &Shares::default(), initial, rules)]
}

#[test]
fn no_rule_touches_what_is_frozen() {
    let (mut applied, mut refused) = (0, 0);
    for (name, mut initial) in bases() {
        let mut rng = stream(20, 0, 0);
        let free = initial.clone();
        let share = 0.3 * unit(&mut rng);
        let xs: Vec<f64> = initial.mesh.positions().iter().map(|p| p[0]).collect();
        let (low, high) =
            (xs.iter().copied().fold(f64::MAX, f64::min), xs.iter().copied().fold(f64::MIN, f64::max));
        initial.mesh.freeze(|p| p[0] <= low + (0.25 + share) * (high - low));
        let before = frozen(&initial.mesh);
        for k in 0..200 {
            for rules in [Rules::Plain, Rules::Domain] {
                for string in strings(&free, rules, k) {
                    let mut walker = Walker::new(&initial, rules);
                    for &token in string.iter() {
                        let effect = walker.apply(token);
                        applied += usize::from(effect.is_applied());
                        refused += usize::from(effect == Effect::Skipped(Skip::Frozen));
                    }
                    assert_eq!(frozen(walker.mesh()), before, "{name}: {string}");
                    validate::check(walker.mesh()).unwrap();
                    let decoded = decode(&initial, &string, rules);
                    let again = decode(&initial, &decoded.expressed, rules);
                    assert_eq!(again.expressed, decoded.expressed, "{name}: {string}");
                }
            }
        }
    }
    assert!(applied > 1000 && refused > 1000, "{applied} rules applied, {refused} refused");
}

#[test]
fn without_poles_no_strip_ends_in_one() {
    let mut refused = 0;
    for (name, mut initial) in bases() {
        let free = initial.clone();
        initial.poles = false;
        let has_poles = |mesh: &QuadMesh| mesh.pole_vertices().contains(&true);
        let had_poles = has_poles(&initial.mesh);
        for k in 0..200 {
            for string in strings(&free, Rules::Plain, k) {
                let decoded = decode(&initial, &string, Rules::Plain);
                assert!(had_poles || !has_poles(&decoded.mesh), "{name}: {string}");
                for effect in &decoded.trace {
                    refused += usize::from(*effect == Effect::Skipped(Skip::NoPoles));
                    let Effect::Added(added) = effect else { continue };
                    assert!(!added.ends().contains(&"pole"), "{name}: {string}");
                }
            }
        }
    }
    assert!(refused > 100, "{refused}");
}
