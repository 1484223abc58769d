//! `density = "panels"`: no target length gives a number of panels nearer to the one asked for (GEOMETRY §2.2).
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod geometry_support;

use geometry_support::great_court;
use quadrille::geometry::coarse::Coarse;
use quadrille::geometry::dense::{Edges, densify, panel_count};
use quadrille::geometry::place::{self, Folds};
use quadrille::geometry::{PatternParams, boundary, corners, density};

/// Designs of the fold study: the first four come out more than 3 % from 2,000 panels, the last is the initial one.
const STRINGS: [&str; 5] = [
    "AoTTTPPTTTPPTPTPTPTTTPPPTTA",
    "PAoTTTTTPPPPTPPTPTTPPTTTPTPTPPTPTTTTTTTA",
    "AoPPPPTPTTTPTPPPPPTPTTTTPTPTPTPPTTPTA",
    "DPTTAoPTTPTPPTPTTPTTPTTTPTAA*TPPTTPTA",
    "",
];

#[test]
fn no_target_length_comes_nearer() {
    let study = great_court();
    let (domain, surface) = (&study.domain, study.surface.as_ref());
    let mut off = 0;
    for string in STRINGS {
        let mesh = study.topology(&string.parse().unwrap());
        let coarse = Coarse::of(&mesh);
        let probe = densify(&coarse, &vec![density::PROBE_PARTS; mesh.strips.len()]);
        let edges = Edges::of(probe.vertex_count, &probe.panels);
        let loops = boundary::anchor(&coarse, &probe, domain, &corners::assign(&coarse, domain)).unwrap();
        let placed = place::place(domain, surface, &probe, &edges, &loops, Folds::Leave).unwrap();
        let lengths = density::strip_lengths(&coarse, &probe, &placed.positions);
        // The number of panels falls as t grows and changes only where a strip's length is a whole multiple of t: these lengths, and
        // one beyond them all, reach every number that some t gives.
        let multiples = lengths.iter().flat_map(|l| (1..=2_000).map(move |k| l / f64::from(k)));
        let counts = multiples.map(|t| panel_count(&coarse, &density::parts(&lengths, t * (1.0 + 1e-12))));
        let params = PatternParams::default();
        let nearest = counts.map(|n| n.abs_diff(params.panels)).min().unwrap();
        let chosen = density::choose(&coarse, &lengths, &params).unwrap();
        let found = panel_count(&coarse, &chosen.parts).abs_diff(params.panels);
        assert_eq!(found, nearest, "{string}");
        off += usize::from(found * 100 > 3 * params.panels);
    }
    assert_eq!(off, 4);
}

#[test]
fn more_panels_than_can_be_counted_are_too_many() {
    let study = great_court();
    let mesh = study.topology(&"".parse().unwrap());
    let coarse = Coarse::of(&mesh);
    let parts = density::parts(&vec![20.0; mesh.strips.len()], 1e-9);
    assert_eq!(panel_count(&coarse, &parts), usize::MAX, "no sum that has gone around");
}
