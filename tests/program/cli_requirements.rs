//! Limits on any metric, unit figures, and objectives that are better large, as a user writes them.

use assert_cmd::Command;
use std::path::Path;
use std::process::Output;

/// The small config with some of its text replaced and more at its end.
fn config(from: &str, to: &str, more: &str) -> String {
    let ci = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml")).unwrap();
    assert!(ci.contains(from));
    format!("{}\n{more}", ci.replace(from, to))
}

fn quadrille(folder: &Path, arguments: &[&str]) -> (String, String, Option<i32>) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_quadrille"));
    let Output { status, stdout, stderr } = command.current_dir(folder).args(arguments).output().unwrap();
    (String::from_utf8(stdout).unwrap(), String::from_utf8(stderr).unwrap(), status.code())
}

/// What `check` says of a config that it refuses.
fn refused(text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("roof.toml"), text).unwrap();
    let (_, told, code) = quadrille(folder.path(), &["check", "roof.toml"]);
    assert_eq!(code, Some(2), "{told}");
    told
}

/// The cells of every row in a column.
fn column(table: &Path, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_path(table).unwrap();
    let at = reader.headers().unwrap().iter().position(|heading| heading == name);
    let at = at.unwrap_or_else(|| panic!("no column {name}"));
    reader.records().map(|record| record.unwrap()[at].to_owned()).collect()
}

fn numbers(table: &Path, name: &str) -> Vec<f64> {
    column(table, name).iter().map(|cell| cell.parse().unwrap()).collect()
}

fn requirement(quantity: &str, rest: &str) -> String {
    format!("[[structure.requirement]]\nquantity = \"{quantity}\"\n{rest}\n")
}

/// The initial mesh of the small config under one more requirement or limit: whether it is feasible, and why not.
fn judged(more: &str) -> (bool, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("roof.toml"), config("", "", more)).unwrap();
    let evaluate = ["evaluate", "roof.toml", "--string", "", "--out", "out"];
    let (_, told, code) = quadrille(folder.path(), &evaluate);
    assert_eq!(code, Some(0), "{told}");
    let table = folder.path().join("out/evaluation.csv");
    (column(&table, "feasible")[0] == "true", column(&table, "reason")[0].clone())
}

#[test]
fn any_metric_can_be_required_and_any_of_geometry_be_a_limit_of_the_pattern() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("roof.toml"), config("", "", "")).unwrap();
    quadrille(folder.path(), &["evaluate", "roof.toml", "--string", "", "--out", "out"]);
    let table = folder.path().join("out/evaluation.csv");
    let own = |name: &str| numbers(&table, name)[0];
    // A hundredth over and under what the design has: kept, and exceeded by 1 % of it, by either name of the metric.
    for (quantity, column, combination) in [
        ("mass_kg", "mass_kg", ""),
        ("panel_warp_max_m", "panel_warp_max_m", ""),
        ("panel_warp_max", "panel_warp_max_m", ""),
        ("distinct_panels", "distinct_panels", ""),
        ("support_slide_m", "support_slide_m", "combination = \"sls\""),
        ("utilisation_all", "utilisation_all", "combination = \"uls\""),
        ("buckling", "buckling", "combination = \"uls\""),
    ] {
        let value = own(column);
        let of = |limit: String| judged(&requirement(quantity, &format!("{combination}\n{limit}")));
        if value == 0.0 {
            continue;
        }
        assert_eq!(of(format!("max = {}", 1.01 * value)), (true, String::new()), "{quantity}");
        let (feasible, reason) = of(format!("max = {}", 0.99 * value));
        assert!(!feasible && reason.contains("(limit "), "{quantity}: {reason}");
        let (feasible, _) = of(format!("min = {}", 1.01 * value));
        assert!(!feasible, "{quantity}");
    }
    let warp = own("panel_warp_max_m");
    assert!(warp > 0.0);
    let limit = |max: f64| format!("[[pattern.limit]]\nquantity = \"panel_warp_max_m\"\nmax = {max}\n");
    assert!(judged(&limit(1.01 * warp)).0);
    let (feasible, reason) = judged(&limit(0.5 * warp));
    assert!(!feasible && reason.starts_with("panel_warp_max_m "), "{reason}");
}

#[test]
fn bad_names_and_combinations_that_are_none_are_refused_with_the_right_one() {
    let told = refused(&config("", "", &requirement("panel_warp_mx_m", "max = 0.02")));
    assert!(told.contains("no metric \"panel_warp_mx_m\", did you mean `panel_warp_max`?"), "{told}");
    let told = refused(&config("", "", &requirement("mass", "combination = \"uls\"\nmax = 1.0")));
    assert!(
        told.contains("combination: found \"uls\", but mass is no matter of loads; leave it out"),
        "{told}"
    );
    let told = refused(&config("", "", &requirement("deflection", "max = 1.0")));
    assert!(told.contains("combination: missing; allowed: sls, uls"), "{told}");
    let told = refused(&config("", "", "[[pattern.limit]]\nquantity = \"uplift\"\nmax = 1.0\n"));
    assert!(
        told.contains("\"uplift\", which needs a frame analysis; allowed as a [[structure.req"),
        "{told}"
    );
    let told = refused(&config("", "", "[[pattern.limit]]\nquantity = \"cost\"\nmax = 1.0\n"));
    assert!(told.contains("\"cost\", which needs unit figures in [fabrication]"), "{told}");
    let axes = "ideal = [0.0, 0.0, 0.0]       # fixed, so that the hypervolume is known from the first generation\n\
                reference = [0.15, 0.02, 1.5]";
    let given = format!("minimise = [\"deflection\", \"curvature\", \"edge_spread\"]\n{axes}");
    let told = refused(&config(&given, "minimise = [\"mass_kg\"]", ""));
    assert!(told.contains("no objective \"mass_kg\"; did you mean \"mass\"?"), "{told}");
    let told = refused(&config(&given, "maximise = [\"buckling\", \"edge_min\"]", ""));
    assert!(told.contains("did you mean \"buckling_factor\"?"), "{told}");
    let told = refused(&config(&given, "minimise = [\"edge_min\"]", ""));
    assert!(told.contains("or maximise = [\"edge_min\"]"), "{told}");
    let told = refused(&config(&given, "minimise = [\"mass\"]\nmaximise = [\"mass\"]", ""));
    assert!(told.contains("objectives.maximise[0]: found \"mass\" a second time"), "{told}");
    let told = refused(&config(
        &given,
        "minimise = [\"mass\"]\nmaximise = [\"angle_min\"]\nideal = [0.0, 10.0]\nreference = [9e4, 90.0]",
        "",
    ));
    assert!(told.contains("objectives.reference[1]: found 90; allowed: less than the ideal, 10"), "{told}");
}

/// Cost = 4 × mass + 100 × area + 50 × kinds of panels; carbon = 1.5 × mass.
#[test]
fn cost_and_carbon_are_the_sums_of_their_figures() {
    let folder = tempfile::tempdir().unwrap();
    let figures = "[fabrication]\nsteel_per_kg = 4.0\nglass_per_m2 = 100.0\ndistinct_panel_each = 50.0\n\
                   carbon = { steel_per_kg = 1.5 }\n";
    std::fs::write(folder.path().join("roof.toml"), config("", "", figures)).unwrap();
    quadrille(
        folder.path(),
        &["evaluate", "roof.toml", "--string", "", "--string", "A*TPTTTPTA", "--out", "out"],
    );
    let table = folder.path().join("out/evaluation.csv");
    let [mass, area, panels, kinds] =
        ["mass_kg", "panel_area_mean_m2", "faces", "distinct_panels"].map(|name| numbers(&table, name));
    for (k, cost) in numbers(&table, "cost").into_iter().enumerate() {
        let expected = 4.0 * mass[k] + 100.0 * area[k] * panels[k] + 50.0 * kinds[k];
        assert!((cost / expected - 1.0).abs() < 1e-9, "{cost} {expected}");
        assert!((numbers(&table, "carbon_kg")[k] / (1.5 * mass[k]) - 1.0).abs() < 1e-9);
    }
    // The paraboloid over a square has eight symmetries; its initial grid is made of about an eighth as many kinds.
    assert!(
        kinds[0] > 1.0 && kinds[0] <= (panels[0] / 8.0).ceil() + panels[0].sqrt(),
        "{kinds:?} {panels:?}"
    );
}

/// Of the same designs those that are not dominated are the same, whether the factor is maximised or its inverse minimised.
#[test]
fn what_is_maximised_is_told_as_it_is_and_everything_works() {
    let folder = tempfile::tempdir().unwrap();
    let given = "minimise = [\"deflection\", \"curvature\", \"edge_spread\"]";
    let axes = "ideal = [0.0, 0.0, 0.0]       # fixed, so that the hypervolume is known from the first generation\n\
                reference = [0.15, 0.02, 1.5]";
    let run = |name: &str, generations: &str, objectives: &str| {
        let text = config(&format!("{given}\n{axes}"), objectives, "");
        std::fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
        let arguments =
            ["run", &format!("{name}.toml"), "--generations", generations, "--out", name, "--quiet"];
        let (_, told, code) = quadrille(folder.path(), &arguments);
        assert_eq!(code, Some(0), "{told}");
        folder.path().join(name)
    };
    let factor = "minimise = [\"curvature\"]\nmaximise = [\"buckling_factor\"]\nideal = [0.0, 40.0]\nreference = [0.02, 0.0]\n\
                  weights = [1.0, 2.0]";
    let fronts =
        [run("factor", "0", factor), run("inverse", "0", "minimise = [\"curvature\", \"buckling\"]")];
    let [strings, of_inverse] = fronts.map(|folder| column(&folder.join("pareto.csv"), "string"));
    assert!(strings.len() > 1);
    assert_eq!(strings, of_inverse);
    let largest = run("largest", "2", factor);
    let factors = numbers(&largest.join("pareto.csv"), "buckling_factor");
    let all = numbers(&largest.join("history.csv"), "buckling_factor");
    assert!(factors.len() > 1 && factors.iter().all(|&factor| factor > 0.0), "{factors:?}");
    let most = all.iter().copied().fold(0.0, f64::max);
    assert_eq!(factors.iter().copied().fold(0.0, f64::max), most, "the best of all is on the front");
    let last = numbers(&largest.join("generations.csv"), "best_buckling_factor").pop().unwrap();
    assert!(last > 0.0 && last <= most);
    let volumes = numbers(&largest.join("generations.csv"), "hypervolume");
    assert!(volumes[0] > 0.0 && volumes.is_sorted(), "{volumes:?}");
    // Preferred: of more weight on the factor the largest comes first here, and every place once.
    let mut places = numbers(&largest.join("pareto.csv"), "preferred");
    places.sort_by(f64::total_cmp);
    assert_eq!(places, (1..=places.len()).map(|k| k as f64).collect::<Vec<_>>());
    let (text, told, code) = quadrille(folder.path(), &["verify", "largest"]);
    assert_eq!((code, text.contains("designs verified")), (Some(0), true), "{text}{told}");
    let id = &column(&largest.join("pareto.csv"), "id")[0];
    let (text, ..) = quadrille(folder.path(), &["explain", "largest", id]);
    let line = text.lines().find(|line| line.trim_start().starts_with("buckling_factor")).unwrap();
    assert!(!line.contains('-'), "{line}");
    let page = std::fs::read_to_string(largest.join("report.html")).unwrap();
    assert_eq!(page.matches("\"maximised\":true").count(), 1);
    let (text, ..) = quadrille(folder.path(), &["axes", "largest.toml", "--designs", "30"]);
    let list = |key: &str| -> Vec<f64> {
        let line = text.lines().find_map(|line| line.strip_prefix(key)).unwrap();
        line.trim_matches([' ', '=', '[', ']']).split(", ").map(|x| x.parse().unwrap()).collect()
    };
    let (ideal, reference) = (list("ideal"), list("reference"));
    assert!(ideal[0] < reference[0] && ideal[1] > reference[1] && reference[1] > 0.0, "{text}");
}
