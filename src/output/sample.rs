//! Small patterns for the exporters' tests.

use crate::geometry::{Panel, Pattern};

/// A unit square beside a triangle with its pole at vertex 2.
pub fn square_with_pole() -> Pattern {
    Pattern {
        positions: vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [2.0, 1.0 / 3.0, 0.0],
            [0.0, 1.0, 0.5],
            [1.0, 1.0, 0.25],
        ],
        panels: vec![Panel::quad([0, 1, 4, 3]), Panel::triangle([2, 4, 1])],
        edges: vec![[0, 1], [0, 3], [1, 2], [1, 4], [2, 4], [3, 4]],
        loops: vec![vec![0, 1, 2, 4, 3]],
        along: Vec::new(),
        corners: vec![0, 3],
        loop_corners: std::iter::once(0..2).collect(),
        coarse: vec![0, 1, 2, 3, 4],
        coarse_face: vec![0, 1],
        target_length: 1.0,
    }
}
