//! The cable net of the paper's Figures 20 and 21: five designs between a rectangle and two circles (docs/reference/geometry.md §5).

use assert_cmd::Command;
use quadrille::config::ResolvedConfig;
use quadrille::geometry::deviation::{mean_edge, of_pairs};
use quadrille::geometry::{Panel, Pattern, develop};
use quadrille::grammar::Tokens;
use quadrille::study::Study;
use std::path::{Path, PathBuf};

fn configs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs")
}

fn strings() -> Vec<Tokens> {
    let text = std::fs::read_to_string(configs().join("cable_net_designs.csv")).unwrap();
    text.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect()
}

fn nets() -> (Study, Vec<Pattern>) {
    let file = configs().join("cable_net.toml");
    let config = ResolvedConfig::open(&file, &[]).unwrap();
    let study = Study::of(&config).unwrap();
    let net = |tokens: &Tokens| {
        develop(&study.topology(tokens), &study.domain, study.surface.as_ref(), &config.config().pattern)
            .unwrap()
    };
    let nets = strings().iter().map(net).collect();
    (study, nets)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// The boundary holds the net where placing put it, evenly, and the forces of equal densities balance everywhere else.
#[test]
fn the_boundary_stays_and_the_net_is_in_balance() {
    let (study, nets) = nets();
    assert_eq!(nets.len(), 5);
    for net in &nets {
        let mut is_held = vec![false; net.positions.len()];
        for (curve, vertices) in study.domain.loops.iter().zip(&net.loops) {
            let along: Vec<f64> =
                vertices.iter().map(|&v| curve.closest(net.positions[v as usize])).collect();
            let gaps: Vec<f64> = (0..along.len())
                .map(|i| (along[(i + 1) % along.len()] - along[i]).rem_euclid(curve.length()))
                .collect();
            let (least, most) = gaps.iter().fold((f64::MAX, 0.0f64), |(a, b), &g| (a.min(g), b.max(g)));
            // Even between corners; from one side to the next the number of members may differ.
            assert!(most < 3.0 * least, "members on the boundary of {least} m and {most} m");
            if curve.corners().is_empty() {
                assert!(most - least < 1e-6 * most, "{least} {most}");
            }
            for &v in vertices {
                is_held[v as usize] = true;
            }
        }
        let mut sums = vec![([0.0; 3], 0.0); net.positions.len()];
        for &[u, v] in &net.edges {
            for (at, other) in [(u, v), (v, u)] {
                let (sum, count) = &mut sums[at as usize];
                for (total, x) in sum.iter_mut().zip(net.positions[other as usize]) {
                    *total += x;
                }
                *count += 1.0;
            }
        }
        for v in (0..net.positions.len()).filter(|&v| !is_held[v]) {
            let (sum, count) = sums[v];
            assert!(
                distance(net.positions[v], sum.map(|x| x / count)) < 1e-9,
                "vertex {v} is out of balance"
            );
        }
    }
    // Form follows topology: the five forms differ, by more than a tenth of an edge on average.
    let all: Vec<&Pattern> = nets.iter().collect();
    let unit = mean_edge(&all).unwrap();
    let pairs = of_pairs(&all);
    assert_eq!(pairs.len(), 10);
    assert!(pairs.iter().all(|d| d.mean > 0.1 * unit && d.max < 6.0 * unit), "{unit} {pairs:?}");
}

#[test]
fn deviations_are_those_of_surfaces() {
    let (_, nets) = nets();
    let net = &nets[0];
    let mut raised = net.clone();
    for p in &mut raised.positions {
        p[2] += 0.01;
    }
    // The same surface with vertices elsewhere: every panel of a flat strip in two.
    let flat = |count: u32| {
        let at = |i: u32| [f64::from(i) / f64::from(count), 0.0, 0.0];
        let rows = (0..=count).map(at).chain((0..=count).map(|i| [at(i)[0], 1.0, 0.0]));
        let panels = (0..count).map(|i| Panel::quad([i, i + 1, count + i + 2, count + i + 1]));
        Pattern { positions: rows.collect(), panels: panels.collect(), ..net.clone() }
    };
    let found = of_pairs(&[net, net, &raised]);
    assert!(found[0].mean < 1e-12 && found[0].max < 1e-12);
    assert!(found[1].mean > 0.004 && found[1].max <= 0.01 + 1e-12, "{:?}", found[1]);
    let flats = of_pairs(&[&flat(3), &flat(7)]);
    assert!(flats[0].max < 1e-12, "{flats:?}");
}

#[test]
fn evaluate_tells_the_deviations() {
    let folder = tempfile::tempdir().unwrap();
    let [config, strings] =
        ["cable_net.toml", "cable_net_designs.csv"].map(|name| configs().join(name).display().to_string());
    let arguments = ["evaluate", &config, "--strings", &strings, "--out", "o"];
    let output =
        Command::cargo_bin("quadrille").unwrap().current_dir(&folder).args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("distance of the forms") && text.contains("[4] – [5]"), "{text}");
    let table = std::fs::read_to_string(folder.path().join("o/deviations.csv")).unwrap();
    assert!(table.starts_with("first,second,mean_m,max_m,mean_per_edge,max_per_edge\n"), "{table}");
    assert_eq!(table.lines().count(), 11);
}
