//! The shipped configs load, and `great_court.toml` is the one that the documentation shows.

use quadrille::config::{self, Config, ConfigError, ResolvedConfig};
use quadrille::geometry::params::RelaxKind;
use quadrille::io::Inputs;
use std::path::Path;

fn load(name: &str) -> Config {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name);
    opened(&path, &[])
}

fn opened(path: &Path, sets: &[String]) -> Config {
    ResolvedConfig::open(path, sets).unwrap_or_else(|error| panic!("{error}")).config().clone()
}

/// The config of the documentation, as published.
const DOCUMENTED: &str = include_str!("../data/config/great_court_documented.toml");

#[test]
fn great_court_is_the_documented_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("documented.toml");
    std::fs::write(&file, DOCUMENTED).unwrap();
    let documented = opened(&file, &[]);
    let differing = config::differences(&load("great_court.toml"), &documented);
    let filled_in = ["objectives.ideal", "objectives.reference", "topology.symmetry"];
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
            let config = opened(&path, &[]);

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
    let changed = opened(&path, &sets);
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
        let relax = opened(&file, &[]).pattern.relax;
        (relax.kind, relax.sweeps, relax.damping)
    };
    assert_eq!(relax(""), (RelaxKind::Uniform, 500, 0.5));
    assert_eq!(relax("[pattern]\nrelax = { kind = \"cotangent\" }"), (RelaxKind::Cotangent, 500, 0.5));
    assert_eq!(relax("[pattern]\nrelax = { sweeps = 7 }"), (RelaxKind::Uniform, 7, 0.5));
}

const ROOM: &str = r#"
    domain.loop = [{ kind = "polyline", points_m = [[0, 0], [8, 0], [8, 6], [0, 6]] }]
    topology.initial = { grid = [2, 2] }
"#;

#[test]
fn a_file_text_and_values_give_one_config() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("room.toml");
    std::fs::write(&file, ROOM).unwrap();
    let opened = ResolvedConfig::open(&file, &[]).unwrap();
    let parsed = ResolvedConfig::parse(ROOM, &file, &[]).unwrap();
    let made = ResolvedConfig::of(ROOM.parse().unwrap(), &file).unwrap();
    assert_eq!(opened.config().run.name.as_deref(), Some("room"));
    for other in [parsed, made] {
        assert_eq!((other.config(), other.folder()), (opened.config(), opened.folder()));
    }
}

#[test]
fn text_and_values_are_refused_as_a_file_is() {
    let wrong = format!("{ROOM}search.population = 0\n");
    let told = |error: Option<ConfigError>| error.map(|error| error.to_string()).unwrap_or_default();
    let by_text = told(ResolvedConfig::parse(&wrong, Path::new("room.toml"), &[]).err());
    assert!(by_text.starts_with("room.toml:4: search.population: found 0"), "{by_text}");
    let by_values = told(ResolvedConfig::of(wrong.parse().unwrap(), Path::new("room.toml")).err());
    assert!(by_values.starts_with("room.toml: search.population: found 0"), "{by_values}");
}

#[test]
fn a_recorded_config_is_checked_as_one_that_was_written() {
    let again = |config: &Config| {
        let resolved = ResolvedConfig::again(config, Inputs::default(), Path::new("results/room"));
        resolved.err().map(|error| error.to_string()).unwrap_or_default()
    };
    let checked = ResolvedConfig::parse(ROOM, Path::new("room.toml"), &[]).unwrap().config().clone();
    assert_eq!(again(&checked), "");
    let mut changed = checked.clone();
    changed.objectives.minimise = vec!["beauty".into()];
    let told = again(&changed);
    assert!(told.contains("manifest.json: objectives.minimise[0]: found no objective \"beauty\""), "{told}");
    let mut changed = checked;
    changed.pattern.max_faces = 0;
    assert!(again(&changed).contains("pattern.max_faces: found 0"), "{}", again(&changed));
}
