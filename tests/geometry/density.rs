//! Rows of strips (docs/reference/geometry.md §2.2): as near to the number of panels as any width of rows comes; ties, caps, corners and
//! sides.

use crate::support::great_court;
use quadrille::geometry::coarse::Coarse;
use quadrille::geometry::dense::panel_count;
use quadrille::geometry::density::{Bounds, Fineness, SideRows, choose};

const STRINGS: [&str; 5] = [
    "AoTTTPPTTTPPTPTPTPTTTPPPTTA",
    "PAoTTTTTPPPPTPPTPTTPPTTTPTPTPPTPTTTTTTTA",
    "AoPPPPTPTTTPTPPPPPTPTTTTPTPTPTPPTTPTA",
    "DPTTAoPTTPTPPTPTTPTTPTTTPTAA*TPPTTPTA",
    "",
];

fn free(strips: usize) -> Bounds {
    Bounds { most: vec![u32::MAX; strips], least: vec![1; strips], sides: Vec::new() }
}

/// Lengths of no order that are the same on every machine.
fn lengths(strips: usize) -> Vec<f64> {
    (0..strips).map(|s| 10.0 + 7.0 * libm::sin(1.7 * s as f64)).collect()
}

#[test]
fn no_width_comes_nearer() {
    let study = great_court();
    for string in STRINGS {
        let mesh = study.topology(&string.parse().unwrap());
        let coarse = Coarse::of(&mesh);
        let lengths = lengths(mesh.strips.len());
        let rows = |width: f64| -> Vec<u32> {
            lengths.iter().map(|l| ((l / width + 0.5).floor() as u32).max(1)).collect()
        };
        // The number of panels changes only where a strip's length is a half more than a whole multiple of the width.
        let widths = lengths.iter().flat_map(|l| (1..=2_000).map(move |k| l / (f64::from(k) - 0.5)));
        let counts = widths
            .flat_map(|w| [w * (1.0 - 1e-12), w * (1.0 + 1e-12)])
            .map(|w| panel_count(&coarse, &rows(w)));
        let nearest = counts.map(|n| n.abs_diff(2000)).min().unwrap();
        let chosen = choose(&coarse, &lengths, Fineness::Panels(2000.0), &free(lengths.len()));
        assert_eq!(panel_count(&coarse, &chosen).abs_diff(2000), nearest, "{string}");
    }
}

#[test]
fn strips_equal_but_for_rounding_have_equal_rows() {
    let study = great_court();
    let mesh = study.topology(&"".parse().unwrap());
    let coarse = Coarse::of(&mesh);
    let count = mesh.strips.len();
    for panels in 300..400 {
        let lengths: Vec<f64> = (0..count).map(|s| 20.0 * (1.0 + 1e-13 * s as f64)).collect();
        let rows = choose(&coarse, &lengths, Fineness::Panels(f64::from(panels)), &free(count));
        assert!(rows.iter().all(|n| *n == rows[0]), "{panels}: {rows:?}");
    }
}

#[test]
fn caps_hold_and_lower_bounds_win() {
    let study = great_court();
    let mesh = study.topology(&"".parse().unwrap());
    let coarse = Coarse::of(&mesh);
    let count = mesh.strips.len();
    let mut bounds = free(count);
    bounds.most[0] = 2;
    bounds.most[1] = 2;
    bounds.least[1] = 5;
    let rows = choose(&coarse, &lengths(count), Fineness::Panels(2000.0), &bounds);
    assert_eq!(rows[..2], [2, 5]);
    assert!(panel_count(&coarse, &rows).abs_diff(2000) < 200, "the others make up for it");
}

#[test]
fn a_side_gets_its_rows_and_equal_strips_get_them_together() {
    let study = great_court();
    let mesh = study.topology(&"".parse().unwrap());
    let coarse = Coarse::of(&mesh);
    let count = mesh.strips.len();
    let mut bounds = free(count);
    let lengths = vec![10.0; count];
    let before = choose(&coarse, &lengths, Fineness::Width(5.0), &bounds);
    assert!(before.iter().all(|n| *n == 2));
    bounds.sides = vec![SideRows { need: 7, strips: vec![0, 1] }];
    let rows = choose(&coarse, &lengths, Fineness::Width(5.0), &bounds);
    assert_eq!(rows[..3], [4, 4, 2], "one more than needed, so that no numbering decides");
    bounds.most[0] = 2;
    let rows = choose(&coarse, &lengths, Fineness::Width(5.0), &bounds);
    assert_eq!(rows[..2], [2, 5]);
}

#[test]
fn more_panels_than_can_be_counted_are_too_many() {
    let study = great_court();
    let mesh = study.topology(&"".parse().unwrap());
    let coarse = Coarse::of(&mesh);
    let rows = vec![u32::MAX; mesh.strips.len()];
    assert_eq!(panel_count(&coarse, &rows), usize::MAX, "no sum that has gone around");
}
