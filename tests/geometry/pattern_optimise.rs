//! Patterns that can be built (docs/reference/geometry.md §6): small domains that a smoothing stage fails on, turned, mirrored, moved and
//! scaled.

use quadrille::config::ResolvedConfig;
use quadrille::study::{Design, Effort, Study};
use std::fmt::Write;

/// A plan map, as a matrix by rows and a shift.
type Map = ([[f64; 2]; 2], [f64; 2]);

/// Corners of boundary loops.
type Loops = &'static [&'static [[f64; 2]]];

const HERE: Map = ([[1.0, 0.0], [0.0, 1.0]], [0.0, 0.0]);
const QUARTER: Map = ([[0.0, -1.0], [1.0, 0.0]], [0.0, 0.0]);
const MIRROR: Map = ([[-1.0, 0.0], [0.0, 1.0]], [0.0, 0.0]);
const FAR: Map = ([[1.0, 0.0], [0.0, 1.0]], [4e5, 5e6]);
const LARGE: Map = ([[1000.0, 0.0], [0.0, 1000.0]], [0.0, 0.0]);
const SMALL: Map = ([[0.001, 0.0], [0.0, 0.001]], [0.0, 0.0]);

const RING: &[&[[f64; 2]]] = &[
    &[[-10.0, -10.0], [10.0, -10.0], [10.0, 10.0], [-10.0, 10.0]],
    &[[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]],
];
const ELL: &[&[[f64; 2]]] = &[&[[0.0, 0.0], [20.0, 0.0], [20.0, 8.0], [8.0, 8.0], [8.0, 20.0], [0.0, 20.0]]];
const TEE: &[&[[f64; 2]]] =
    &[&[[0.0, 0.0], [12.0, 0.0], [12.0, 4.0], [8.0, 4.0], [8.0, 12.0], [4.0, 12.0], [4.0, 4.0], [0.0, 4.0]]];
const RECTANGLE: &[&[[f64; 2]]] = &[&[[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]]];

fn polygon(loops: &[&[[f64; 2]]], (m, d): Map, rest: &str) -> Study {
    let mut text = "version = 1\n".to_owned();
    for points in loops {
        let moved: Vec<[f64; 2]> = points
            .iter()
            .map(|[x, y]| [m[0][0] * x + m[0][1] * y + d[0], m[1][0] * x + m[1][1] * y + d[1]])
            .collect();
        let _ = writeln!(text, "[[domain.loop]]\nkind = \"polyline\"\npoints_m = {moved:?}");
    }
    let _ = writeln!(text, "[surface]\nkind = \"plane\"\n{rest}");
    study(&text)
}

fn study(text: &str) -> Study {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).unwrap();
    let config = ResolvedConfig::open(&file, &[]).unwrap();
    Study::of(&config).unwrap()
}

fn design(study: &Study, string: &str) -> Design {
    study.develop(study.topology(&string.parse().unwrap()), Effort::Pattern).unwrap()
}

fn is_good(design: &Design) -> bool {
    design.limits.iter().all(|limit| limit.excess <= 0.0)
}

/// Skewness, edge spread over t, shortest edge over t.
fn figures(design: &Design) -> [f64; 3] {
    let (f, t) = (&design.fabrication, design.pattern.target_length);
    [f.skewness, f.edge_spread / t, f.edge_min / t]
}

#[test]
fn re_entrant_corners_and_rings_keep_every_limit() {
    for (name, loops, panels) in [("ell", ELL, 300), ("tee", TEE, 150), ("ring", RING, 300)] {
        let design = design(&polygon(loops, HERE, &format!("[pattern]\npanels = {panels}")), "");
        assert!(is_good(&design), "{name}: {:?}", design.limits);
        assert!(design.fabrication.edge_min >= 0.25 * design.pattern.target_length, "{name}");
    }
}

#[test]
fn a_domain_turned_or_mirrored_has_the_same_pattern() {
    let grid = "[topology]\ninitial = { grid = [3, 2] }\n[pattern]\npanels = 300";
    let cases: [(Loops, &str, &str); 5] = [
        (ELL, "[pattern]\npanels = 300", ""),
        (TEE, "[pattern]\npanels = 150", ""),
        (RING, "[pattern]\npanels = 300", ""),
        (RECTANGLE, grid, "TTAoTPPPTTPTPPTPTAP"),
        (RECTANGLE, grid, "APPPPTPTTPTPTPA"),
    ];
    for (loops, rest, string) in cases {
        let here = design(&polygon(loops, HERE, rest), string);
        for (name, map) in [("turned", QUARTER), ("mirrored", MIRROR)] {
            // A string walks the other way round on a mirrored mesh: only the start itself is its image.
            if name == "mirrored" && !string.is_empty() {
                continue;
            }
            let there = design(&polygon(loops, map, rest), string);
            assert_eq!(here.pattern.panels.len(), there.pattern.panels.len(), "{name}");
            for (a, b) in figures(&here).into_iter().zip(figures(&there)) {
                assert!((a - b).abs() <= 1e-7 * a.abs(), "{name} {string}: {a} {b}");
            }
        }
    }
}

#[test]
fn a_domain_moved_or_scaled_has_the_same_pattern() {
    let a: f64 = 0.6;
    let turned = ([[libm::cos(a), -libm::sin(a)], [libm::sin(a), libm::cos(a)]], [3.0, -2.0]);
    for (loops, panels) in [(ELL, 300), (RING, 300), (TEE, 150)] {
        let rest = format!("[pattern]\npanels = {panels}");
        let here = design(&polygon(loops, HERE, &rest), "");
        for map in [FAR, LARGE, SMALL, turned] {
            let there = design(&polygon(loops, map, &rest), "");
            assert_eq!(here.pattern.panels.len(), there.pattern.panels.len());
            assert!(is_good(&there));
            for (a, b) in figures(&here).into_iter().zip(figures(&there)) {
                assert!((a - b).abs() <= 0.01 * a.abs(), "{map:?}: {a} {b}");
            }
        }
    }
}

/// Largest distance of a vertex's image under x → −x from a vertex, over the domain's size.
fn asymmetry(design: &Design, study: &Study) -> f64 {
    let [low, high] = study.domain.bounds();
    let middle = low[0] + high[0];
    let points = &design.pattern.positions;
    let image = |p: &[f64; 3]| [middle - p[0], p[1]];
    let nearest =
        |[x, y]: [f64; 2]| points.iter().map(|q| (q[0] - x).hypot(q[1] - y)).fold(f64::MAX, f64::min);
    points.iter().map(|p| nearest(image(p))).fold(0.0, f64::max) / study.domain.size()
}

#[test]
fn symmetric_topologies_give_symmetric_patterns() {
    for (loops, panels) in [(TEE, 150), (RING, 300), (RING, 900)] {
        let study = polygon(loops, HERE, &format!("[pattern]\npanels = {panels}"));
        assert!(asymmetry(&design(&study, ""), &study) < 1e-9);
    }
}

/// 1 000 m² of a roof on an ellipse three times as long as wide.
#[test]
fn smooth_outlines_keep_their_tips() {
    let study = study(
        "version = 1\n[[domain.loop]]\nkind = \"ellipse\"\ncenter_m = [0, 0]\nsemi_axes_m = [20, 5]\n[surface]\nkind = \"plane\"\n\
         [pattern]\npanels = 300\n[pattern.limits]\nmax_edge_factor = 5\nmin_angle_deg = 15\n",
    );
    let design = design(&study, "");
    assert!(is_good(&design), "{:?}", design.limits);
    assert!((design.fabrication.area_covered - 1.0).abs() < 0.007, "{}", design.fabrication.area_covered);
}

#[test]
fn surfaces_reached_by_closest_point_are_optimised_too() {
    for surface in [
        "kind = \"sphere\"\ncenter_m = [15, 10, -20]\nradius_m = 40",
        "kind = \"cylinder\"\ncenter_m = [15, 10, -20]\nradius_m = 30",
    ] {
        let study = study(&format!(
            "version = 1\n[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [30, 0], [30, 20], [0, 20]]\n[surface]\n{surface}\n\
             [topology]\ninitial = {{ grid = [3, 2] }}\n[pattern]\npanels = 300\n"
        ));
        for string in ["", "TTAoTPPPTTPTPPTPTAP", "APPPPTPTTPTPTPA"] {
            let design = design(&study, string);
            assert!(is_good(&design), "{surface} {string}: {:?}", design.limits);
            for p in &design.pattern.positions {
                let q = study.surface.project(*p);
                let off = (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>().sqrt();
                assert!(off < 1e-9, "{off}");
            }
        }
    }
}

/// A vault of quads as an OBJ file, over a square with a round hole: closest point to facets.
#[test]
fn a_mesh_surface_is_optimised_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut obj = String::new();
    for j in 0..=40 {
        for i in 0..=40 {
            let (x, y) = (-1.0 + 0.55 * f64::from(i), -1.0 + 0.55 * f64::from(j));
            let _ = writeln!(obj, "v {x} {y} {}", 2.0 + 1.5 * libm::sin(x / 7.0) * libm::cos(y / 9.0));
        }
    }
    for j in 0..40 {
        for i in 0..40 {
            let a = j * 41 + i + 1;
            let _ = writeln!(obj, "f {a} {} {} {}", a + 1, a + 42, a + 41);
        }
    }
    std::fs::write(folder.path().join("vault.obj"), obj).unwrap();
    let file = folder.path().join("case.toml");
    let text = "version = 1\n[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [20, 0], [20, 20], [0, 20]]\n\
                [[domain.loop]]\nkind = \"circle\"\ncenter_m = [10, 10]\nradius_m = 4\n\
                [surface]\nkind = \"mesh\"\nfile = \"vault.obj\"\n[pattern]\npanels = 400\n";
    std::fs::write(&file, text).unwrap();
    let config = ResolvedConfig::open(&file, &[]).unwrap();
    let study = Study::of(&config).unwrap();
    for string in ["", "APPTPPPTPPTAPTP", "APPTTPTPTAPPATTA*TP"] {
        let design = design(&study, string);
        assert!(is_good(&design), "{string}: {:?}", design.limits);
        let off = |p: &[f64; 3]| {
            study.surface.project(*p).iter().zip(p).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        assert!(design.pattern.positions.iter().map(off).fold(0.0, f64::max) < 1e-9);
    }
}

#[test]
fn two_calls_give_the_same_bytes() {
    let study = polygon(ELL, HERE, "[pattern]\npanels = 300");
    assert_eq!(design(&study, "").pattern, design(&study, "").pattern);
}
