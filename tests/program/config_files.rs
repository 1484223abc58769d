//! The shipped configs load, and `great_court.toml` is the one that the documentation shows.

use quadrille::config::{self, Config};
use quadrille::geometry::params::RelaxKind;
use std::path::Path;

fn load(name: &str) -> Config {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name);
    config::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The config of the documentation, as published.
const DOCUMENTED: &str = include_str!("../data/config/great_court_documented.toml");

#[test]
fn great_court_is_the_documented_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("documented.toml");
    std::fs::write(&file, DOCUMENTED).unwrap();
    let documented = config::load(&file, &[]).unwrap();
    let differing = config::differences(&load("great_court.toml"), &documented);
    let filled_in = ["objectives.ideal", "objectives.reference"];
    let others: Vec<_> = differing.iter().filter(|key| !filled_in.contains(&key.as_str())).collect();
    assert!(others.is_empty(), "{others:?}");
}

#[test]
fn great_court_sized_differs_in_height_and_objectives_only() {
    let differing = config::differences(&load("great_court.toml"), &load("great_court_sized.toml"));
    let expected = |key: &str| {
        key == "run.name" || key.starts_with("structure.height") || key.starts_with("objectives.")
    };
    assert!(differing.iter().all(|key| expected(key)), "{differing:?}");
}

#[test]
fn configs_to_compare_differ_in_search_only() {
    for other in ["compare/random.toml", "compare/token_wise.toml"] {
        let differing = config::differences(&load("compare/default.toml"), &load(other));
        assert!(!differing.is_empty());
        assert!(differing.iter().all(|key| key == "run.name" || key.starts_with("search.")), "{differing:?}");
    }
}

#[test]
fn every_shipped_config_loads_and_survives_being_written_back() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let config = config::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));

            let back: Config = toml::from_str(&config::to_toml(&config)).unwrap();
            assert_eq!(back, config, "{}", path.display());
            assert_eq!(config::hash(&back), config::hash(&config));
            count += 1;
        }
    }
    assert!(count >= 4, "{count} configs");
}

#[test]
fn shortest_member_defaults_to_twice_the_section_width() {
    assert_eq!(load("great_court.toml").pattern.limits.min_edge_m, Some(0.5));
    assert_eq!(load("dome.toml").pattern.limits.min_edge_m, Some(0.24));
}

#[test]
fn differences_name_keys() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/dome.toml");
    let sets =
        ["run.threads=2", "search.tokens.max=9", "domain.loop[0].points_m[0][0]=-11"].map(String::from);
    let changed = config::load(&path, &sets).unwrap();
    assert_eq!(
        config::differences(&load("dome.toml"), &changed),
        ["domain.loop", "run.threads", "search.tokens.max"]
    );
}

/// docs/reference/geometry.md §2.4: the paper's cable net is relaxed otherwise than its gridshell, unless the config says so.
#[test]
fn a_free_surface_has_its_own_defaults() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("net.toml");
    let relax = |more: &str| {
        let text = format!(
            "version = 1\n[[domain.loop]]\nkind = \"circle\"\ncenter_m = [0, 0]\nradius_m = 5\n\
             [surface]\nkind = \"free\"\n{more}"
        );
        std::fs::write(&file, text).unwrap();
        let relax = config::load(&file, &[]).unwrap().pattern.relax;
        (relax.kind, relax.sweeps, relax.damping)
    };
    assert_eq!(relax(""), (RelaxKind::Uniform, 500, 0.5));
    assert_eq!(relax("[pattern]\nrelax = { kind = \"cotangent\" }"), (RelaxKind::Cotangent, 500, 0.5));
    assert_eq!(relax("[pattern]\nrelax = { sweeps = 7 }"), (RelaxKind::Uniform, 7, 0.5));
}
