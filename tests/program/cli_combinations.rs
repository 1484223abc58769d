//! Combinations of loads from outside: what nobody checks is warned of, and what governs is a column.

use assert_cmd::Command;
use std::path::Path;

/// The small config, with a combination that is far beyond what its sections carry.
fn config(requirements: &str) -> String {
    let ci = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml")).unwrap();
    format!(
        "{ci}\n[structure.combinations]\n\
         sls = {{ self_weight = 1.0, glass = 1.0, snow = 1.0 }}\n\
         storm = {{ self_weight = 1.0, glass = 1.0, snow = 8.0 }}\n\
         uls = {{ self_weight = 1.35, glass = 1.35, snow = 1.5 }}\n{requirements}"
    )
}

fn requirement(quantity: &str, combination: &str, limit: &str) -> String {
    format!(
        "[[structure.requirement]]\nquantity = \"{quantity}\"\ncombination = \"{combination}\"\n{limit}\n"
    )
}

fn quadrille(folder: &Path, arguments: &[&str]) -> (String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_quadrille")).current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (text(output.stdout), text(output.stderr))
}

/// The cell of the first design of a table.
fn cell(table: &Path, column: &str) -> String {
    let mut reader = csv::Reader::from_path(table).unwrap();
    let at = reader.headers().unwrap().iter().position(|name| name == column);
    let record = reader.records().next().unwrap().unwrap();
    record[at.unwrap_or_else(|| panic!("no column {column} in {}", table.display()))].to_owned()
}

#[test]
fn a_combination_that_no_requirement_names_is_warned_of_by_check_and_run() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("roof.toml"), config("")).unwrap();
    let warning = "structure.combinations: no [[structure.requirement]] names storm";
    let run = ["run", "roof.toml", "--generations", "1", "--out", "results"];
    for arguments in [&["check", "roof.toml"][..], &run] {
        let (_, err) = quadrille(folder.path(), arguments);
        assert!(err.contains(warning), "{arguments:?}: {err}");
    }
    let asked = [
        requirement("deflection", "sls", "max = 1.0"),
        requirement("utilisation", "uls", "max = 1.0"),
        requirement("utilisation", "storm", "max = 1.0"),
    ];
    std::fs::write(folder.path().join("roof.toml"), config(&asked.concat())).unwrap();
    let (_, err) = quadrille(folder.path(), &["check", "roof.toml"]);
    assert!(!err.contains("structure.combinations"), "{err}");
}

#[test]
fn tables_say_which_combination_governs_whatever_the_order() {
    let folder = tempfile::tempdir().unwrap();
    let mut asked = [
        requirement("deflection", "sls", "max = 1.0"),
        requirement("utilisation", "uls", "max = 9.0"),
        requirement("utilisation", "storm", "max = 9.0"),
        requirement("buckling_factor", "uls", "min = 0.1"),
        requirement("buckling_factor", "storm", "min = 0.1"),
    ];
    let mut values = Vec::new();
    for _ in 0..2 {
        std::fs::write(folder.path().join("roof.toml"), config(&asked.concat())).unwrap();
        let out = format!("out{}", values.len());
        let (text, err) = quadrille(folder.path(), &["evaluate", "roof.toml", "--string", "", "--out", &out]);
        assert!(text.contains("utilisation_combination") && err.is_empty(), "{text}{err}");
        let table = folder.path().join(&out).join("evaluation.csv");
        assert_eq!(cell(&table, "utilisation_combination"), "storm");
        assert_eq!(cell(&table, "buckling_combination"), "storm");
        assert_eq!(cell(&table, "deflection_combination"), "sls");
        // What no requirement names follows its kin; a pull on supports is that of any combination.
        for (column, combination) in [
            ("deflection_vertical_combination", "sls"),
            ("support_slide_combination", "sls"),
            ("utilisation_all_combination", "storm"),
            ("utilisation_von_mises_combination", "storm"),
        ] {
            assert_eq!(cell(&table, column), combination, "{column}");
        }
        let designs = std::fs::read_dir(folder.path().join(&out).join("designs")).unwrap();
        let members = designs
            .map(|file| file.unwrap().path())
            .find(|path| path.to_string_lossy().ends_with("_members.csv"));
        let members = members.unwrap();
        assert!(["storm", "uls"].contains(&cell(&members, "utilisation_combination").as_str()));
        let worst = ["uls_utilisation", "storm_utilisation"]
            .map(|column| cell(&members, column).parse::<f64>().unwrap());
        assert_eq!(cell(&members, "utilisation").parse::<f64>().unwrap(), worst[0].max(worst[1]));
        values.push(["utilisation", "utilisation_all", "buckling"].map(|column| cell(&table, column)));
        asked.reverse();
    }
    assert_eq!(values[0], values[1]);
    let run = ["run", "roof.toml", "--generations", "1", "--out", "results", "--quiet"];
    quadrille(folder.path(), &run);
    for table in ["pareto.csv", "history.csv"] {
        assert_eq!(cell(&folder.path().join("results").join(table), "utilisation_combination"), "storm");
    }
    // They are part of what is loaded again.
    let (text, err) = quadrille(folder.path(), &["verify", "results"]);
    assert!(text.contains("designs verified"), "{text}{err}");
}
