//! A design whose topology has a symmetry of the domain has a pattern with it, to the last bit (docs/symmetry.md).

use quadrille::config::{Config, ResolvedConfig};
use quadrille::geometry::images::Image;
use quadrille::geometry::{Pattern, shape};
use quadrille::grammar::random::{self, Shares};
use quadrille::mesh::CanonicalMesh;
use quadrille::random::stream;
use quadrille::study::{Effort, Study};
use std::collections::BTreeMap;

const COURT: &str = "[[domain.loop]]\nkind = \"polyline\"\n\
    points_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]\n\
    [[domain.loop]]\nkind = \"circle\"\ncenter_m = [0, 0]\nradius_m = 22.245\n\
    [surface]\nkind = \"great-court\"\n[pattern]\npanels = 500\n";
const SQUARE: &str = "[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[-10, -10], [10, -10], [10, 10], [-10, 10]]\n\
    [pattern]\npanels = 200\n";

fn study_of(text: &str, topology: &str) -> (Study, Config) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    std::fs::write(&file, format!("version = 1\n{text}[topology]\n{topology}")).unwrap();
    let config = ResolvedConfig::open(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    (Study::of(&config).unwrap_or_else(|error| panic!("{error}")), config.config().clone())
}

/// Every vertex has an image, equal to the last bit; every member too.
fn assert_symmetric(pattern: &Pattern, study: &Study, topology: &CanonicalMesh, what: &str) {
    let key = |p: [f64; 3]| p.map(|x| (x + 0.0).to_bits());
    let vertices: BTreeMap<_, u32> = pattern.positions.iter().map(|&p| key(p)).zip(0..).collect();
    for image in Image::all(topology, &study.domain) {
        let map: Vec<u32> = pattern
            .positions
            .iter()
            .map(|&p| {
                let q = study.domain.image(p, image.kind);
                *vertices
                    .get(&key(q))
                    .unwrap_or_else(|| panic!("{what}, {}: {p:?} has no image", image.kind.name()))
            })
            .collect();
        for &[u, v] in &pattern.edges {
            let (a, b) = (map[u as usize], map[v as usize]);
            assert!(pattern.edges.binary_search(&[a.min(b), a.max(b)]).is_ok(), "{what}: member {u}-{v}");
        }
    }
}

/// Patterns of random strings of a config with mirrors; each is symmetric, and the same as that of a config without.
fn check(text: &str, topology: &str, mirrors: &str, count: u32) {
    let (study, config) = study_of(text, &format!("{topology}symmetry = {mirrors}\n"));
    let (plain, _) = study_of(text, topology);
    let mut drawn = 0;
    for index in 0..count {
        let shares = Shares { closed: 0.3, ..Shares::default() };
        let mut rng = stream(29, 0, index);
        let tokens = random::aware(&mut rng, 4..=24, &shares, &study.start.part, study.rules);
        let topology = study.topology(&tokens);
        let wanted = mirrors.matches("mirror").count();
        let images = Image::all(&topology, &study.domain).len();
        match study.develop(topology.clone(), Effort::Pattern) {
            Err(failure) if images < wanted => {
                assert!(failure.reason.contains("not symmetric"), "{tokens}: {}", failure.reason)
            }
            Err(_) => {}
            Ok(design) => {
                assert!(images >= wanted, "{tokens}");
                assert_symmetric(&design.pattern, &study, &topology, &tokens.to_string());
                let other =
                    shape(&topology, &plain.domain, plain.surface.as_ref(), &config.pattern).ok().unwrap();
                assert!(other.pattern == design.pattern, "{tokens}: not a function of the topology alone");
                drawn += 1;
            }
        }
    }
    assert!(drawn * 5 >= count, "{drawn} of {count}");
}

#[test]
fn on_the_great_court() {
    check(COURT, "", "[\"mirror-x\"]", 40);
}

#[test]
fn on_a_square_dome_with_both_mirrors() {
    let dome = format!(
        "{SQUARE}[surface]\nkind = \"paraboloid\"\nhalf_spans_m = [14.142135623730951, 14.142135623730951]\nrise_m = 4\n"
    );
    check(&dome, "initial = { grid = [2, 2] }\n", "[\"mirror-x\", \"mirror-y\"]", 40);
}

#[test]
fn on_surfaces_of_every_kind() {
    for surface in [
        "kind = \"plane\"\n",
        "kind = \"height\"\nexpression = \"3*cos(x/9)*cos(y/7)\"\n",
        "kind = \"sphere\"\ncenter_m = [0, 0, -20]\nradius_m = 40\n",
        "kind = \"cylinder\"\ncenter_m = [0, 0, -20]\nradius_m = 30\naxis_deg = 0\n",
    ] {
        check(
            &format!("{SQUARE}[surface]\n{surface}"),
            "initial = { grid = [2, 2] }\n",
            "[\"mirror-x\", \"mirror-y\"]",
            8,
        );
    }
}

#[test]
fn by_every_way_of_relaxing() {
    for relax in ["uniform", "area", "cotangent", "force-density"] {
        let text =
            SQUARE.replace("panels = 200\n", &format!("panels = 200\nrelax = {{ kind = \"{relax}\" }}\n"));
        check(
            &format!("{text}[surface]\nkind = \"plane\"\n"),
            "initial = { grid = [2, 2] }\n",
            "[\"mirror-x\"]",
            8,
        );
    }
}
