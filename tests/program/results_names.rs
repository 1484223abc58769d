//! What spreadsheets and table readers make of a results folder, and folders of other versions of the program.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

fn quadrille(arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("quadrille").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8([output.stdout.as_slice(), &output.stderr].concat()).unwrap()
}

fn run(folder: &Path, more: &[&str]) -> Output {
    let folder = folder.to_str().unwrap();
    quadrille(&[&["run", "configs/ci.toml", "--quiet", "--out", folder], more].concat())
}

/// A run of two generations, made once.
fn finished() -> &'static Path {
    static RUN: OnceLock<PathBuf> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("results_names");
        assert!(run(&folder, &["--generations", "2", "--force"]).status.success());
        folder
    })
}

/// Rows of a table with the names of its columns, cells still quoted as in the file.
fn raw(table: &Path) -> Vec<Vec<(String, String)>> {
    let text = fs::read_to_string(table).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().unwrap();
    lines.map(|cells| header.iter().cloned().zip(cells).collect()).collect()
}

/// The same run as quadrille 0.1 left it: no letter before ids and codes, an empty cell for the empty string, and the
/// journal under its name of then.
fn as_of_before(folder: &Path) {
    fn copy(from: &Path, to: &Path) {
        fs::create_dir_all(to).unwrap();
        for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
            let name = entry.file_name().into_string().unwrap();
            let old = match name.strip_prefix('q') {
                Some(digits) => digits.to_owned(),
                None => name.replace("evaluations.journal", "evaluations.jsonl"),
            };
            if entry.path().is_dir() {
                copy(&entry.path(), &to.join(old));
            } else {
                fs::copy(entry.path(), to.join(old)).unwrap();
            }
        }
    }
    copy(finished(), folder);
    for table in ["pareto.csv", "history.csv"] {
        let path = folder.join(table);
        let text = fs::read_to_string(&path).unwrap();
        let bare = |cell: &str| match (cell.strip_prefix('q'), cell) {
            (Some(digits), _) => digits.to_owned(),
            (None, "\"\"") => String::new(),
            (None, other) => other.to_owned(),
        };
        let lines = text.lines().map(|line| line.split(',').map(bare).collect::<Vec<_>>().join(",") + "\n");
        fs::write(&path, lines.collect::<String>()).unwrap();
    }
}

#[test]
fn no_id_and_no_code_is_a_number_and_no_string_is_missing() {
    for table in ["pareto.csv", "history.csv"] {
        let rows = raw(&finished().join(table));
        for (column, cell) in rows.iter().flatten() {
            let length = match column.as_str() {
                "id" => 13,
                "code" => 17,
                "string" | "expressed" => {
                    assert!(!cell.is_empty(), "{table}: a {column} that tools read as missing");
                    continue;
                }
                _ => continue,
            };
            assert!(cell.starts_with('q') && cell.len() == length, "{table}: {column} {cell}");
            assert!(cell[1..].chars().all(|c| c.is_ascii_hexdigit()), "{table}: {column} {cell}");
        }
    }
    let baseline = &raw(&finished().join("history.csv"))[0];
    assert!(baseline.contains(&("string".into(), "\"\"".into())), "{baseline:?}");
    // A feasible design has no reason, which is a missing value.
    assert!(baseline.contains(&("feasible".into(), "true".into())));
    assert!(
        fs::read_to_string(finished().join("history.csv")).unwrap().lines().nth(1).unwrap().ends_with(',')
    );
    for name in fs::read_dir(finished().join("designs")).unwrap().map(|entry| entry.unwrap().file_name()) {
        assert!(name.to_str().unwrap().starts_with('q'), "{name:?}");
    }
}

#[test]
fn a_folder_of_before_is_read_and_old_ids_are_understood() {
    let temporary = tempfile::tempdir().unwrap();
    let (old, new) = (temporary.path().join("old"), finished());
    as_of_before(&old);
    let folder = old.to_str().unwrap();
    let verified = quadrille(&["verify", folder]);
    assert!(verified.status.success(), "{}", said(&verified));
    let id = raw(&old.join("pareto.csv"))[1][0].1.clone();
    assert_eq!(id.len(), 12);
    for (folder, id) in
        [(old.as_path(), &id), (new, &id), (new, &format!("q{id}")), (&old, &format!("q{id}"))]
    {
        for id in [id.as_str(), &id[..7]] {
            let picture = temporary.path().join("p.svg");
            let told =
                quadrille(&["explain", folder.to_str().unwrap(), id, "--svg", picture.to_str().unwrap()]);
            let wanted = format!("design q{}", id.trim_start_matches('q'));
            assert!(said(&told).starts_with(&wanted), "{id}: {}", said(&told));
        }
    }
    // The page names designs as the folder's files are named.
    assert!(quadrille(&["report", folder]).status.success());
    let page = fs::read_to_string(old.join("report.html")).unwrap();
    assert!(page.contains(&format!("\"id\":\"{id}\"")) && page.contains(&format!("\"{id}\":{{\"vertices\"")));
}

#[test]
fn a_run_of_before_goes_on_as_one_of_now() {
    let temporary = tempfile::tempdir().unwrap();
    let [old, whole] = ["old", "whole"].map(|name| temporary.path().join(name));
    as_of_before(&old);
    let resumed = run(&old, &["--generations", "4", "--resume"]);
    assert!(resumed.status.success(), "{}", said(&resumed));
    assert!(run(&whole, &["--generations", "4"]).status.success());
    for table in ["pareto.csv", "history.csv", "generations.csv"] {
        assert_eq!(fs::read(old.join(table)).unwrap(), fs::read(whole.join(table)).unwrap(), "{table}");
    }
    assert!(!old.join("evaluations.journal").exists(), "the journal keeps its name");
}

#[test]
fn folders_of_later_versions_are_refused_and_left_alone() {
    let newer = |file: &str, from: &str, to: &str| {
        let folder = tempfile::tempdir().unwrap();
        for entry in fs::read_dir(finished()).unwrap().map(Result::unwrap).filter(|e| e.path().is_file()) {
            fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
        }
        let text = fs::read_to_string(folder.path().join(file)).unwrap();
        assert!(text.contains(from), "{file}");
        fs::write(folder.path().join(file), text.replacen(from, to, 1)).unwrap();
        folder
    };
    let manifest = newer("manifest.json", "\"manifest_version\": 1", "\"manifest_version\": 2");
    let path = manifest.path().to_str().unwrap();
    let before = fs::read(manifest.path().join("history.csv")).unwrap();
    for output in [
        quadrille(&["report", path]),
        quadrille(&["verify", path]),
        quadrille(&["explain", path, "q"]),
        run(manifest.path(), &["--resume"]),
        run(manifest.path(), &["--force"]),
        run(manifest.path(), &[]),
    ] {
        let told = said(&output);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains("manifest_version 2") && told.contains("reads up to 1"), "{told}");
    }
    assert_eq!(fs::read(manifest.path().join("history.csv")).unwrap(), before);
    let checkpoint = newer("checkpoint.json", "{\"version\":2", "{\"version\":7");
    let journal = fs::read(checkpoint.path().join("evaluations.journal")).unwrap();
    let refused = run(checkpoint.path(), &["--resume", "--generations", "3"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(said(&refused).contains("a later version of quadrille wrote it (its format is 7)"));
    assert_eq!(fs::read(checkpoint.path().join("evaluations.journal")).unwrap(), journal);
}

/// Values of a field of a VTU file.
fn field(vtu: &str, name: &str) -> String {
    let (_, after) = vtu.split_once(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("no field {name}"));
    after.split_once('>').unwrap().1.split_once('<').unwrap().0.trim().to_owned()
}

#[test]
fn utilisation_is_the_same_in_every_column_whatever_the_order() {
    for order in ["1", "2"] {
        let folder = tempfile::tempdir().unwrap();
        let (out, set) = (folder.path().to_str().unwrap(), format!("structure.order={order}"));
        assert!(
            quadrille(&["evaluate", "configs/ci.toml", "--string", "ATTA", "--set", &set, "--out", out])
                .status
                .success()
        );
        let designs = fs::read_dir(folder.path().join("designs")).unwrap().map(|entry| entry.unwrap().path());
        let files: Vec<PathBuf> = designs.collect();
        let of = |ending: &str| files.iter().find(|path| path.to_str().unwrap().ends_with(ending)).unwrap();
        let vtu = fs::read_to_string(of("_members.vtu")).unwrap();
        assert_eq!(field(&vtu, "utilisation"), field(&vtu, "uls_utilisation"), "order {order}");
        for row in raw(of("_members.csv")) {
            let cell = |name: &str| &row.iter().find(|(column, _)| column == name).unwrap().1;
            assert_eq!(cell("utilisation"), cell("uls_utilisation"), "order {order}");
        }
    }
}
