//! docs/reference/geometry.md §0 and §2 on the Great Court: a design is a function of its code, and lies where it must.

use quadrille::config::ResolvedConfig;
use quadrille::random::stream;
use quadrille::search::Problem;
use quadrille::structure::gridshell::GridshellModel;
use quadrille::study::{Effort, Study};
use std::collections::BTreeMap;
use std::path::Path;

fn great_court() -> Study {
    great_court_of(500)
}

fn great_court_of(panels: usize) -> Study {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/great_court.toml");
    let sets = [&format!("pattern.panels={panels}"), "search.tokens.max=12", "topology.symmetry=[]"]
        .map(str::to_owned);
    let config = ResolvedConfig::open(&file, &sets).unwrap();
    Study::of(&config).unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn different_strings_of_one_code_give_the_same_bytes() {
    let study = great_court();
    let mut first = BTreeMap::new();
    let (mut pairs, mut developed) = (0, 0);
    for k in 0..3_000 {
        let tokens = study.random(&mut stream(11, 0, k));
        let decoded = study.decode(&tokens);
        let topology = study.topology(&tokens);
        let (other, mesh) =
            first.entry(topology.code).or_insert((decoded.expressed.clone(), topology.clone()));
        if *other == decoded.expressed {
            continue;
        }
        pairs += 1;
        assert_eq!(*mesh, topology, "{other} and {}", decoded.expressed);
        if pairs % 40 == 0 {
            let [a, b] = [mesh.clone(), topology].map(|t| study.evaluate_topology(t, Effort::Pattern));
            developed += usize::from(a.metrics.iter().any(Option::is_some));
            assert_eq!(a, b);
        }
    }
    assert!(pairs >= 400 && developed >= 2, "{pairs} pairs, {developed} developed");
}

#[test]
fn boundary_on_its_curves_inside_on_the_surface_corners_sharp() {
    let study = great_court();
    let mut seen = 0;
    for k in 0..200 {
        let topology = study.topology(&study.random(&mut stream(12, 0, k)));
        let Ok(design) = study.develop(topology, Effort::Pattern) else { continue };
        let at = |v: u32| design.pattern.positions[v as usize];
        for (curve, vertices) in study.domain.loops.iter().zip(&design.pattern.loops) {
            for &v in vertices {
                assert!(distance(at(v), curve.closest_point(at(v))) < 1e-6, "vertex {v} is off its curve");
            }
        }
        for &p in &design.pattern.positions {
            assert!(distance(p, study.surface.project(p)) < 1e-6, "{p:?} is off the roof");
        }
        let corners: Vec<[f64; 3]> = design.pattern.corners.iter().map(|&v| at(v)).collect();
        assert_eq!(corners.len(), 4);
        for (corner, &s) in corners.iter().zip(study.domain.loops[0].corners()) {
            assert!(
                distance(*corner, study.domain.loops[0].point(s)) < 1e-9,
                "corner {corner:?} is not sharp"
            );
        }
        seen += 1;
    }
    assert!(seen >= 20, "only {seen} designs were developed");
}

/// A boundary of many points without corners: its pattern keeps to it all round.
#[test]
fn a_smooth_polyline_is_followed() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/skeleton/blob.toml");
    let config = ResolvedConfig::open(&file, &["pattern.panels=400".to_owned()]).unwrap();
    let study = Study::of(&config).unwrap();
    let design = study.develop(study.topology(&"".parse().unwrap()), Effort::Pattern).unwrap();
    let vertices = &design.pattern.loops[0];
    let at = |i: usize| design.pattern.positions[vertices[i % vertices.len()] as usize];
    let longest = (0..vertices.len()).map(|i| distance(at(i), at(i + 1))).fold(0.0, f64::max);
    let even = study.domain.loops[0].length() / vertices.len() as f64;
    assert!(longest < 2.0 * even, "{longest} m where {even} m would be even");
}

/// Two panels meet in the south-west corner, and the first vertex of the south wall comes nearer to the west wall than to its
/// own: it must not be taken round the corner, which would leave it there on top of the corner's vertex.
#[test]
fn no_vertex_of_a_wall_runs_into_the_corner() {
    let study = great_court_of(2000);
    let tokens = "PTDTDTPPPTAoTPPPTTTTA".parse().unwrap();
    let design = study.develop(study.topology(&tokens), Effort::Pattern).unwrap();
    let at = |v: u32| design.pattern.positions[v as usize];
    for &[u, v] in &design.pattern.edges {
        if [u, v].iter().any(|end| design.pattern.corners.contains(end)) {
            assert!(distance(at(u), at(v)) > 0.1, "{:?} and {:?}", at(u), at(v));
        }
    }
}

#[test]
fn symmetries_are_those_of_the_supports_too() {
    let two_holes = |supports: &str| {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("two_holes.toml");
        let text = format!(
            r#"
version = 1
[domain]
symmetries = ["mirror-x"]
[[domain.loop]]
kind = "polyline"
points_m = [[0, 0], [20, 0], [20, 10], [0, 10]]
[[domain.loop]]
kind = "circle"
center_m = [5, 5]
radius_m = 2
[[domain.loop]]
kind = "circle"
center_m = [15, 5]
radius_m = 2
[surface]
kind = "plane"
[structure]
{supports}
"#
        );
        std::fs::write(&file, text).unwrap();
        let config = ResolvedConfig::open(&file, &[]).unwrap();
        Study::of(&config).map(|_| ()).map_err(|error| error.to_string())
    };
    let on =
        |label: usize, fixed: &str| format!("[[structure.support]]\nloop = {label}\nfixed = [{fixed}]\n");
    let both = on(1, "'ux', 'uz'") + &on(2, "'uz'") + &on(2, "'ux'");
    assert_eq!(two_holes(&both), Ok(()));
    assert_eq!(two_holes(&on(0, "'ux', 'uy', 'uz'")), Ok(()));
    let error = two_holes(&(on(1, "'ux', 'uz'") + &on(2, "'uz'"))).unwrap_err();
    assert_eq!(
        error,
        "domain.symmetries: structure.support fixes [ux, uz] on loop 1 and [uz] on loop 2, its image"
    );
    let near =
        |key: &str, points: &str| format!("[[structure.support]]\n{key} = [{points}]\nfixed = ['uz']\n");
    assert_eq!(two_holes(&near("nodes_near_m", "[0, 0], [20, 0], [10, 10]")), Ok(()));
    // Any point of a wall names it.
    assert_eq!(two_holes(&near("sides_near_m", "[0, 4], [20.5, 5.5], [9, 0]")), Ok(()));
    for lopsided in [near("nodes_near_m", "[0, 0], [20, 1]"), near("sides_near_m", "[0, 4]")] {
        let error = two_holes(&lopsided).unwrap_err();
        assert!(error.contains("nothing is fixed as near (0, "), "{error}");
    }
}

/// Of loads too, and of columns: what is not its own image makes two designs differ that are images of each other.
#[test]
fn symmetries_are_those_of_the_loads_too() {
    let roof = |load: &str| {
        let text = format!(
            r#"
version = 1
[domain]
symmetries = ["mirror-x"]
[[domain.loop]]
kind = "polyline"
points_m = [[0, 0], [20, 0], [20, 10], [0, 10]]
[surface]
kind = "plane"
[structure]
requirement = []
loads = {{ case = {load} }}
combinations = {{ only = {{ case = 1 }} }}
"#
        );
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("roof.toml");
        std::fs::write(&file, text).unwrap();
        let config = ResolvedConfig::open(&file, &[]).unwrap();
        Study::of(&config).map(|_| ()).map_err(|error| error.to_string())
    };
    let area = |factor: &str| format!("{{ kind = 'area', down_pa = 1e3, factor = '{factor}' }}");
    let point = |points: &str, force: &str| {
        format!("{{ kind = 'point', points_m = [{points}], force_n = [{force}] }}")
    };
    for symmetric in [
        area("abs(x - 10) < 4"),
        area("(y > 5) + 0.3 * abs(nx)"),
        area("z / 3"),
        "{ kind = 'temperature', kelvin = 30 }".to_owned(),
        point("[4, 3], [16, 3], [10, 7]", "0, 200, -1e3"),
    ] {
        assert_eq!(roof(&symmetric), Ok(()), "{symmetric}");
    }
    for (lopsided, words) in [
        (area("x > 10"), "structure.loads.case.factor does not have it: it is "),
        (area("nx < 0"), "structure.loads.case.factor"),
        (
            point("[4, 3], [10, 7]", "0, 0, -1e3"),
            "points_m does not have it: no point is the image of (4, 3)",
        ),
        (point("[10, 7]", "50, 0, -1e3"), "force_n does not have it"),
        (
            point("[10, 17]", "0, 0, -1e3"),
            "structure.loads.case.points_m[0]: found [10, 17], which is not in",
        ),
    ] {
        let error = roof(&lopsided).unwrap_err();
        assert!(error.contains(words), "{lopsided}: {error}");
    }
}

/// A roof on two of its walls, and on points of the two others.
#[test]
fn supports_are_found_by_points_of_the_boundary() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("roof.toml");
    let write = |support: &str| {
        let text = format!(
            r#"
version = 1
[[domain.loop]]
kind = "polyline"
points_m = [[0, 0], [24, 0], [24, 10], [10, 10], [10, 22], [0, 22]]
[surface]
kind = "plane"
[pattern]
panels = 100
[structure]
order = 1
[[structure.support]]
{support}
fixed = ["ux", "uy", "uz"]
"#
        );
        std::fs::write(&file, text).unwrap();
        ResolvedConfig::open(&file, &[])
    };
    let study = |support: &str| {
        let config = write(support).map_err(|error| error.to_string())?;
        Study::of(&config).map_err(|error| error.to_string())
    };
    let held = |support: &str| {
        let study = study(support).unwrap();
        let design = study.develop(study.topology(&"".parse().unwrap()), Effort::Pattern).unwrap();
        let params = write(support).unwrap().config().structure.clone().unwrap();
        let model = GridshellModel::new(&design.pattern, &params, 0.45).unwrap();
        let at = |node: quadrille::structure::model::NodeId| design.pattern.positions[node.0 as usize];
        let held = model.frame.supported().map(|node| [at(node)[0], at(node)[1]]);
        held.collect::<Vec<[f64; 2]>>()
    };

    let walls = held("sides_near_m = [[12, -0.2], [0, 11]]");
    assert!(walls.len() > 15 && walls.iter().all(|[x, y]| *x == 0.0 || *y == 0.0), "{walls:?}");
    for end in [[24.0, 0.0], [0.0, 0.0], [0.0, 22.0]] {
        assert!(walls.contains(&end), "{end:?}");
    }
    let mut corners = held("nodes_near_m = [[24, 10], [10, 9.9]]");
    corners.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!(corners, [[10.0, 10.0], [24.0, 10.0]]);

    for (support, words) in [
        (
            "sides_near_m = [[0, 0]]",
            "structure.support[0].sides_near_m[0]: found [0, 0], about as close to one side",
        ),
        (
            "nodes_near_m = [[0, 0], [24000, 0]]",
            "structure.support[0].nodes_near_m[1]: found [24000, 0], 23976.000 m from",
        ),
        (
            "at = 'corners'\nnodes_near_m = [[0, 0]]",
            "found beside `at`; allowed: either `at` or `nodes_near_m`",
        ),
        ("sides_near_m = []", "structure.support[0].sides_near_m"),
    ] {
        let error = study(support).err().unwrap();
        assert!(error.contains(words), "{error}");
    }
}

/// Linear solves alone crowd panels against the holes: angles of 2° and edges of 2 % of the target length.
#[test]
fn between_several_holes_panels_are_not_crowded() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/pattern_study/three_holes.toml");
    let config = ResolvedConfig::open(&file, &[]).unwrap();
    let study = Study::of(&config).unwrap();
    let design = study.develop(study.topology(&"".parse().unwrap()), Effort::Pattern).unwrap();
    let excess: Vec<_> = design.limits.iter().filter(|limit| limit.excess > 0.0).collect();
    assert!(excess.is_empty(), "{excess:?}");
    let shortest = design.fabrication.edge_min / design.pattern.target_length;
    assert!(shortest > 0.15, "the shortest edge is {shortest} of the target length");
}

/// Three faces around a hole that is a 16-gon: fifteen of its corners have no coarse vertex, more than a probe of four parts
/// a strip has room for. They go to dense vertices of the pattern, one each (docs/reference/geometry.md §0.2).
#[test]
fn corners_nobody_took_find_vertices_however_many() {
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / 16.0;
        format!("[{:.3}, {:.3}]", 15.0 + 4.0 * angle.cos(), 15.0 + 4.0 * angle.sin())
    };
    let polygon: Vec<String> = (0..16).map(corner).collect();
    let text = format!(
        "version = 1\n[run]\nname = 'corners'\n[[domain.loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [30, 0], [30, 30], [0, 30]]\n\
         [[domain.loop]]\nkind = 'polyline'\npoints_m = [{}]\n[surface]\nkind = 'plane'\n\
         [topology]\nrules = 'plain'\npinched = 'allow'\n[pattern]\npanels = 2000\n",
        polygon.join(", ")
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("corners.toml");
    std::fs::write(&file, text).unwrap();
    let study = Study::of(&ResolvedConfig::open(&file, &[]).unwrap()).unwrap();
    let deletions = "DPPDDTDDPDTDTDDDDDTDDPDPTTDDDPTTDDTDDTTDPDTTTTDDTDPTDTDDPTPD".parse().unwrap();
    let topology = study.topology(&deletions);
    assert_eq!(topology.faces.len(), 3);
    let pattern = study.develop(topology, Effort::Pattern).unwrap().pattern;
    let mut taken = pattern.corners.clone();
    taken.sort_unstable();
    taken.dedup();
    assert_eq!(taken.len(), 20, "every corner has a vertex of its own");
}
