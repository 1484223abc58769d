//! A coarse quad layout of a domain: vertices with their places on the boundary, and the edits that make it a sound mesh.

use super::graph::{along, plan, stretch};
use super::triangulation::Site;
use crate::domain::Domain;
use std::collections::BTreeMap;

/// A vertex of the layout.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Vertex {
    /// Position in plan, m.
    pub(super) xy: [f64; 2],
    /// Where it sits on the boundary; `None` inside.
    pub(super) site: Option<Site>,
}

/// Vertices and counter-clockwise quads.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) struct Layout {
    pub(super) vertices: Vec<Vertex>,
    pub(super) faces: Vec<[usize; 4]>,
}

/// A new vertex of the boundary may be had by sliding one that is nearer than this share of its edges.
const SLIDE: f64 = 0.25;

impl Layout {
    /// Adds a vertex on the boundary.
    pub(super) fn on_boundary(&mut self, domain: &Domain, site: Site) -> usize {
        self.vertices.push(Vertex { xy: plan(domain, site), site: Some(site) });
        self.vertices.len() - 1
    }

    /// Adds a vertex inside.
    pub(super) fn inside(&mut self, xy: [f64; 2]) -> usize {
        self.vertices.push(Vertex { xy, site: None });
        self.vertices.len() - 1
    }

    /// The vertices on a loop in the order of the boundary with the domain on the left, with their sites.
    pub(super) fn boundary(&self, loop_number: usize) -> Vec<(usize, Site)> {
        let on_loop =
            |(v, vertex): (usize, &Vertex)| Some((v, vertex.site.filter(|s| s.loop_number == loop_number)?));
        let mut boundary: Vec<_> = self.vertices.iter().enumerate().filter_map(on_loop).collect();
        boundary.sort_by(|a, b| a.1.s.total_cmp(&b.1.s));
        if loop_number > 0 {
            boundary.reverse();
        }
        boundary
    }

    fn face_count(&self, vertex: usize) -> usize {
        self.faces.iter().filter(|f| f.contains(&vertex)).count()
    }

    /// Gives every corner of the domain, and its mark, a vertex: by sliding a near one, or by splitting a strip.
    pub(super) fn place_corners(&mut self, domain: &Domain) {
        for corner in 0..domain.corner_count() {
            if let Some((loop_number, s)) = domain.corner(corner) {
                self.place(domain, Site { loop_number, s, corner: Some(corner) });
            }
        }
        if let Some(s) = domain.mark() {
            self.place(domain, Site { loop_number: 0, s, corner: None });
        }
    }

    fn place(&mut self, domain: &Domain, site: Site) {
        let boundary = self.boundary(site.loop_number);
        if boundary.is_empty() || boundary.iter().any(|&(_, other)| other.s == site.s) {
            return;
        }
        let n = boundary.len();
        let before = (0..n)
            .min_by(|&i, &j| {
                stretch(domain, boundary[i].1, site).total_cmp(&stretch(domain, boundary[j].1, site))
            })
            .unwrap_or(0);
        let after = (before + 1) % n;
        let gap = |i: usize, j: usize| stretch(domain, boundary[i % n].1, boundary[j % n].1);
        let edge = gap(before, after);
        let to_before = stretch(domain, boundary[before].1, site);
        let candidates = [
            (before, to_before, edge.min(gap(before + n - 1, before))),
            (after, edge - to_before, edge.min(gap(after, after + 1))),
        ];
        let near = candidates
            .into_iter()
            .filter(|&(i, way, shortest)| boundary[i].1.corner.is_none() && way < SLIDE * shortest)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        match near {
            Some((i, ..)) => {
                self.vertices[boundary[i].0] = Vertex { xy: plan(domain, site), site: Some(site) }
            }
            None => self.split(domain, [boundary[before].0, boundary[after].0], site),
        }
    }

    /// Splits boundary edges until every loop has at least three vertices.
    pub(super) fn fill_loops(&mut self, domain: &Domain) {
        for loop_number in 0..domain.loops.len() {
            for _ in 0..3 {
                let boundary = self.boundary(loop_number);
                let n = boundary.len();
                if n == 0 || n >= 3 {
                    break;
                }
                // Both of two edges, so that a symmetric loop stays so.
                for i in 0..n {
                    let (a, b) = (boundary[i], boundary[(i + 1) % n]);
                    self.split(domain, [a.0, b.0], along(domain, a.1, b.1, 0.5));
                }
            }
        }
    }

    /// Splits a boundary edge at a site, and with it every edge of its strip in the middle.
    fn split(&mut self, domain: &Domain, edge: [usize; 2], site: Site) {
        let key = |a: usize, b: usize| [a.min(b), a.max(b)];
        let mut middles: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut stack = vec![key(edge[0], edge[1])];
        while let Some([a, b]) = stack.pop() {
            if middles.contains_key(&[a, b]) {
                continue;
            }
            let sides: Vec<(usize, usize)> = self.sides_of(a, b);
            let vertex =
                if middles.is_empty() { self.on_boundary(domain, site) } else { self.middle(domain, &sides) };
            middles.insert([a, b], vertex);
            for (face, side) in sides {
                let corners = self.faces[face];
                stack.push(key(corners[(side + 2) % 4], corners[(side + 3) % 4]));
            }
        }
        let old = std::mem::take(&mut self.faces);
        for face in old {
            let at = |k: usize| middles.get(&key(face[k], face[(k + 1) % 4])).copied();
            let [a, b, c, d] = face;
            match [at(0), at(1), at(2), at(3)] {
                [Some(m), None, Some(n), None] => self.faces.extend([[a, m, n, d], [m, b, c, n]]),
                [None, Some(m), None, Some(n)] => self.faces.extend([[a, b, m, n], [n, m, c, d]]),
                [Some(m0), Some(m1), Some(m2), Some(m3)] => {
                    let x = self.inside(self.center(&face));
                    self.faces.extend([[a, m0, x, m3], [m0, b, m1, x], [x, m1, c, m2], [m3, x, m2, d]]);
                }
                _ => self.faces.push(face),
            }
        }
    }

    /// The faces that have the edge, and which of their sides it is.
    fn sides_of(&self, a: usize, b: usize) -> Vec<(usize, usize)> {
        let side = |f: &[usize; 4]| {
            (0..4).find(|&k| [f[k], f[(k + 1) % 4]] == [a, b] || [f[k], f[(k + 1) % 4]] == [b, a])
        };
        self.faces.iter().enumerate().filter_map(|(i, f)| Some((i, side(f)?))).collect()
    }

    /// A vertex in the middle of an edge given by the sides of its faces; on the boundary if it has one face.
    fn middle(&mut self, domain: &Domain, sides: &[(usize, usize)]) -> usize {
        let (face, side) = sides[0];
        let (a, b) = (self.faces[face][side], self.faces[face][(side + 1) % 4]);
        let (p, q) = (self.vertices[a], self.vertices[b]);
        if let (1, Some(s), Some(t)) = (sides.len(), p.site, q.site) {
            return self.on_boundary(domain, along(domain, s, t, 0.5));
        }
        self.inside([0, 1].map(|k| 0.5 * (p.xy[k] + q.xy[k])))
    }

    fn center(&self, face: &[usize; 4]) -> [f64; 2] {
        [0, 1].map(|k| 0.25 * face.iter().map(|&v| self.vertices[v].xy[k]).sum::<f64>())
    }

    /// Adds strips along the boundary where a vertex that is no corner has a single face, which would be a quad with a straight
    /// angle: from corner to corner, or around a loop that has none.
    pub(super) fn pad_pinched(&mut self, domain: &Domain) {
        for loop_number in 0..domain.loops.len() {
            // Each round pads one stretch; there are no more stretches than corners.
            for _ in 0..=domain.corner_count() {
                let boundary = self.boundary(loop_number);
                let single = |&(v, _): &(usize, Site)| self.face_count(v) == 1;
                let Some(pinched) = boundary.iter().position(|b| b.1.corner.is_none() && single(b)) else {
                    break;
                };
                let stops: Vec<usize> = (0..boundary.len())
                    .filter(|&i| boundary[i].1.corner.is_some() && single(&boundary[i]))
                    .collect();
                if stops.len() < 2 {
                    self.pad_loop(domain, &boundary);
                    break;
                }
                let end = stops.iter().copied().find(|&i| i > pinched).unwrap_or(stops[0]);
                let start =
                    stops.iter().rev().copied().find(|&i| i < pinched).unwrap_or(stops[stops.len() - 1]);
                self.pad_stretch(domain, &boundary, start, end);
            }
        }
    }

    /// A closed strip around a loop.
    fn pad_loop(&mut self, domain: &Domain, boundary: &[(usize, Site)]) {
        let outer: Vec<usize> = boundary.iter().map(|&(_, site)| self.on_boundary(domain, site)).collect();
        let inner: Vec<usize> = boundary.iter().map(|&(v, _)| v).collect();
        self.draw_in(&inner);
        let n = inner.len();
        for i in 0..n {
            let j = (i + 1) % n;
            self.faces.push([outer[i], outer[j], inner[j], inner[i]]);
        }
    }

    /// A strip from one corner along the boundary to another. The old corner vertices slide onto the sides beyond.
    fn pad_stretch(&mut self, domain: &Domain, boundary: &[(usize, Site)], start: usize, end: usize) {
        let n = boundary.len();
        let count = (end + n - start) % n + 1;
        let path: Vec<(usize, Site)> = (0..count).map(|k| boundary[(start + k) % n]).collect();
        let outer: Vec<usize> = path.iter().map(|&(_, site)| self.on_boundary(domain, site)).collect();
        let (before, after) = (boundary[(start + n - 1) % n].1, boundary[(end + 1) % n].1);
        let first = along(domain, before, path[0].1, 2.0 / 3.0);
        let last = along(domain, path[count - 1].1, after, 1.0 / 3.0);
        for (v, site) in [(path[0].0, first), (path[count - 1].0, last)] {
            self.vertices[v] = Vertex { xy: plan(domain, site), site: Some(site) };
        }
        let inner: Vec<usize> = path.iter().map(|&(v, _)| v).collect();
        self.draw_in(&inner[1..count - 1]);
        for k in 1..count {
            self.faces.push([outer[k - 1], outer[k], inner[k], inner[k - 1]]);
        }
    }

    /// Takes vertices off the boundary and some way towards the middle of their faces.
    fn draw_in(&mut self, vertices: &[usize]) {
        const SHARE: f64 = 0.35;
        let targets: Vec<[f64; 2]> = vertices
            .iter()
            .map(|v| {
                let centers: Vec<_> =
                    self.faces.iter().filter(|f| f.contains(v)).map(|f| self.center(f)).collect();
                [0, 1].map(|k| centers.iter().map(|c| c[k]).sum::<f64>() / centers.len().max(1) as f64)
            })
            .collect();
        for (&v, target) in vertices.iter().zip(targets) {
            let xy = self.vertices[v].xy;
            self.vertices[v] = Vertex { xy: [0, 1].map(|k| xy[k] + SHARE * (target[k] - xy[k])), site: None };
        }
    }
}
