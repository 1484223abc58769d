//! Promises of `report.html`: one file, no network, the data whole and safely embedded, the same bytes every time.
//! What it looks like and how it behaves is driven in a browser: `tests/report_browser/`.

use crate::synthetic;
use quadrille::output::report::{ReportData, ReportError, render};
use serde_json::Value;

fn small() -> ReportData {
    synthetic::run(4, 60)
}

/// The text of the script element with this id.
fn embedded<'a>(page: &'a str, id: &str) -> &'a str {
    let start = format!("<script type=\"application/json\" id=\"{id}\">");
    let after = page.split_once(&start).map(|(_, after)| after);
    after.and_then(|after| after.split_once("</script>")).expect("the page has this element").0
}

#[test]
fn nothing_is_loaded_from_elsewhere() {
    let page = render(&small()).unwrap();
    for loads in [
        "src=\"http",
        "href=\"http",
        "src=\"//",
        "@import",
        "url(http",
        "<link rel=\"stylesheet\"",
        "import(",
    ] {
        assert!(!page.contains(loads), "{loads}");
    }
    assert!(page.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';"));
}

#[test]
fn the_embedded_data_parses_back() {
    let data = small();
    let page = render(&data).unwrap();
    let facts: Value = serde_json::from_str(embedded(&page, "facts-data")).unwrap();
    assert_eq!(facts["config_toml"], data.config_toml);
    assert_eq!(facts["run"]["seed"], "18446744073709551615");
    for (row, design) in facts["front"].as_array().unwrap().iter().zip(&data.front) {
        assert_eq!(row["string"], design.string);
        let values: Vec<Option<f64>> = serde_json::from_value(row["values"].clone()).unwrap();
        assert_eq!(values, design.values);
        assert_eq!(
            (&row["symmetry"], &row["equal"]),
            (&design.symmetry.as_str().into(), &design.equal.into())
        );
    }
    let meshes: Value = serde_json::from_str(embedded(&page, "mesh-data")).unwrap();
    assert_eq!(meshes.as_object().unwrap().len(), 5);
}

#[test]
fn text_cannot_become_markup() {
    let mut data = small();
    data.run.name = "<img onerror=x>{{script}}".to_owned();
    data.front[0].string = "</script><!--<script>".to_owned();
    let page = render(&data).unwrap();
    assert!(page.contains("<h1>&lt;img onerror=x&gt;{{script}}</h1>"));
    assert!(!page.contains("</script><!--"));
    assert!(!page.contains("<script>alert(1)"));
    let facts: Value = serde_json::from_str(embedded(&page, "facts-data")).unwrap();
    assert_eq!(facts["front"][0]["string"], "</script><!--<script>");
}

#[test]
fn what_is_not_finite_is_null() {
    let mut data = small();
    data.front[1].values[0] = Some(f64::NAN);
    data.front[1].values[1] = Some(f64::INFINITY);
    let facts: Value = serde_json::from_str(embedded(&render(&data).unwrap(), "facts-data")).unwrap();
    assert!(facts["front"][1]["values"][0].is_null() && facts["front"][1]["values"][1].is_null());
}

#[test]
fn the_same_data_gives_the_same_bytes() {
    assert_eq!(render(&small()).unwrap(), render(&small()).unwrap());
}

#[test]
fn two_hundred_designs_of_two_thousand_panels_stay_below_fifteen_megabytes() {
    let page = render(&synthetic::run(200, 2_000)).unwrap();
    assert!(page.len() < 15_000_000, "{} bytes", page.len());
    assert!(page.len() > 5_000_000, "the meshes are missing: {} bytes", page.len());
}

#[test]
fn counts_that_do_not_fit_are_refused_by_name() {
    let mut data = small();
    data.front[2].values.pop();
    let wrong = render(&data).unwrap_err();
    assert!(matches!(&wrong, ReportError::Values { found: 7, expected: 8, .. }), "{wrong}");
    let mut data = small();
    data.objectives.push(8);
    assert!(matches!(render(&data).unwrap_err(), ReportError::Objective { index: 8, metrics: 8 }));
}

/// Writes pages for the browser's test: `cargo test --release --test program report_page -- --ignored`.
#[test]
#[ignore = "writes target/report/*.html for tests/report_browser"]
fn pages_for_the_browser() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("target/report");
    std::fs::create_dir_all(&folder).unwrap();
    let mut empty = small();
    (empty.front, empty.generations, empty.baseline) = (Vec::new(), Vec::new(), None);
    empty.obstacles.clear();
    let mut bare = small();
    bare.objectives.truncate(1);
    for design in bare.front.iter_mut().chain(&mut bare.baseline) {
        design.mesh = None;
    }
    let pages = [
        ("large", synthetic::run(200, 2_000)),
        ("small", small()),
        ("bare", bare),
        ("empty", empty),
        ("missed", synthetic::without_front(6, 500)),
    ];
    for (name, data) in pages {
        std::fs::write(folder.join(format!("{name}.html")), render(&data).unwrap()).unwrap();
    }
}
