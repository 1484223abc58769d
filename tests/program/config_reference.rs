//! `docs/config.md` says what the code does. After a change of a key run this test with `QUADRILLE_WRITE_DOCS=1`.

use quadrille::config;
use serde_json::Value as Json;
use std::path::Path;

#[test]
fn reference_is_up_to_date() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/config.md");
    let reference = config::reference();
    if std::env::var_os("QUADRILLE_WRITE_DOCS").is_some() {
        std::fs::write(&file, &reference).unwrap();
    }
    let written = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(
        written == reference,
        "docs/config.md is old: run QUADRILLE_WRITE_DOCS=1 cargo test --release --test program config_reference"
    );
}

/// Numbers that may be anything finite: places, angles, heights of surfaces, factors, loads, values of objectives, weights (checked with
/// the objectives).
const FREE: [&str; 24] = [
    "regions_m",
    "aspiration",
    "weights",
    "mark_m",
    "nodes_near_m",
    "sides_near_m",
    "inside_near_m",
    "force_n",
    "kelvin",
    "pressure_pa",
    "thermal_expansion_per_k",
    "points_m",
    "center_m",
    "rotation_deg",
    "axis_deg",
    "z_m",
    "rise_m",
    "base_m",
    "constants",
    "down_pa",
    "combinations",
    "ideal",
    "reference",
    "vertices",
];

/// Every number of the config has a range, or is one that needs none.
#[test]
fn every_number_has_a_range() {
    let mut missing = Vec::new();
    collect(&config::config_schema(), "", false, &mut missing);
    assert!(missing.is_empty(), "give these a #[schemars(extend(\"minimum\" = …))]: {missing:?}");
}

fn collect(schema: &Json, name: &str, ranged: bool, missing: &mut Vec<String>) {
    let bounds = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"];
    let ranged = ranged || FREE.contains(&name) || bounds.iter().any(|bound| schema.get(bound).is_some());
    let is_number = match schema.get("type") {
        Some(Json::String(one)) => one == "number",
        Some(Json::Array(several)) => several.iter().any(|t| t == "number"),
        _ => false,
    };
    if is_number && !ranged {
        missing.push(name.to_owned());
    }
    for (key, value) in schema.get("properties").and_then(Json::as_object).into_iter().flatten() {
        collect(value, key, false, missing);
    }
    for part in ["items", "additionalProperties"] {
        if let Some(part) = schema.get(part) {
            collect(part, name, ranged, missing);
        }
    }
    for alternative in ["oneOf", "anyOf"].iter().filter_map(|key| schema.get(key)?.as_array()).flatten() {
        collect(alternative, name, ranged, missing);
    }
}
