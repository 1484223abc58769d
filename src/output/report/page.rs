//! Puts the template, style, scripts, libraries and data together.

use super::ReportError;
use super::data::{Design, ReportData};
use super::encode::{Packed, pack};
use serde::Serialize;
use std::collections::BTreeMap;

const TEMPLATE: &str = include_str!("../../../assets/report/page.html");
const STYLE: &str = include_str!("../../../assets/report/page.css");
const LIBRARIES: [&str; 2] = [
    include_str!("../../../assets/vendor/d3-7.9.2.min.js"),
    include_str!("../../../assets/vendor/plot-0.6.17.min.js"),
];
const LICENCES: [(&str, &str); 2] = [
    ("d3 7.9.2", include_str!("../../../assets/vendor/d3.LICENSE")),
    ("Observable Plot 0.6.17", include_str!("../../../assets/vendor/plot.LICENSE")),
];
/// In the order in which they need each other. They share one scope.
const SCRIPTS: [&str; 13] = [
    include_str!("../../../assets/report/model.js"),
    include_str!("../../../assets/report/mesh.js"),
    include_str!("../../../assets/report/colours.js"),
    include_str!("../../../assets/report/plan.js"),
    include_str!("../../../assets/report/viewer.js"),
    include_str!("../../../assets/report/parallel.js"),
    include_str!("../../../assets/report/matrix.js"),
    include_str!("../../../assets/report/gallery.js"),
    include_str!("../../../assets/report/tables.js"),
    include_str!("../../../assets/report/families.js"),
    include_str!("../../../assets/report/misses.js"),
    include_str!("../../../assets/report/convergence.js"),
    include_str!("../../../assets/report/main.js"),
];

/// A design as the page holds it: all but its mesh.
#[derive(Serialize)]
struct Row<'a> {
    id: &'a str,
    string: &'a str,
    expressed: &'a str,
    generation: u32,
    feasible: bool,
    reason: &'a Option<String>,
    values: Vec<Option<f64>>,
    singularities: &'a Option<super::Singularities>,
    symmetry: &'a str,
    equal: u64,
    preferred: Option<u64>,
    group: Option<usize>,
}

#[derive(Serialize)]
struct Facts<'a> {
    run: &'a super::Run,
    metrics: &'a [super::Metric],
    objectives: &'a [usize],
    front: Vec<Row<'a>>,
    baseline: Option<Row<'a>>,
    obstacles: &'a [super::Obstacle],
    misses: Vec<Row<'a>>,
    generations: &'a [super::Generation],
    spread: &'a super::Spread,
    config_toml: &'a str,
    design_files: &'a [String],
}

pub(super) fn assemble(data: &ReportData) -> Result<String, ReportError> {
    let facts = Facts {
        run: &data.run,
        metrics: &data.metrics,
        objectives: &data.objectives,
        front: data.front.iter().map(row).collect(),
        baseline: data.baseline.as_ref().map(row),
        obstacles: &data.obstacles,
        misses: data.misses.iter().map(row).collect(),
        generations: &data.generations,
        spread: &data.spread,
        config_toml: &data.config_toml,
        design_files: &data.design_files,
    };
    let mut meshes: BTreeMap<&str, Packed> = BTreeMap::new();
    for design in data.front.iter().chain(&data.misses).chain(&data.baseline) {
        if let Some(mesh) = &design.mesh {
            meshes.insert(&design.id, pack(&design.id, mesh)?);
        }
    }
    let libraries: String = LIBRARIES.iter().map(|code| format!("<script>{code}</script>\n")).collect();
    let licences: String = LICENCES.iter().map(|(name, text)| format!("{name}\n\n{text}\n\n")).collect();
    let parts = [
        ("title", html(&data.run.name)),
        ("style", STYLE.to_owned()),
        ("facts", json(&facts)?),
        ("meshes", json(&meshes)?),
        ("libraries", libraries),
        ("licences", html(&licences)),
        ("script", SCRIPTS.concat()),
    ];
    Ok(fill(TEMPLATE, &parts))
}

fn row(design: &Design) -> Row<'_> {
    Row {
        id: &design.id,
        string: &design.string,
        expressed: &design.expressed,
        generation: design.generation,
        feasible: design.feasible,
        reason: &design.reason,
        values: design.values.iter().map(|v| v.filter(|v| v.is_finite())).collect(),
        singularities: &design.singularities,
        symmetry: &design.symmetry,
        equal: design.equal,
        preferred: design.preferred,
        group: design.family,
    }
}

/// JSON that no HTML parser takes for markup: `<` cannot end the script element, nor start a comment in it.
fn json(value: &impl Serialize) -> Result<String, ReportError> {
    Ok(serde_json::to_string(value)?.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026"))
}

fn html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Replaces each `{{name}}` of the template; what is put in is not searched again.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let (name, tail) = after.split_once("}}").unwrap_or((after, ""));
        if let Some((_, text)) = parts.iter().find(|(n, _)| *n == name) {
            page.push_str(text);
        }
        rest = tail;
    }
    page.push_str(rest);
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_filled_in_is_not_filled_again() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "x".to_owned())];
        assert_eq!(fill("<{{a}}|{{b}}|{{c}}>", &parts), "<{{b}}|x|>");
    }

    #[test]
    fn markup_cannot_leave_the_data() {
        let text = json(&"</script><!--&").unwrap();
        assert!(!text.contains(['<', '>', '&']));
        assert_eq!(serde_json::from_str::<String>(&text).unwrap(), "</script><!--&");
    }
}
