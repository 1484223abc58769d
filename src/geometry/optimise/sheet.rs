//! A dense mesh with positions and boundary stations in local units, and which boundary vertices take a corner.

use super::Task;
use super::ground::Ground;
use super::net::Link;
use crate::geometry::boundary::{self, BoundaryLoop};
use crate::geometry::coarse::Coarse;
use crate::geometry::dense::{Dense, Edges};
use crate::geometry::images;
use crate::geometry::pattern::{Panel, Pattern};
use crate::geometry::vector::Vec3;

/// A boundary vertex that takes no corner.
pub const NO_CORNER: u32 = u32::MAX;

/// Positions of all vertices, and arc lengths of the boundary vertices by loop, local units.
pub type State = (Vec<Vec3>, Vec<Vec<f64>>);

/// A dense mesh that has positions.
pub struct Sheet {
    /// Its topology.
    pub dense: Dense,
    /// Its edges.
    pub edges: Edges,
    /// Its panels; a triangle's last vertex comes twice.
    pub quads: Vec<[u32; 4]>,
    /// Positions, local units.
    pub points: Vec<Vec3>,
    /// Its boundary loops in the order of [`Dense::loops`].
    pub loops: Vec<Held>,
    /// Length of each loop's rail, local units.
    pub loop_lengths: Vec<f64>,
    /// Arc length of each boundary vertex along its rail, local units; 0 of an inner one.
    pub station: Vec<f64>,
    /// Where the symmetries take it that it is kept to.
    pub twins: Vec<Twin>,
}

/// Where a symmetry takes the vertices of a sheet and the plan lengths of its boundary.
pub struct Twin {
    /// The image of each vertex.
    pub vertices: Vec<u32>,
    /// What x and y are multiplied by.
    pub signs: [f64; 2],
    /// For each loop, its image, and `c` and ±1 for q → c ± q.
    pub loops: Vec<(usize, f64, f64)>,
}

/// A boundary loop on its rail.
#[derive(Clone)]
pub struct Held {
    /// Its vertices, counter-clockwise.
    pub vertices: Vec<u32>,
    /// Plan arc lengths, ascending, over less than one turn, local units.
    pub along: Vec<f64>,
    /// For each vertex the corner of the domain that it takes, or the mark; `NO_CORNER` for most.
    pub corner: Vec<u32>,
    /// Whether its corners are kinks.
    pub is_sharp: bool,
}

impl Held {
    /// From the loop as placing has it, whose first vertex is an anchor, in the order of `vertices`; `stations` in local units,
    /// `first_corner` the number of the loop's first corner.
    fn of(vertices: &[u32], placed: &BoundaryLoop, stations: &[f64], length: f64, first_corner: u32) -> Self {
        let n = vertices.len();
        let start = vertices.iter().position(|v| Some(v) == placed.vertices.first()).unwrap_or(0);
        // Vertex `i` of ours is vertex `i + n − start` of theirs; before that their stations are one turn too far.
        let theirs = |i: usize| (i + n - start) % n;
        let along = (0..n).map(|i| stations[theirs(i)] - if i < start { length } else { 0.0 }).collect();
        let corner = vertices
            .iter()
            .map(|v| {
                placed.corners.iter().position(|c| c == v).map_or(NO_CORNER, |k| first_corner + k as u32)
            })
            .collect();
        Self { vertices: vertices.to_vec(), along, corner, is_sharp: placed.is_sharp }
    }
}

impl Sheet {
    /// A mesh as placing leaves it: points in local units, the loops' arc lengths on the surface in metres.
    pub fn placed(
        ground: &Ground<'_>,
        dense: Dense,
        points: Vec<Vec3>,
        loops: &[BoundaryLoop],
        along: &[Vec<f64>],
    ) -> Self {
        let mut first_corner = 0;
        let mut held = Vec::with_capacity(loops.len());
        for (label, placed) in loops.iter().enumerate() {
            let rail = &ground.rails[label];
            let stations: Vec<f64> = along[label].iter().map(|&s| rail.plan_station(s)).collect();
            held.push(Held::of(&dense.loops[label], placed, &stations, rail.length, first_corner));
            first_corner += placed.corners.len() as u32;
        }
        let lengths = ground.rails.iter().map(|rail| rail.length).collect();
        Self::new(ground, dense, points, held, lengths)
    }

    /// A mesh with its positions.
    pub fn new(
        ground: &Ground<'_>,
        dense: Dense,
        points: Vec<Vec3>,
        loops: Vec<Held>,
        loop_lengths: Vec<f64>,
    ) -> Self {
        let edges = Edges::of(dense.vertex_count, &dense.panels);
        let quads = dense.panels.iter().map(Panel::as_quad).collect();
        let station = vec![0.0; points.len()];
        let twins = ground.images.iter().map(|image| {
            Some(Twin {
                vertices: image.of_dense(dense.vertex_count, &dense.panels, &dense.loops)?,
                signs: image.kind.signs(),
                loops: (0..loops.len()).map(|label| ground.rail_image(image, label)).collect(),
            })
        });
        let twins = twins.collect::<Option<Vec<Twin>>>().unwrap_or_default();
        let mut sheet = Self { edges, quads, station, points, loops, loop_lengths, dense, twins };
        sheet.note_stations();
        sheet
    }

    /// Moves the vertices.
    pub fn set(&mut self, (points, along): State) {
        self.points = points;
        for (held, along) in self.loops.iter_mut().zip(along) {
            held.along = along;
        }
        self.note_stations();
    }

    fn note_stations(&mut self) {
        for held in &self.loops {
            for (&v, &q) in held.vertices.iter().zip(&held.along) {
                self.station[v as usize] = q;
            }
        }
    }

    /// For each vertex of a loop, the arc lengths of the corners before (or at) and after it; infinite where the loop has none.
    pub fn ranges(&self, label: usize) -> Vec<[f64; 2]> {
        let held = &self.loops[label];
        let length = self.loop_lengths[label];
        let n = held.vertices.len();
        let corners: Vec<usize> = (0..n).filter(|&i| held.corner[i] != NO_CORNER).collect();
        let (Some(&first), Some(&last)) = (corners.first(), corners.last()) else {
            return vec![[f64::NEG_INFINITY, f64::INFINITY]; n];
        };
        (0..n)
            .map(|i| {
                let after = corners.partition_point(|&corner| corner <= i);
                let before =
                    after.checked_sub(1).map_or(held.along[last] - length, |k| held.along[corners[k]]);
                [before, corners.get(after).map_or(held.along[first] + length, |&k| held.along[k])]
            })
            .collect()
    }

    /// The boundary's edges.
    pub fn links(&self, ground: &Ground<'_>) -> Vec<Link> {
        let mut links = Vec::new();
        for (label, held) in self.loops.iter().enumerate() {
            let rail = &ground.rails[label];
            let n = held.vertices.len();
            let mut side = [f64::NAN; 2];
            let mut is_curved = true;
            for (i, here) in self.ranges(label).into_iter().enumerate() {
                if here != side {
                    side = here;
                    is_curved = !side[0].is_finite() || !rail.is_straight(side[0], side[1]);
                }
                let offset = if i + 1 == n { rail.length } else { 0.0 };
                links.push(Link {
                    from: held.vertices[i],
                    to: held.vertices[(i + 1) % n],
                    offset,
                    is_curved,
                });
            }
        }
        links
    }

    /// Vertices of which no corner counts.
    pub fn silent_vertices(&self) -> Vec<bool> {
        let mut members = vec![0u32; self.points.len()];
        for &v in self.edges.list.iter().flatten() {
            members[v as usize] += 1;
        }
        let mut panels = vec![0u32; self.points.len()];
        for &v in self.dense.panels.iter().flat_map(Panel::corners) {
            panels[v as usize] += 1;
        }
        let mut silent: Vec<bool> = members.iter().map(|&n| n == 2).collect();
        for held in &self.loops {
            for (&v, &corner) in held.vertices.iter().zip(&held.corner) {
                silent[v as usize] = panels[v as usize] == 1 && (corner == NO_CORNER || !held.is_sharp);
            }
        }
        silent
    }

    /// Inner vertices of panels that touch the boundary.
    pub fn near_boundary(&self) -> Vec<u32> {
        let held = self.loops.iter().flat_map(|held| &held.vertices);
        boundary::beside(&self.dense.panels, &boundary::marked(self.points.len(), held))
    }

    /// Loops without a kink that takes part.
    pub fn smooth_loops(&self) -> Vec<usize> {
        let is_smooth = |held: &Held| !held.is_sharp || held.corner.iter().all(|&c| c == NO_CORNER);
        (0..self.loops.len()).filter(|&label| is_smooth(&self.loops[label])).collect()
    }

    /// Rows of each strip.
    pub fn dense_parts(&self, coarse: &Coarse<'_>) -> Vec<u32> {
        let mut parts = vec![1; coarse.mesh.strips.len()];
        for (path, &s) in self.dense.edge_paths.iter().zip(&coarse.edge_strip) {
            parts[s as usize] = path.len() as u32 - 1;
        }
        parts
    }

    /// The pattern in metres, corners exactly on those of the domain. Its loops begin at their first corner.
    pub fn pattern(&self, task: &Task<'_>, ground: &Ground<'_>, (points, along): &State) -> Pattern {
        let mut positions: Vec<Vec3> = points.iter().map(|&p| ground.global(p)).collect();
        let mut corners = Vec::new();
        let mut loop_corners = Vec::new();
        let mut loops = Vec::new();
        let mut stations = Vec::new();
        for (label, (held, (numbering, curve))) in
            self.loops.iter().zip(task.corners.iter().zip(&task.domain.loops)).enumerate()
        {
            let taken: Vec<(usize, u32)> = numbering
                .numbers
                .clone()
                .filter_map(|k| {
                    held.corner.iter().position(|&c| c as usize == k).map(|i| (i, held.vertices[i]))
                })
                .collect();
            for (&(_, v), &s) in taken.iter().zip(&numbering.at) {
                positions[v as usize] = curve.point(s);
            }
            let start = corners.len();
            if numbering.sharp {
                corners.extend(taken.iter().map(|&(_, v)| v));
            }
            loop_corners.push(start..corners.len());
            let first = taken.first().map_or(0, |&(i, _)| i);
            let mut vertices = held.vertices.clone();
            vertices.rotate_left(first);
            loops.push(vertices);
            stations.push(ground.rails[label].turned(&along[label], first));
        }
        let mut pattern = Pattern {
            positions,
            panels: self.dense.panels.clone(),
            edges: self.edges.list.clone(),
            loops,
            along: stations,
            corners,
            loop_corners,
            coarse: (0..task.coarse.mesh.vertex_count as u32).collect(),
            coarse_face: self.dense.coarse_face.clone(),
            target_length: task.limits.target_length,
        };
        images::even_out(&mut pattern, &ground.images, task.domain, task.surface);
        pattern
    }
}
