//! The metrics against COMPAS 2 on an exported pattern (docs/reference/geometry.md §3): numbers computed once by
//! `tests/data/geometry/compas_metrics.py` with COMPAS 2.15.1 and kept.

use crate::support::great_court;
use quadrille::geometry::dense::Edges;
use quadrille::geometry::{Panel, Pattern, PatternParams, develop, metrics};
use quadrille::mesh::isomorphism::canonical_mesh;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const TOLERANCE: f64 = 1e-9;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/geometry").join(name)
}

fn read(name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(data(name)).expect("a file")).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

/// Run with `--ignored` to write the pattern anew; then run the script.
#[test]
#[ignore = "writes test data"]
fn write_the_pattern() {
    let court = great_court();
    let params = PatternParams { panels: 300, ..PatternParams::default() };
    let pattern =
        develop(&canonical_mesh(&court.initial.mesh), &court.domain, court.surface.as_ref(), &params)
            .expect("a pattern");
    let faces: Vec<&[u32]> = pattern.panels.iter().map(Panel::corners).collect();
    let text = json!({ "vertices": pattern.positions, "faces": faces }).to_string();
    std::fs::write(data("great_court_300.json"), text).expect("written");
}

#[test]
fn curvature_skewness_and_edges_agree_with_compas() {
    let (mesh, expected) = (read("great_court_300.json"), read("great_court_300_compas.json"));
    let positions: Vec<[f64; 3]> = mesh["vertices"]
        .as_array()
        .expect("vertices")
        .iter()
        .map(|p| std::array::from_fn(|k| number(&p[k])))
        .collect();
    let panels: Vec<Panel> = mesh["faces"]
        .as_array()
        .expect("faces")
        .iter()
        .map(|f| Panel::quad(std::array::from_fn(|k| f[k].as_u64().expect("a vertex") as u32)))
        .collect();
    let pattern = Pattern {
        edges: Edges::of(positions.len(), &panels).list,
        coarse_face: vec![0; panels.len()],
        positions,
        panels,
        loops: Vec::new(),
        along: Vec::new(),
        corners: Vec::new(),
        loop_corners: Vec::new(),
        coarse: Vec::new(),
        target_length: 1.0,
    };
    let corners = |panel: &Panel| -> Vec<[f64; 3]> {
        panel.corners().iter().map(|&v| pattern.positions[v as usize]).collect()
    };
    let (curvature, skewness, area) =
        (numbers(&expected["curvature"]), numbers(&expected["skewness"]), numbers(&expected["area"]));
    assert_eq!(curvature.len(), pattern.panels.len());
    for (p, panel) in pattern.panels.iter().enumerate() {
        let c = corners(panel);
        assert!((metrics::panel_curvature(&c) - curvature[p]).abs() < TOLERANCE, "curvature of panel {p}");
        assert!((metrics::panel_skewness(&c) - skewness[p]).abs() < TOLERANCE, "skewness of panel {p}");
        let found = metrics::panel_area(&pattern.positions, panel);
        assert!((found - area[p]).abs() < TOLERANCE * area[p], "area of panel {p}");
    }
    // COMPAS divides the distance of the diagonals by the mean edge, docs/reference/geometry.md §3 by the mean diagonal.
    let flatness = numbers(&expected["flatness"]);
    let planarity = pattern.panels.iter().zip(&flatness).map(|(panel, flatness)| {
        let c = corners(panel);
        let length = |i: usize, j: usize| (0..3).map(|k| (c[i][k] - c[j][k]).powi(2)).sum::<f64>().sqrt();
        let edges = length(0, 1) + length(1, 2) + length(2, 3) + length(3, 0);
        flatness * (edges / 4.0) / (0.5 * (length(0, 2) + length(1, 3)))
    });
    let planarity = planarity.sum::<f64>() / flatness.len() as f64;

    let found =
        metrics::measure(&pattern, &canonical_mesh(&great_court().initial.mesh), &great_court().domain);
    for (name, value) in [
        ("mean_curvature", found.curvature),
        ("mean_skewness", found.skewness),
        ("edge_spread", found.edge_spread),
        ("mean_aspect_ratio", found.aspect_mean),
    ] {
        assert!((value - number(&expected[name])).abs() < TOLERANCE, "{name}: {value}");
    }
    assert!((found.planarity - planarity).abs() < TOLERANCE, "planarity: {} {planarity}", found.planarity);
    assert_eq!(found.singularities.inner, 4);
    assert_eq!(found.members, expected["edges"].as_u64().expect("a number") as usize);
}
