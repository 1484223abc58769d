//! Help, starter config, completions.

use assert_cmd::Command;

fn quadrille() -> Command {
    Command::cargo_bin("quadrille").unwrap()
}

fn stdout_of(arguments: &[&str]) -> String {
    let output = quadrille().args(arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn help_lists_commands_and_exit_codes() {
    let help = stdout_of(&["--help"]);
    for part in ["check", "init", "completions", "--quiet", "--progress", "Exit codes: 0 done", "no feasible"]
    {
        assert!(help.contains(part), "{part} not in {help}");
    }
}

#[test]
fn a_wrong_argument_exits_2() {
    quadrille().arg("--no-such-flag").assert().code(2);
    quadrille().assert().code(2);
}

#[test]
fn init_writes_a_config_that_checks_and_never_overwrites() {
    let folder = tempfile::tempdir().unwrap();
    quadrille().current_dir(&folder).args(["init", "roof"]).assert().success().stdout("roof.toml\n");
    quadrille().current_dir(&folder).args(["check", "roof.toml"]).assert().success();
    quadrille().current_dir(&folder).args(["init", "roof"]).assert().code(2);
}

#[test]
fn check_names_the_symmetries_that_nothing_uses() {
    let court = concat!(env!("CARGO_MANIFEST_DIR"), "/configs/great_court.toml");
    // The circle is not in the middle of the rectangle's long side.
    assert!(stdout_of(&["check", court]).contains("not used, mirror-x: with them"));
    let used = stdout_of(&["check", court, "--set", "domain.symmetries=[\"mirror-x\"]"]);
    assert!(!used.contains("not used"), "{used}");
}

#[test]
fn manual_pages_say_what_help_says() {
    let folder = tempfile::tempdir().unwrap();
    let written = quadrille().args(["man", "--out", "man1"]).current_dir(&folder).output().unwrap();
    let pages = String::from_utf8(written.stdout).unwrap();
    assert!(pages.lines().count() > 15, "{pages}");
    let page = std::fs::read_to_string(folder.path().join("man1/quadrille-run.1")).unwrap();
    for part in ["history.csv", "\\-\\-resume", "Examples", "Exit codes"] {
        assert!(page.contains(part), "{part} not in {page}");
    }
    assert!(stdout_of(&["man"]).contains(".SH SYNOPSIS"));
}

#[test]
fn completions_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(stdout_of(&["completions", shell]).contains("quadrille"), "{shell}");
    }
}
