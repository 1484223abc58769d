//! A drawing of a coarse mesh: rules leave the copies of a vertex in one place, a picture must part them.

use crate::mesh::{DartId, QuadMesh, VertexId};

/// Sweeps of the inner relaxation; a few dozen suffice to open every new strip.
const SWEEPS: usize = 60;
/// How strongly an inner vertex is held where the rules left it: with less, a ring of few vertices shrinks into the
/// hole it goes around.
const HOLD: f64 = 0.5;

/// Places the vertices in the plane, y up: boundary copies spread along their loop, inner vertices between their
/// neighbours but held near where they were. Seen from above; aslant if the mesh has no extent in the plan.
pub fn layout(mesh: &QuadMesh) -> Vec<[f64; 2]> {
    let mut points = project(mesh);
    let mut fixed = vec![false; points.len()];
    let size = extent(&points);
    for darts in mesh.loops() {
        spread(mesh, &darts, size, &mut points);
        darts.iter().for_each(|&d| fixed[mesh.origin(d).index()] = true);
    }
    relax(mesh, &fixed, &mut points);
    points
}

fn project(mesh: &QuadMesh) -> Vec<[f64; 2]> {
    let plan: Vec<[f64; 2]> = mesh.positions().iter().map(|&[x, y, _]| [x, y]).collect();
    let [width, height] = extent_xy(&plan);
    if mesh.loop_count() > 0 && width.min(height) > 1e-6 * width.max(height) {
        return plan;
    }
    mesh.positions().iter().map(|&[x, y, z]| [x - 0.45 * y, 0.3 * x + 0.25 * y + z]).collect()
}

fn extent_xy(points: &[[f64; 2]]) -> [f64; 2] {
    std::array::from_fn(|i| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for point in points {
            low = low.min(point[i]);
            high = high.max(point[i]);
        }
        high - low
    })
}

fn extent(points: &[[f64; 2]]) -> f64 {
    let [width, height] = extent_xy(points);
    width.max(height).max(f64::MIN_POSITIVE)
}

/// Parts neighbours on a loop that are in one place: the first stays (it carries the marks), the others follow on
/// the way to the next place, up to its middle.
fn spread(mesh: &QuadMesh, darts: &[DartId], size: f64, points: &mut [[f64; 2]]) {
    let vertices: Vec<VertexId> = darts.iter().map(|&d| mesh.origin(d)).collect();
    let place: Vec<[f64; 2]> = vertices.iter().map(|v| points[v.index()]).collect();
    let n = vertices.len();
    let apart = |i: usize, j: usize| distance(place[i % n], place[j % n]) > 1e-9 * size;
    let Some(start) = (0..n).find(|&i| apart(i + n - 1, i)) else {
        // The whole loop is one point: a small circle.
        for (k, v) in vertices.iter().enumerate() {
            let angle = -std::f64::consts::TAU * k as f64 / n as f64;
            points[v.index()] =
                [place[k][0] + 0.05 * size * libm::cos(angle), place[k][1] + 0.05 * size * libm::sin(angle)];
        }
        return;
    };
    let mut i = start;
    while i < start + n {
        let count = (1..n).find(|&k| apart(i, i + k)).unwrap_or(1);
        let (from, to) = (place[i % n], place[(i + count) % n]);
        for k in 1..count {
            let t = 0.6 * k as f64 / count as f64;
            points[vertices[(i + k) % n].index()] = [0, 1].map(|x: usize| from[x] * (1.0 - t) + to[x] * t);
        }
        i += count;
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

fn relax(mesh: &QuadMesh, fixed: &[bool], points: &mut Vec<[f64; 2]>) {
    let home = points.clone();
    for _ in 0..SWEEPS {
        let mut sums = vec![[0.0, 0.0, 0.0]; points.len()];
        for d in mesh.darts() {
            let [x, y] = points[mesh.end(d).index()];
            let sum = &mut sums[mesh.origin(d).index()];
            *sum = [sum[0] + x, sum[1] + y, sum[2] + 1.0];
        }
        *points = (0..points.len())
            .map(|v| {
                let [x, y, count] = sums[v];
                if fixed[v] || count == 0.0 {
                    home[v]
                } else {
                    [0, 1].map(|i: usize| (1.0 - HOLD) * [x, y][i] / count + HOLD * home[v][i])
                }
            })
            .collect();
    }
}
