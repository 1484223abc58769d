//! Patterns and models for the tests of the frame solver.
#![allow(dead_code, reason = "each test file uses some of these")]

use quadrille::geometry::{Panel, Pattern};

/// A grid of `m` × `n` panels over a plan of `width` × `depth` m, at heights `z(x, y)`, x and y from −1 to 1.
pub fn grid_shell([m, n]: [u32; 2], [width, depth]: [f64; 2], z: impl Fn(f64, f64) -> f64) -> Pattern {
    let vertex = |i: u32, j: u32| j * (m + 1) + i;
    let mut positions = Vec::new();
    for j in 0..=n {
        for i in 0..=m {
            let (x, y) = (2.0 * f64::from(i) / f64::from(m) - 1.0, 2.0 * f64::from(j) / f64::from(n) - 1.0);
            positions.push([0.5 * width * x, 0.5 * depth * y, z(x, y)]);
        }
    }
    let mut panels = Vec::new();
    let mut edges = Vec::new();
    for j in 0..=n {
        for i in 0..=m {
            if i < m && j < n {
                panels.push(Panel::quad([
                    vertex(i, j),
                    vertex(i + 1, j),
                    vertex(i + 1, j + 1),
                    vertex(i, j + 1),
                ]));
            }
            if i < m {
                edges.push([vertex(i, j), vertex(i + 1, j)]);
            }
            if j < n {
                edges.push([vertex(i, j), vertex(i, j + 1)]);
            }
        }
    }
    edges.sort_unstable();
    let outer: Vec<u32> = (0..m)
        .map(|i| vertex(i, 0))
        .chain((0..n).map(|j| vertex(m, j)))
        .chain((1..=m).rev().map(|i| vertex(i, n)))
        .chain((1..=n).rev().map(|j| vertex(0, j)))
        .collect();
    let corners = vec![vertex(0, 0), vertex(m, 0), vertex(m, n), vertex(0, n)];
    Pattern {
        coarse: corners.clone(),
        coarse_face: vec![0; panels.len()],
        target_length: width / f64::from(m),
        positions,
        panels,
        edges,
        loops: vec![outer],
        loop_corners: std::iter::once(0..4).collect(),
        corners,
    }
}

/// A shallow dome on a square plan, supported as in the paper.
pub fn dome(cells: u32, side: f64, rise: f64) -> Pattern {
    grid_shell([cells, cells], [side, side], |x, y| rise * (1.0 - x * x) * (1.0 - y * y))
}

/// A court roof: `around` × `across` panels between a circle of radius 22.245 m and a rectangle of the size of the
/// Great Court's, rising 7 m between the two.
pub fn court(around: u32, across: u32) -> Pattern {
    let vertex = |i: u32, j: u32| (i % around) * (across + 1) + j;
    let corner_angles = [
        (-51.125f64).atan2(-36.625),
        (-51.125f64).atan2(36.625),
        46.025f64.atan2(36.625),
        46.025f64.atan2(-36.625),
    ];
    // Equal steps between corners, so that every corner is a vertex.
    let quarter = around / 4;
    let angle = |i: u32| {
        let (k, t) = ((i / quarter) as usize, f64::from(i % quarter) / f64::from(quarter));
        let (a, b) = (corner_angles[k], corner_angles[(k + 1) % 4]);
        let b = if b < a { b + std::f64::consts::TAU } else { b };
        a + (b - a) * t
    };
    let wall = |angle: f64| {
        let (s, c) = angle.sin_cos();
        let across_x = 36.625 / c.abs();
        let across_y = if s > 0.0 { 46.025 / s } else { 51.125 / -s };
        across_x.min(across_y)
    };
    let mut positions = Vec::new();
    for i in 0..around {
        let a = angle(i);
        for j in 0..=across {
            let t = f64::from(j) / f64::from(across);
            let r = 22.245 + (wall(a) - 22.245) * t;
            positions.push([
                r * a.cos(),
                r * a.sin(),
                20.0 + 7.0 * 4.0 * t * (1.0 - t) * 0.5 + 0.5 * (1.0 - t),
            ]);
        }
    }
    let mut panels = Vec::new();
    let mut edges = Vec::new();
    for i in 0..around {
        for j in 0..=across {
            let (a, b) = (vertex(i, j), vertex(i + 1, j));
            edges.push([a.min(b), a.max(b)]);
            if j < across {
                edges.push([a, a + 1]);
                panels.push(Panel::quad([a, a + 1, b + 1, b]));
            }
        }
    }
    edges.sort_unstable();
    let corners: Vec<u32> = (0..4).map(|k| vertex(k * quarter, across)).collect();
    Pattern {
        coarse: corners.clone(),
        coarse_face: vec![0; panels.len()],
        target_length: 2.0,
        positions,
        panels,
        edges,
        loops: vec![
            (0..around).map(|i| vertex(i, across)).collect(),
            (0..around).map(|i| vertex(i, 0)).collect(),
        ],
        loop_corners: vec![0..4, 4..4],
        corners,
    }
}
