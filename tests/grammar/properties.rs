//! What holds of every string on every mesh (docs/reference/grammar.md §1–§6), on random strings of fixed seeds.

use crate::cases::{bases, named};
use crate::oracle::{check_mesh, check_string};
use quadrille::grammar::random::{Shares, structured};
use quadrille::grammar::{Effect, Rules, Token, Tokens, Walker, decode};
use quadrille::mesh::code::{code, rooted_code};
use quadrille::mesh::contract::contract;
use quadrille::mesh::reduce::{fewest_parallel, parallel_classes};
use quadrille::mesh::{
    BaseMesh, Distance, Equivalence, InitialMesh, QuadMesh, StripId, Symmetry, canonical_mesh,
    canonical_mesh_under, deletions, distance, isomorphism, strips,
};
use quadrille::random::{Rng, below, stream};
use std::collections::{BTreeMap, BTreeSet};

fn random_string(rng: &mut Rng, longest: usize) -> Tokens {
    let length = below(rng, longest + 1);
    (0..length).map(|_| Token::ALL[below(rng, Token::ALL.len())]).collect()
}

/// Poles and closed strips as often as it takes to meet them all, whatever a search starts with.
fn shares() -> Shares {
    Shares { pole: 0.15, closed: 0.15, ..Shares::default() }
}

/// Meshes of the given bases, from structured strings.
fn meshes(seed: u64, names: &[&str], count: u32, longest: usize) -> Vec<QuadMesh> {
    let of_base = |(k, name): (usize, &&str)| {
        let initial = named(name);
        let mesh = move |i| {
            let mut rng = stream(seed, k as u32, i);
            decode(&initial, &structured(&mut rng, 0..=longest, &shares()), Rules::Plain).mesh
        };
        (0..count).map(mesh)
    };
    names.iter().enumerate().flat_map(of_base).collect()
}

/// The mesh with its vertices and faces in random order, each face from a random corner on.
fn shuffled(mesh: &QuadMesh, rng: &mut Rng) -> InitialMesh {
    let permutation = |rng: &mut Rng, n: usize| {
        let mut order: Vec<u32> = (0..n as u32).collect();
        (1..n).rev().for_each(|i| order.swap(i, below(rng, i + 1)));
        order
    };
    let number = permutation(rng, mesh.vertex_count());
    let order = permutation(rng, mesh.face_count());
    let firsts = mesh.face_darts();
    let mut base = BaseMesh { vertices: vec![[0.0; 3]; number.len()], ..BaseMesh::default() };
    for (old, &new) in number.iter().enumerate() {
        base.vertices[new as usize] = mesh.positions()[old];
    }
    for (face, &old) in (0u32..).zip(&order) {
        let first = firsts[old as usize];
        let mut vertices: Vec<u32> = mesh.along(first).map(|d| number[mesh.origin(d).index()]).collect();
        if mesh.dart(first).pole {
            base.poles.insert(face, vertices[0]);
        }
        let turn = below(rng, vertices.len());
        vertices.rotate_left(turn);
        base.faces.push(vertices);
    }
    base.corners =
        mesh.corners().iter().map(|carriers| carriers.iter().map(|v| number[v.index()]).collect()).collect();
    InitialMesh::from_base(&base).unwrap()
}

#[test]
fn every_string_is_a_valid_mesh_after_every_token() {
    for (k, initial) in bases().values().enumerate() {
        for i in 0..250 {
            let mut rng = stream(1, k as u32, i);
            let tokens = random_string(&mut rng, 200);
            let rules = if i % 2 == 0 { Rules::Plain } else { Rules::Domain };
            check_string(initial, &tokens, rules);
        }
        for i in 0..150 {
            let mut rng = stream(2, k as u32, i);
            let tokens = structured(&mut rng, 0..=120, &shares());
            check_string(initial, &tokens, Rules::Plain);
        }
    }
}

/// Strings as the search makes them; `QUADRILLE_STRINGS` asks for more of them (ten million have been run).
#[test]
fn no_string_fails() {
    let asked = std::env::var("QUADRILLE_STRINGS").ok().and_then(|n| n.parse().ok());
    let bases = bases();
    for i in 0..asked.unwrap_or(20_000u32) {
        let mut rng = stream(9, 0, i);
        let initial = bases.values().nth(i as usize % bases.len()).unwrap();
        let rules = if i % 2 == 0 { Rules::Plain } else { Rules::Domain };
        let tokens = match i % 3 {
            0 => random_string(&mut rng, 40),
            _ => structured(&mut rng, 4..=40, &shares()),
        };
        check_mesh(initial, &decode(initial, &tokens, rules).mesh);
    }
}

#[test]
fn turn_and_pivot_are_permutations_of_all_darts() {
    for mesh in meshes(3, &["great_court", "pole_disc", "torus_hole", "cube"], 20, 40) {
        let images: BTreeSet<_> = mesh.darts().map(|d| mesh.next(d)).collect();
        assert_eq!(images.len(), mesh.edge_count() * 2);
        let images: BTreeSet<_> = mesh.darts().map(|d| mesh.clockwise(d)).collect();
        assert_eq!(images.len(), mesh.edge_count() * 2);
        for d in mesh.darts() {
            assert_eq!(mesh.counter_clockwise(mesh.clockwise(d)), d);
            let around = mesh.along(d).count();
            let returned = (0..around).fold(d, |e, _| mesh.next(e));
            assert_eq!(returned, d, "T all around a face or loop returns to the start");
            if let Some(face) = mesh.left(d).as_face() {
                assert!(matches!(around, 3 | 4), "{face:?} has {around} darts");
            }
        }
    }
}

#[test]
fn deleting_an_added_strip_gives_the_mesh_back() {
    let mut added = 0;
    for (k, initial) in bases().values().enumerate() {
        for i in 0..150 {
            let mut rng = stream(4, k as u32, i);
            let mut walker = Walker::new(initial, Rules::Plain);
            for &token in structured(&mut rng, 0..=60, &shares()).iter() {
                let before = walker.mesh().clone();
                if let Effect::Added(strip) = walker.apply(token) {
                    added += 1;
                    // A mark may have been handed to a copy that merges with it again: placed codes agree too.
                    let back = contract(walker.mesh(), strip.strip).unwrap().mesh;
                    assert_eq!(code(&back, true), code(&before, true), "strip {strip:?}");
                }
            }
        }
    }
    assert!(added > 1_500, "only {added} strips were added");
}

#[test]
fn codes_do_not_change_under_renumbering() {
    let names = ["great_court", "frei_otto", "pole_disc", "torus_hole", "cube", "tripole"];
    for (i, mesh) in meshes(5, &names, 25, 40).iter().enumerate() {
        let again = shuffled(mesh, &mut stream(6, 0, i as u32)).mesh;
        assert_eq!(code(mesh, false), code(&again, false));
        // Loops are labelled anew by area when a mesh is loaded: placed codes can only be compared with one loop.
        if mesh.loop_count() <= 1 {
            assert_eq!(code(mesh, true), code(&again, true));
            assert_eq!(canonical_mesh(mesh), canonical_mesh(&again));
        }
        let unplaced = Equivalence { placed: false, reduce: true, mirror: true };
        assert_eq!(unplaced.code(mesh), unplaced.code(&again));
    }
}

#[test]
fn equal_codes_give_equal_canonical_meshes() {
    let mut by_code = BTreeMap::new();
    let mut shared = 0;
    for mesh in meshes(7, &["grid2x2", "great_court", "annulus3x2", "fan"], 400, 20) {
        let canonical = canonical_mesh(&mesh);
        assert_eq!(canonical.code, Equivalence::default().code(&mesh));
        assert_eq!(
            canonical.strips.iter().map(|s| s.edges.len()).sum::<usize>(),
            canonical_edges(&canonical)
        );
        match by_code.get(&canonical.code) {
            Some(known) => {
                shared += 1;
                assert_eq!(known, &canonical);
            }
            None => {
                by_code.insert(canonical.code, canonical);
            }
        }
    }
    assert!(shared > 300, "only {shared} codes were reached twice");
}

fn canonical_edges(mesh: &quadrille::mesh::CanonicalMesh) -> usize {
    let mut edges = BTreeSet::new();
    for face in &mesh.faces {
        for k in 0..4 {
            let (u, v) = (face[k], face[(k + 1) % 4]);
            if u != v {
                edges.insert((u.min(v), u.max(v)));
            }
        }
    }
    edges.len()
}

/// Vertices, edges and faces as a coloured graph: two quad meshes that are alike as oriented maps are alike as such
/// graphs, and a simple map is determined by its faces up to turning them over.
fn incidence_graph(mesh: &QuadMesh) -> petgraph::graph::UnGraph<u8, u8> {
    let mut graph = petgraph::graph::UnGraph::new_undirected();
    let vertices: Vec<_> = (0..mesh.vertex_count()).map(|_| graph.add_node(0u8)).collect();
    for first in mesh.face_darts() {
        let face = graph.add_node(1u8);
        // Corners in order: each corner is a node between face and vertex, joined to the next.
        let corners: Vec<_> = mesh
            .along(first)
            .map(|d| {
                let corner = graph.add_node(if mesh.dart(d).pole { 3 } else { 2 });
                graph.add_edge(face, corner, 0u8);
                graph.add_edge(corner, vertices[mesh.origin(d).index()], 1);
                corner
            })
            .collect();
        for k in 0..corners.len() {
            graph.add_edge(corners[k], corners[(k + 1) % corners.len()], 2);
        }
    }
    graph
}

#[test]
fn codes_tell_apart_what_vf2_tells_apart() {
    let unplaced = Equivalence { placed: false, reduce: false, mirror: true };
    let mut compared = [0, 0];
    for names in
        [["single", "grid2x2", "fan"], ["annulus3x2", "annulus3x2", "pole_disc"], ["cube", "tripole", "fan"]]
    {
        let mut small = meshes(8, &names, 60, 12);
        small.retain(|mesh| mesh.face_count() <= 9);
        let graphs: Vec<_> = small.iter().map(incidence_graph).collect();
        let codes: Vec<_> = small.iter().map(|mesh| unplaced.code(mesh)).collect();
        let invariant = |i: usize| (graphs[i].node_count(), graphs[i].edge_count());
        for i in 0..small.len() {
            for j in 0..i {
                if invariant(i) != invariant(j) {
                    assert_ne!(codes[i], codes[j]);
                    continue;
                }
                let same = petgraph::algo::is_isomorphic_matching(
                    &graphs[i],
                    &graphs[j],
                    |a, b| a == b,
                    |a, b| a == b,
                );
                assert_eq!(codes[i] == codes[j], same, "{i} and {j} of {names:?}");
                compared[usize::from(same)] += 1;
            }
        }
    }
    assert!(compared[0] > 300 && compared[1] > 100, "{compared:?}");
}

#[test]
fn mirrored_meshes_are_the_same_only_with_mirror() {
    let strict = Equivalence { placed: false, reduce: false, mirror: false };
    let loose = Equivalence { mirror: true, ..strict };
    let mut chiral = 0;
    for mesh in meshes(9, &["great_court", "pole_disc", "torus_hole"], 40, 30) {
        let image = isomorphism::mirrored(&mesh);
        quadrille::mesh::validate::check(&image).unwrap();
        quadrille::mesh::validate::check_invariants(&image).unwrap();
        assert_eq!(loose.code(&mesh), loose.code(&image));
        assert_eq!(code(&isomorphism::mirrored(&image), true), code(&mesh, true));
        chiral += usize::from(strict.code(&mesh) != strict.code(&image));
    }
    assert!(chiral > 10, "only {chiral} chiral meshes");
}

#[test]
fn symmetric_designs_share_a_canonical_mesh() {
    // The Great Court's domain under x → −x: corners 0↔1, 2↔3, both loops stay, faces turn over.
    let mirror_x = Symmetry { loops: vec![0, 1], corners: vec![1, 0, 3, 2], reversed: true };
    let group = [mirror_x.clone()];
    let mut different = 0;
    for mesh in meshes(10, &["great_court"], 60, 30) {
        let image = mirror_x.apply(&mesh);
        let (one, other) = (canonical_mesh_under(&mesh, &group), canonical_mesh_under(&image, &group));
        assert_eq!(one, other);
        different += usize::from(canonical_mesh(&mesh) != canonical_mesh(&image));
    }
    assert!(different > 20, "only {different} designs had another mirror image");
}

#[test]
fn reduction_finds_the_best_of_all_choices() {
    for (placed, names) in [
        (true, &["annulus3x2", "grid2x2", "pole_disc", "torus_hole", "frei_otto"][..]),
        (false, &["annulus3x2", "grid3x3", "fan", "cube", "great_court"]),
    ] {
        for mesh in meshes(11, names, 40, 24) {
            let mut fewest = usize::MAX;
            let mut codes = BTreeSet::new();
            every_reduction(&mesh, placed, &mut BTreeSet::new(), &mut |end| {
                let count = strips::labels(end).len();
                if count < fewest {
                    fewest = count;
                    codes.clear();
                }
                if count == fewest {
                    codes.insert(code(end, placed));
                }
            });
            let found: BTreeSet<_> =
                fewest_parallel(&mesh, placed).iter().map(|mesh| code(mesh, placed)).collect();
            assert_eq!(found, codes);
        }
    }
}

/// All ends of all orders of merges, every member of a class tried.
fn every_reduction(
    mesh: &QuadMesh,
    placed: bool,
    seen: &mut BTreeSet<Vec<StripId>>,
    end: &mut impl FnMut(&QuadMesh),
) {
    if !seen.insert(strips::labels(mesh)) || seen.len() > 3_000 {
        return;
    }
    let mut merged = false;
    for strip in parallel_classes(mesh, placed).into_iter().flatten() {
        if let Ok(contraction) = contract(mesh, strip) {
            merged = true;
            every_reduction(&contraction.mesh, placed, seen, end);
        }
    }
    if !merged {
        end(mesh);
    }
}

#[test]
fn distance_is_zero_for_isomorphic_symmetric_and_never_wrong() {
    let options = [(true, true), (false, true), (true, false), (false, false)];
    let small = meshes(12, &["grid2x2", "annulus3x2", "pole_disc"], 12, 16);
    for (k, pair) in small.windows(2).enumerate() {
        let (placed, reduce) = options[k % 4];
        let equivalence = Equivalence { placed, reduce, mirror: k % 3 == 0 };
        let d = distance(&pair[0], &pair[1], equivalence, 3);
        assert_eq!(d, distance(&pair[1], &pair[0], equivalence, 3), "symmetric");
        let same = equivalence.code(&pair[0]) == equivalence.code(&pair[1]);
        assert_eq!(d == Distance::Exactly(0), same && d != Distance::Incomparable);
        if d == Distance::Incomparable {
            continue;
        }
        // By brute force: the smallest i + j over the deletion sets.
        let [a, b] = [&pair[0], &pair[1]].map(|mesh| deletions(mesh, 3, equivalence));
        let nearest = a
            .iter()
            .filter_map(|(code, i)| b.get(code).map(|j| (i + j) as usize))
            .min()
            .unwrap_or(usize::MAX);
        let expected = if nearest <= 3 { Distance::Exactly(nearest) } else { Distance::MoreThan(3) };
        assert_eq!(d, expected);
        for max in 0..3 {
            let bounded = distance(&pair[0], &pair[1], equivalence, max);
            let expected = if nearest <= max { Distance::Exactly(nearest) } else { Distance::MoreThan(max) };
            assert_eq!(bounded, expected, "bounded by {max}");
        }
    }
}

#[test]
fn other_topologies_are_at_no_distance() {
    let [square, ring] = ["grid2x2", "annulus3x2"].map(|name| named(name).mesh);
    assert_eq!(distance(&square, &ring, Equivalence::default(), 3), Distance::Incomparable);
}

#[test]
fn a_marker_code_follows_the_marker() {
    let initial = named("single");
    let at = |string: &str| {
        let decoded = decode(&initial, &string.parse().unwrap(), Rules::Plain);
        rooted_code(&decoded.mesh, decoded.marker, true)
    };
    assert_eq!(at("TTTT"), at(""));
    assert_ne!(at("T"), at(""), "corners tell the sides of a square apart");
}
