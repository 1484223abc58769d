//! The same coarse mesh at other densities: positions carried over face by face (docs/reference/geometry.md §6.7).

use super::ground::Ground;
use super::sheet::{Held, NO_CORNER, Sheet};
use crate::geometry::coarse::Coarse;
use crate::geometry::dense::{Dense, Grid, densify};
use crate::geometry::vector::{Vec3, add, scale};

/// How far inside the boundary a vertex is put that came to lie outside, local units.
const INWARD: f64 = 0.02;

/// The sheet with `parts` rows a strip: inner vertices bilinear in the old panels of their coarse face, boundary vertices linear between
/// the old ones' arc lengths, corners kept; all put back on surface and curves, and into the domain.
pub fn resample(coarse: &Coarse<'_>, ground: &Ground<'_>, old: &Sheet, parts: &[u32]) -> Sheet {
    let dense = densify(coarse, parts);
    let loops: Vec<Held> =
        (0..old.loops.len()).map(|label| resample_loop(coarse, old, &dense, label)).collect();
    let mut points = vec![[0.0; 3]; dense.vertex_count];
    points[..coarse.mesh.vertex_count].copy_from_slice(&old.points[..coarse.mesh.vertex_count]);
    for (path, before) in dense.edge_paths.iter().zip(&old.dense.edge_paths) {
        for i in 1..path.len() - 1 {
            let at = Share::of(i, path.len() - 1, before.len() - 1);
            points[path[i] as usize] = at.between(|k| old.points[before[k] as usize]);
        }
    }
    for face in 0..coarse.mesh.faces.len() {
        let (grid, before) = (dense.grid(coarse, face), old.dense.grid(coarse, face));
        fill_face(&grid, &before, &old.points, &mut points);
    }
    let mut is_boundary = vec![false; points.len()];
    for (held, rail) in loops.iter().zip(&ground.rails) {
        for ((&v, &q), &corner) in held.vertices.iter().zip(&held.along).zip(&held.corner) {
            is_boundary[v as usize] = true;
            let z = points[v as usize][2];
            let [x, y] = rail.at(q).point;
            if corner == NO_CORNER || v as usize >= coarse.mesh.vertex_count {
                points[v as usize] = ground.above([x, y, z]);
            }
        }
    }
    for (v, point) in points.iter_mut().enumerate().filter(|(v, _)| !is_boundary[*v]) {
        *point = if v < coarse.mesh.vertex_count { *point } else { ground.onto(*point) };
        if !ground.contains(*point) {
            *point = ground.onto(pushed_in(ground, *point));
        }
    }
    Sheet::new(ground, dense, points, loops, old.loop_lengths.clone())
}

/// A place among `old` parts: before which, and the share of it.
struct Share {
    index: usize,
    share: f64,
}

impl Share {
    /// Of row `i` of `new` rows.
    fn of(i: usize, new: usize, old: usize) -> Self {
        Self::at(i as f64 / new as f64 * old as f64, old)
    }

    fn at(place: f64, old: usize) -> Self {
        let index = (place.floor() as usize).min(old - 1);
        Self { index, share: place - index as f64 }
    }

    fn between(&self, point: impl Fn(usize) -> Vec3) -> Vec3 {
        add(scale(point(self.index), 1.0 - self.share), scale(point(self.index + 1), self.share))
    }
}

fn fill_face(grid: &Grid, before: &Grid, old: &[Vec3], points: &mut [Vec3]) {
    for j in 1..grid.m {
        let row = Share::of(j, grid.m, before.m);
        for i in 1..grid.n {
            let column = Share::of(i, grid.n, before.n);
            let along = |j: usize| column.between(|i| old[before.at(i, j) as usize]);
            points[grid.at(i, j) as usize] = row.between(along);
        }
    }
}

fn pushed_in(ground: &Ground<'_>, point: Vec3) -> Vec3 {
    let nearest = ground.nearest_boundary(point);
    let way = [nearest[0] - point[0], nearest[1] - point[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    if length > 0.0 {
        let step = INWARD / length;
        [nearest[0] + step * way[0], nearest[1] + step * way[1], point[2]]
    } else {
        point
    }
}

fn resample_loop(coarse: &Coarse<'_>, old: &Sheet, dense: &Dense, label: usize) -> Held {
    let before = &old.loops[label];
    let vertices = dense.loops[label].clone();
    let coarse_at = |vertices: &[u32]| -> Vec<usize> {
        (0..vertices.len()).filter(|&i| (vertices[i] as usize) < coarse.mesh.vertex_count).collect()
    };
    let (mut stations, mut old_stations) = (coarse_at(&vertices), coarse_at(&before.vertices));
    stations.push(vertices.len());
    old_stations.push(before.vertices.len());
    let n = before.vertices.len();
    // One turn on at the end: as far as the loop is long, which the first vertex and the rail know.
    let length = old.loop_lengths[label];
    let along_at = |i: usize| if i == n { before.along[0] + length } else { before.along[i] };
    let mut along = Vec::with_capacity(vertices.len());
    let mut corner = Vec::with_capacity(vertices.len());
    for (edge, old_edge) in stations.windows(2).zip(old_stations.windows(2)) {
        let (parts, old_parts) = (edge[1] - edge[0], old_edge[1] - old_edge[0]);
        let inside: Vec<usize> =
            (1..old_parts).filter(|i| before.corner[old_edge[0] + i] != NO_CORNER).collect();
        let span = [along_at(old_edge[0]), along_at(old_edge[1])];
        let shares: Vec<f64> =
            inside.iter().map(|i| (along_at(old_edge[0] + i) - span[0]) / (span[1] - span[0])).collect();
        let moved = corner_rows(&shares, parts);
        along.push(along_at(old_edge[0]));
        corner.push(before.corner[old_edge[0]]);
        for i in 1..parts {
            let taken = moved.iter().position(|&row| row == i);
            // Between the corners' rows before and after.
            let k = moved.iter().filter(|&&row| row <= i).count();
            let [from, to] =
                [k.checked_sub(1).map_or(0, |k| moved[k]), moved.get(k).copied().unwrap_or(parts)];
            let [old_from, old_to] =
                [k.checked_sub(1).map_or(0, |k| inside[k]), inside.get(k).copied().unwrap_or(old_parts)];
            let place = old_from as f64 + (i - from) as f64 / (to - from) as f64 * (old_to - old_from) as f64;
            let at = Share::at(place, old_parts);
            let (a, b) = (along_at(old_edge[0] + at.index), along_at(old_edge[0] + at.index + 1));
            along.push(if taken.is_some() {
                along_at(old_edge[0] + old_from)
            } else {
                a + at.share * (b - a)
            });
            corner.push(taken.map_or(NO_CORNER, |k| before.corner[old_edge[0] + inside[k]]));
        }
    }
    Held { vertices, along, corner, is_sharp: before.is_sharp }
}

/// The rows of an edge in `parts` at which its corners come to lie: as near as they can to their shares of its length, in their order.
fn corner_rows(shares: &[f64], parts: usize) -> Vec<usize> {
    let count = shares.len();
    let mut rows: Vec<usize> = Vec::with_capacity(count);
    for (j, share) in shares.iter().enumerate() {
        let after = rows.last().map_or(1, |row| row + 1);
        let nearest = (share * parts as f64 + 0.5).floor().max(0.0) as usize;
        let last = (parts + j).saturating_sub(count).max(after);
        rows.push(nearest.clamp(after, last));
    }
    rows
}
