//! Issue 7: every number carries its unit, and the same number is the same everywhere: in every table, in the report, in
//! Design Explorer's table, in what `evaluate` says, and in the structural results of a design.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use quadrille::objectives::METRICS;
use serde_json::Value;

type Row = BTreeMap<String, String>;

fn quadrille(arguments: &[&str], folder: &Path) {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_quadrille"));
    command.arg(arguments[0]).arg(config).args(&arguments[1..]).current_dir(folder);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn rows(file: &Path) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    reader.deserialize().map(|row| row.unwrap()).collect()
}

fn numbers(rows: &[Row], column: &str) -> Vec<f64> {
    rows.iter()
        .map(|row| row[column].parse().unwrap_or_else(|_| panic!("{column}: {}", row[column])))
        .collect()
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

/// Equal as far as 10 significant digits say.
fn close(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() <= 2e-9 * a.abs().max(b.abs()), "{what}: {a} and {b}");
}

/// The values of a field of a VTU file.
fn field(text: &str, name: &str) -> Vec<f64> {
    let after = text.split_once(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("no {name}")).1;
    let body = after.split_once('>').unwrap().1.split_once('<').unwrap().0;
    body.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

#[test]
fn the_same_number_is_the_same_everywhere() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path().join("r");
    quadrille(&["run", "--out", "r", "--generations", "2", "--quiet"], temporary.path());
    let front = rows(&folder.join("pareto.csv"));
    let design = front.iter().find(|row| !row["string"].is_empty()).unwrap();

    let history = rows(&folder.join("history.csv"));
    let recorded = history.iter().find(|row| row["id"] == design["id"]).unwrap();
    quadrille(&["evaluate", "--string", &design["string"], "--out", "e"], temporary.path());
    let evaluated = &rows(&temporary.path().join("e/evaluation.csv"))[0];
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    let facts = page.split_once("id=\"facts-data\">").unwrap().1.split_once("</script>").unwrap().0;
    let facts: Value = serde_json::from_str(facts).unwrap();
    let shown = facts["front"].as_array().unwrap().iter().find(|d| d["id"] == design["id"].as_str()).unwrap();
    let place = front.iter().position(|row| row["id"] == design["id"]).unwrap();
    let explorer = &rows(&folder.join("design_explorer/data.csv"))[place];

    let listed = facts["metrics"].as_array().unwrap();
    // Without unit figures there is neither cost nor carbon.
    let told = || METRICS.iter().filter(|metric| !["cost", "carbon"].contains(&metric.name));
    assert_eq!(listed.len(), told().count());
    assert!(design["cost"].is_empty() && design["carbon_kg"].is_empty());
    for metric in told() {
        let value = &design[metric.column];
        assert_eq!(&recorded[metric.column], value, "history.csv: {}", metric.column);
        assert_eq!(&evaluated[metric.column], value, "evaluate: {}", metric.column);
        let index = listed.iter().position(|m| m["column"] == metric.column).unwrap();
        assert_eq!(listed[index]["unit"], metric.unit);
        let value: f64 = value.parse().unwrap();
        assert_eq!(shown["values"][index].as_f64(), Some(value), "report: {}", metric.column);
        let bracketed = if metric.unit.is_empty() {
            metric.name.into()
        } else {
            format!("{}[{}]", metric.name, metric.unit)
        };
        let explored = explorer.get(&format!("out:{bracketed}")).or(explorer.get(&format!("in:{bracketed}")));
        assert_eq!(explored.map(|text| text.parse().unwrap()), Some(value), "explorer: {bracketed}");
    }
    structural_results(&folder.join("designs"), design);
}

/// The metrics of a design from its nodes and members.
fn structural_results(designs: &Path, design: &Row) {
    let metric = |column: &str| -> f64 { design[column].parse().unwrap() };
    let file = |ending: &str| designs.join(format!("{}{ending}", design["id"]));
    let nodes = rows(&file("_nodes.csv"));
    let members = rows(&file("_members.csv"));
    let [x, y, z] = ["sls_ux_m", "sls_uy_m", "sls_uz_m"].map(|column| numbers(&nodes, column));
    let moved = (0..nodes.len()).map(|n| (x[n] * x[n] + y[n] * y[n] + z[n] * z[n]).sqrt());
    close(largest(moved), metric("deflection_m"), "nodes.csv: deflection");
    close(largest(z.iter().map(|z| z.abs())), metric("deflection_vertical_m"), "nodes.csv: vertical");
    close(numbers(&members, "length_m").iter().sum(), metric("member_length_m"), "members.csv: length");
    let used = members.iter().filter(|row| row["in_utilisation"] == "true");
    let used = used.map(|row| row["utilisation"].parse::<f64>().unwrap());
    close(largest(used), metric("utilisation"), "members.csv: utilisation");
    assert_eq!((nodes.len(), members.len()), (metric("nodes") as usize, metric("members") as usize));

    let panels_vtu = fs::read_to_string(file(".vtu")).unwrap();
    let members_vtu = fs::read_to_string(file("_members.vtu")).unwrap();
    for text in [&panels_vtu, &members_vtu] {
        let vectors = field(text, "sls_displacement_m");
        let moved: Vec<f64> = vectors.chunks(3).flatten().copied().collect();
        let table: Vec<f64> = (0..nodes.len()).flat_map(|n| [x[n], y[n], z[n]]).collect();
        assert_eq!(moved, table, "displacements in a VTU file and in nodes.csv");
    }
    assert_eq!(field(&members_vtu, "length_m"), numbers(&members, "length_m"));
    assert_eq!(field(&members_vtu, "utilisation"), numbers(&members, "utilisation"));
    assert_eq!(field(&panels_vtu, "curvature").len(), metric("faces") as usize);
    let types = field(&panels_vtu, "types");
    for (name, column) in [("curvature", "curvature"), ("skewness", "skewness")] {
        // The metrics are means over the quads (VTK type 9).
        let quads: Vec<f64> = field(&panels_vtu, name)
            .into_iter()
            .zip(&types)
            .filter(|(_, t)| **t == 9.0)
            .map(|(v, _)| v)
            .collect();
        close(quads.iter().sum::<f64>() / quads.len() as f64, metric(column), name);
    }
}

/// How a name ends when its number has this unit.
const UNITS: [(&str, &str); 7] =
    [("m", "_m"), ("kg", "_kg"), ("kN", "_kn"), ("m²", "_m2"), ("°", "_deg"), ("kg/m²", "_kg_m2"), ("", "")];

#[test]
fn every_metric_has_its_unit_in_its_name() {
    for metric in METRICS {
        let ending = UNITS.iter().find(|(unit, _)| *unit == metric.unit);
        let ending = ending.unwrap_or_else(|| panic!("{}: unknown unit {}", metric.column, metric.unit)).1;
        assert_eq!(metric.column, format!("{}{ending}", metric.name));
    }
}
