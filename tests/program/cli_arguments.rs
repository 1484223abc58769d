//! Arguments that cannot be meant: exit 2, what was found, what is allowed; and odd ones that can.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn ci() -> String {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml");
    path.to_str().unwrap().to_owned()
}

fn quadrille(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_quadrille")).args(arguments).current_dir(folder).output().unwrap()
}

/// Refused with exit 2 and these words.
fn refused(folder: &Path, arguments: &[&str], words: &str) {
    let output = quadrille(folder, arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(words), "{arguments:?}: {message}");
    assert!(!message.contains(".quadrille-"), "{arguments:?}: {message}");
}

#[test]
fn places_that_cannot_be_written_are_refused_before_anything_is_evaluated() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let ci = ci();
    fs::write(folder.join("afile"), "").unwrap();
    refused(folder, &["run", &ci, "--out", "afile"], "--out afile: a file; allowed: a folder");
    refused(folder, &["run", &ci, "--out", "afile/x"], "afile/x");
    let evaluate = ["evaluate", &ci, "--string", "", "--out", "afile"];
    let export = ["export", "done", "--design", "0", "--format", "obj", "--out", "afile"];
    for arguments in [&evaluate[..], &export[..], &["man", "--out", "afile"]] {
        refused(folder, arguments, "--out afile: a file; allowed: a folder");
    }
    // Named by mistake: a config, and a table of somebody else's.
    fs::write(folder.join("mine.toml"), "mine").unwrap();
    let neighbours = ["neighbours", &ci, "--string", "", "--out", "mine.toml"];
    refused(folder, &neighbours, "is there and does not end in .csv");
    refused(folder, &["explain", "done", "0", "--svg", "mine.toml"], "is there and does not end in .svg");
    fs::create_dir(folder.join("others")).unwrap();
    fs::write(folder.join("others/evaluation.csv"), "mine").unwrap();
    let evaluate = ["evaluate", &ci, "--string", "", "--out", "others"];
    refused(folder, &evaluate, "its evaluation.csv was not written by `evaluate`");
    assert_eq!(fs::read(folder.join("mine.toml")).unwrap(), b"mine");
    assert_eq!(fs::read(folder.join("others/evaluation.csv")).unwrap(), b"mine");
    refused(folder, &["init", "a/b"], "there is no folder a");
    refused(folder, &["init", ""], "found the name \"\"");
    refused(folder, &["init", "--", "-x"], "found the name \"-x\"");
    let neighbours = ["neighbours", &ci, "--string", ""];
    let with = |more: [&'static str; 2]| [neighbours.as_slice(), more.as_slice()].concat();
    refused(folder, &with(["--out", "nowhere/n.csv"]), "there is no folder nowhere");
    refused(folder, &with(["--edges", "0"]), "--edges");
    fs::create_dir(folder.join("done")).unwrap();
    fs::write(folder.join("done/manifest.json"), "{}").unwrap();
    refused(folder, &["evaluate", &ci, "--string", "", "--out", "done"], "the results folder of a run");
}

#[test]
fn numbers_below_zero_and_files_of_another_kind_are_named() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let ci = ci();
    for option in ["--threads", "--seed", "--generations"] {
        refused(folder, &["run", &ci, option, "-1"], "invalid value '-1'");
    }
    refused(folder, &["distance", &ci, "--a", "A", "--b", "A", "--max", "-1"], "invalid value '-1'");
    refused(
        folder,
        &["check", &ci, "--set", "topology.initial={grid=[0,2]}"],
        "a list (2) of: a whole number ≥ 1\n",
    );
    refused(
        folder,
        &["check", &ci, "--set", "structure.support[0].at=\"loop = 1\""],
        "or loop = 0, 1, … instead of at",
    );
    refused(folder, &["check", &ci, "--set", "surface.rise_m=inf"], "found inf; allowed: a finite number");
    refused(folder, &["check", "nowhere.toml"], "`quadrille init` writes one");
    for (text, words) in [
        ("[]", "expected an object with the keys"),
        ("{}", "missing key"),
        ("5", "expected an object with the keys"),
        ("x", "b.json: expected value at line 1"),
    ] {
        fs::write(folder.join("b.json"), text).unwrap();
        refused(folder, &["decode", "--base", "b.json", "--string", "A"], words);
        refused(folder, &["frame", "b.json"], words);
    }
}

#[test]
fn strings_come_from_any_spreadsheet() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let ci = ci();
    let evaluate = |text: &str| {
        fs::write(folder.join("s.csv"), text).unwrap();
        quadrille(folder, &["evaluate", &ci, "--strings", "s.csv"])
    };
    let commas = evaluate("name,string\ninitial,\nother,TPD\n");
    let semicolons = evaluate("\u{feff}name;string\r\ninitial;\r\nother;TPD\r\n");
    assert_eq!(commas.status.code(), Some(0));
    assert_eq!(commas.stdout, semicolons.stdout);
    for text in [
        "sep=;\r\nname;string\r\ninitial;\r\nother;TPD\r\n;\r\n",
        "Name\tString\tnote\ninitial\t\t\nother\t TPD \t\n\t\t\n\n",
        "\"name\",\"string\",\"\"\n\"initial\",\"\",\n\"other\",\"TPD\",\n,,\n",
        "name;string\rinitial;\rother;TPD\r",
    ] {
        assert_eq!(evaluate(text).stdout, commas.stdout, "{text:?}");
    }
    let wide: Vec<u8> = "\u{feff}name\tstring\r\ninitial\t\r\nother\tTPD\r\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    fs::write(folder.join("s.csv"), wide).unwrap();
    assert_eq!(quadrille(folder, &["evaluate", &ci, "--strings", "s.csv"]).stdout, commas.stdout);
    for (text, words) in [
        ("string\n", "no strings below the header"),
        ("", "the file is empty"),
        ("name\nx\n", "no column `string`; found name"),
    ] {
        fs::write(folder.join("s.csv"), text).unwrap();
        refused(folder, &["evaluate", &ci, "--strings", "s.csv"], words);
    }
    for (bytes, words) in [
        (&b"string,note\nTPD,gut\nTPP,sch\xf6n\n"[..], "s.csv: line 3: not in UTF-8; save the file as UTF-8"),
        (b"\xff\xfes\0t\0r", "s.csv: line 1: a broken text in UTF-16"),
        (b"string,feasible\nTRUE,TRUE\n", "s.csv:2: \"TRUE\""),
    ] {
        fs::write(folder.join("s.csv"), bytes).unwrap();
        refused(folder, &["evaluate", &ci, "--strings", "s.csv"], words);
    }
    refused(folder, &["evaluate", &ci], "--string S or --strings FILE.csv");
}

#[test]
fn a_hint_can_be_typed_as_it_stands() {
    let temporary = tempfile::tempdir().unwrap();
    let output = quadrille(temporary.path(), &["init", "my roof"]);
    assert!(String::from_utf8(output.stderr).unwrap().contains("quadrille run 'my roof.toml'"));
}

#[test]
fn requirements_have_either_direction_unless_the_height_is_sized() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let text = fs::read_to_string(ci()).unwrap();
    let with = |name: &str, more: &str| fs::write(folder.join(name), format!("{text}\n{more}\n")).unwrap();
    let stiff = "[[structure.requirement]]\nquantity = \"deflection\"\ncombination = \"sls\"\nmin = 1000.0";
    with("stiff.toml", stiff);
    let output = quadrille(folder, &["evaluate", "stiff.toml", "--string", ""]);
    let shown = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(shown.contains("(limit 1000)"), "{shown}");
    let sized = "structure.height={min_m=0.05,max_m=0.4,step_m=0.01}";
    refused(
        folder,
        &["evaluate", "stiff.toml", "--string", "", "--set", sized],
        "a lower limit beside a height",
    );
}

#[test]
#[cfg(target_os = "linux")]
fn help_and_version_are_not_lost_on_a_full_disk() {
    for argument in ["--help", "--version", "help", "run --help"] {
        let script = format!("'{}' {argument} > /dev/full", env!("CARGO_BIN_EXE_quadrille"));
        let output = Command::new("sh").args(["-c", &script]).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{argument}: {told}");
        assert!(told.contains("No space left"), "{argument}: {told}");
    }
}
