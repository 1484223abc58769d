//! `quadrille axes`: what it prints is what a config takes.

use assert_cmd::Command;
use std::path::Path;

fn quadrille(args: &[&str]) -> (Option<i32>, String) {
    let dome = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/dome.toml");
    let output = Command::cargo_bin("quadrille").unwrap().args(args).arg(dome).output().unwrap();
    (output.status.code(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn prints_what_a_config_takes() {
    let (code, one) = quadrille(&["axes", "--designs", "40", "--threads", "1"]);
    assert_eq!(code, Some(0));
    assert_eq!(one, quadrille(&["axes", "--designs", "40", "--threads", "2"]).1, "threads change nothing");
    let value = |name: &str| {
        let list = one.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(" = ")).unwrap();
        serde_json::from_str::<Vec<f64>>(list).unwrap()
    };
    let (ideal, reference) = (value("ideal"), value("reference"));
    assert_eq!(ideal.len(), 4);
    assert!(ideal.iter().zip(&reference).all(|(i, r)| i < r), "{one}");
    let sets = [format!("objectives.ideal={ideal:?}"), format!("objectives.reference={reference:?}")];
    let (code, resolved) = quadrille(&["check", "--set", &sets[0], "--set", &sets[1]]);
    assert_eq!(code, Some(0));
    assert!(resolved.contains("reference = ["));
}

#[test]
fn a_number_of_designs_beyond_memory_is_refused() {
    for designs in ["0", "18446744073709551615"] {
        assert_eq!(quadrille(&["axes", "--designs", designs]).0, Some(2), "{designs}");
    }
}
