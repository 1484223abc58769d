//! Steps from a string on real meshes: whole ones and parts of symmetric ones.

use std::path::Path;

use quadrille::config::ResolvedConfig;
use quadrille::output::designs::id;
use quadrille::random::stream;
use quadrille::search::{Problem, RuleOperator, Steps};
use quadrille::study::Study;

fn study(config: &str, sets: &[&str]) -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Study::of(&ResolvedConfig::open(&folder.join(config), &sets).unwrap()).unwrap()
}

const WHOLE: &str = "topology.symmetry=[]";
const HALF: &str = "topology.symmetry=[\"mirror-x\"]";
const QUARTER: &str = "topology.symmetry=[\"mirror-x\",\"mirror-y\"]";

#[test]
fn every_step_is_one_rule_more_and_wholly_expressed() {
    let mut steps_seen = 0;
    let roofs = [
        study("great_court.toml", &[WHOLE]),
        study("great_court.toml", &[HALF]),
        study("dome.toml", &[QUARTER]),
        study("dome.toml", &[WHOLE, "search.poles=false"]),
    ];
    for (roof, study) in roofs.iter().enumerate() {
        for k in 0..12 {
            let before = study.decode_part(&study.random(&mut stream(7, k, roof as u32))).expressed;
            let natural = study.steps(Steps::Natural, &before);
            let simple = if k == 0 { study.steps(Steps::Simple, &before) } else { Vec::new() };
            for string in natural.iter().chain(&simple) {
                let decoded = study.decode_part(string);
                assert_eq!(decoded.expressed, *string, "nothing is skipped");
                assert_eq!(string[..before.len()], before[..], "the rest is left alone");
                let applied =
                    decoded.trace[before.len()..].iter().filter(|effect| effect.is_applied()).count();
                assert_eq!(applied, 1, "{before} + one rule: {string}");
            }
            steps_seen += natural.len() + simple.len();
            assert_eq!(natural, study.steps(Steps::Natural, &before), "a fixed order");
        }
    }
    assert!(steps_seen > 3000, "{steps_seen}");
}

#[test]
fn appended_strips_along_natural_and_short_polyedges_are_applied() {
    let study = study("great_court.toml", &[HALF]);
    let mut made = 0;
    for k in 0..300 {
        let mut rng = stream(8, k, 0);
        let before = study.decode_part(&study.random(&mut rng)).expressed;
        for operator in [RuleOperator::AppendNatural, RuleOperator::AppendShort] {
            let Some(longer) = study.vary(operator, &before, &mut rng) else { continue };
            made += 1;
            assert!(longer.len() <= 40);
            assert_eq!(study.decode_part(&longer).expressed, longer);
        }
    }
    assert!(made > 200, "{made}");
}

#[test]
fn two_natural_steps_reach_the_symmetric_roof_of_the_great_court() {
    // The ring deleted and a strip added along the outer wall (docs/symmetry.md).
    let study = study("great_court.toml", &[HALF]);
    let one = study.steps(Steps::Natural, &"".parse().unwrap());
    let reached = one.iter().flat_map(|string| study.steps(Steps::Natural, string));
    let mut ids = reached.map(|string| id(study.topology(&string).code));
    assert!(ids.any(|id| id == "qbe89fb2b75a5"));
}
