//! `verify`: the tables of a results folder must say the same, and every row what its string gives.

use assert_cmd::Command;
use quadrille::output::consistency::contradictions;
use quadrille::output::load::load;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A small run, made once; each test changes its own copy.
fn finished_run() -> tempfile::TempDir {
    static RUN: OnceLock<PathBuf> = OnceLock::new();
    let original = RUN.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("verify_tables");
        let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml");
        let mut command = Command::cargo_bin("quadrille").unwrap();
        command.arg("run").arg(config).args(["--generations", "2", "--quiet", "--force", "--out"]);
        command.arg(&folder).assert().success();
        folder
    });
    let copy = tempfile::tempdir().unwrap();
    for name in ["manifest.json", "pareto.csv", "history.csv", "generations.csv"] {
        fs::copy(original.join(name), copy.path().join(name)).unwrap();
    }
    copy
}

type Table = Vec<Vec<String>>;

/// The line of `history.csv` with the design of a line of `pareto.csv`.
fn front_line(folder: &Path, history: &Table, line: usize) -> usize {
    let front = fs::read_to_string(folder.join("pareto.csv")).unwrap();
    let id = front.lines().nth(line).unwrap().split(',').next().unwrap();
    history.iter().position(|row| row[0] == id).unwrap()
}

fn change(folder: &Path, name: &str, change: impl FnOnce(&mut Table)) {
    let path = folder.join(name);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(&path).unwrap();
    let mut table: Table =
        reader.records().map(|record| record.unwrap().iter().map(str::to_owned).collect()).collect();
    change(&mut table);
    let mut writer = csv::Writer::from_path(&path).unwrap();
    table.iter().for_each(|row| writer.write_record(row).unwrap());
    writer.flush().unwrap();
}

fn column(table: &Table, name: &str) -> usize {
    table[0].iter().position(|column| column == name).unwrap()
}

/// What the tables are told to contradict each other in, after a change.
fn told(name: &str, edit: impl FnOnce(&mut Table)) -> Vec<String> {
    let folder = finished_run();
    change(folder.path(), name, edit);
    let loaded = load(folder.path()).unwrap();
    contradictions(folder.path(), &loaded).unwrap().into_iter().map(|found| found.message).collect()
}

fn set(column_name: &'static str, value: &'static str) -> impl FnOnce(&mut Table) {
    move |table| {
        let k = column(table, column_name);
        table[1][k] = value.into();
    }
}

#[test]
fn a_table_as_written_contradicts_nothing() {
    assert_eq!(told("pareto.csv", |_| ()), [""; 0]);
}

/// As an older version wrote it: without what came later.
#[test]
fn a_table_without_the_columns_of_later_versions_contradicts_nothing() {
    let folder = finished_run();
    for name in ["pareto.csv", "history.csv"] {
        change(folder.path(), name, |table| {
            for later in ["uplift_combination", "support_slide_combination"] {
                let k = column(table, later);
                table.iter_mut().for_each(|row| drop(row.remove(k)));
            }
        });
    }
    let loaded = load(folder.path()).unwrap();
    assert_eq!(loaded.lacking, ["uplift_combination", "support_slide_combination"]);
    assert_eq!(contradictions(folder.path(), &loaded).unwrap(), []);
    let verify = |folder: &Path| Command::cargo_bin("quadrille").unwrap().arg("verify").arg(folder).assert();
    verify(folder.path()).success();
    // A column that was always there is missed.
    change(folder.path(), "pareto.csv", |table| {
        let k = column(table, "deflection_m");
        table.iter_mut().for_each(|row| drop(row.remove(k)));
    });
    verify(folder.path()).failure();
}

#[test]
fn every_changed_cell_of_the_front_is_named() {
    for (name, value) in [
        ("id", "000000000000"),
        ("string", "TTTT"),
        ("expressed", "TTTT"),
        ("generation", "77"),
        ("feasible", "false"),
        ("deflection_m", "0.5"),
        ("edge_spread_m", "NaN"),
        ("mass_kg", ""),
        ("equal_designs", "7"),
    ] {
        let told = told("pareto.csv", set(name, value));
        let [message] = told.as_slice() else { panic!("{name}: {told:?}") };
        let shown = if value.is_empty() { "an empty cell" } else { value };
        assert!(message.starts_with("pareto.csv: line 2, "), "{message}");
        assert!(message.contains(&format!(": {name}: expected ")), "{message}");
        assert!(message.ends_with(&format!(", found {shown}")), "{message}");
    }
}

#[test]
fn the_same_number_written_otherwise_is_the_same() {
    let longer = |table: &mut Table| {
        let k = column(table, "edge_spread_m");
        table[1][k].push_str("000e0");
    };
    assert_eq!(told("pareto.csv", longer), [""; 0]);
}

#[test]
fn a_front_with_other_designs_is_told() {
    let less = told("pareto.csv", |table| drop(table.remove(2)));
    assert!(less.len() == 1 && less[0].ends_with("missing, but on the front according to history.csv"));
    let twice = told("pareto.csv", |table| table.push(table[1].clone()));
    assert!(twice.len() == 1 && twice[0].ends_with("listed a second time"), "{twice:?}");
    let equal = {
        let folder = finished_run();
        // A second design with the values of the first: a front lists only one of them.
        change(folder.path(), "history.csv", |table| {
            let (from, to) = (front_line(folder.path(), table, 1), front_line(folder.path(), table, 2));
            let first = column(table, "deflection_m");
            let values = table[from][first..].to_vec();
            table[to].splice(first.., values);
        });
        let messages = contradictions(folder.path(), &load(folder.path()).unwrap()).unwrap();
        messages.into_iter().map(|found| found.message).collect::<Vec<_>>()
    };
    let one = equal.iter().filter(|m| m.contains("equal to a design before it")).count();
    assert_eq!(one, 1, "{equal:?}");
    assert!(equal.iter().any(|m| m.ends_with("equal_designs: expected 2, found 1")), "{equal:?}");
    let none = told("pareto.csv", |table| table.truncate(1));
    assert!(none.len() > 1, "{none:?}");
    let swapped = told("pareto.csv", |table| table.iter_mut().for_each(|row| row.swap(7, 8)));
    assert!(swapped[0].starts_with("pareto.csv: line 1, column 8: expected deflection_m, found "));
}

#[test]
fn cells_of_the_history_follow_from_its_row() {
    for (name, value) in [("id", "000000000000"), ("feasible", "perhaps")] {
        let told = told("history.csv", set(name, value));
        assert!(told.len() == 1 && told[0].starts_with("history.csv: line 2, "), "{told:?}");
    }
}

/// `verify` on a changed folder: exit code and what it printed.
fn verify(name: &str, edit: impl FnOnce(&mut Table), more: &[&str]) -> (Option<i32>, String) {
    let folder = finished_run();
    change(folder.path(), name, edit);
    let mut command = Command::cargo_bin("quadrille").unwrap();
    let output = command.arg("verify").arg(folder.path()).args(more).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(text).unwrap())
}

#[test]
fn verify_ends_with_1_where_tables_differ_and_with_2_without_a_column() {
    let (code, text) = verify("pareto.csv", set("mass_kg", "1"), &[]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("mass_kg: expected ") && text.contains(" designs verified"), "{text}");
    let (code, text) = verify("pareto.csv", |table| table.truncate(1), &[]);
    assert!(code == Some(1) && text.contains("\n0 of "), "{code:?} {text}");
    let (code, text) = verify("pareto.csv", |table| table[0][7] = "deflection".into(), &[]);
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("pareto.csv: line 1: columns are missing: deflection_m"), "{text}");
}

#[test]
fn every_row_of_the_history_is_what_its_string_gives() {
    let (code, text) = verify("history.csv", |_| (), &["--design", ""]);
    assert!(code == Some(2), "{text}");
    let mut rows = Vec::new();
    told("history.csv", |table| rows = table.clone());
    for row in rows.iter().skip(1).step_by(5) {
        let (code, text) = verify("history.csv", |_| (), &["--design", &row[0]]);
        assert_eq!(code, Some(0), "{text}");
    }
}

#[test]
fn a_changed_reason_expressed_string_or_violation_is_noticed() {
    let failed = |table: &Table| {
        let stage = column(table, "violation_stage");
        (1..table.len()).find(|&k| table[k][stage] == "1").unwrap()
    };
    let mut id = String::new();
    told("history.csv", |table| id = table[failed(table)][0].clone());
    for (name, value) in [("reason", "no"), ("expressed", "T"), ("violation", "0.0625")] {
        let edit = |table: &mut Table| {
            let (row, k) = (failed(table), column(table, name));
            table[row][k] = value.into();
        };
        let (code, text) = verify("history.csv", edit, &["--design", &id]);
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains(&format!("{id}: {name}: file ")), "{text}");
    }
}

#[test]
fn a_changed_symmetry_is_noticed() {
    let mut id = String::new();
    let edit = |table: &mut Table| {
        let k = column(table, "symmetry");
        let row = table.iter_mut().skip(1).find(|row| row[k].contains("mirror-x")).unwrap();
        id.clone_from(&row[0]);
        row[k] = "mirror-y".into();
    };
    told("history.csv", edit);
    let edit = |table: &mut Table| {
        let k = column(table, "symmetry");
        table.iter_mut().find(|row| row[0] == id).unwrap()[k] = "mirror-y".into();
    };
    let (code, text) = verify("history.csv", edit, &["--design", &id]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains(&format!("{id}: symmetry: file \"mirror-y\", now \"mirror-x")), "{text}");
}

#[test]
fn an_empty_front_is_no_design_to_verify() {
    let empty = |table: &mut Table| table.truncate(1);
    let folder = finished_run();
    change(folder.path(), "pareto.csv", empty);
    change(folder.path(), "history.csv", empty);
    let mut command = Command::cargo_bin("quadrille").unwrap();
    let output = command.arg("verify").arg(folder.path()).assert().code(0);
    let printed = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert_eq!(printed, "no feasible design to verify: the front is empty\n");
}
