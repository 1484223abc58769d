//! Delaunay triangulation of points along the boundary: its inner triangles follow the medial axis.

use super::SkeletonError;
use crate::domain::Domain;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

/// A point of the boundary.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Site {
    /// The loop.
    pub(super) loop_number: usize,
    /// Arc length along it.
    pub(super) s: f64,
    /// The corner of the domain that is there.
    pub(super) corner: Option<usize>,
}

/// An inner triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Its samples, counter-clockwise.
    pub(super) corners: [usize; 3],
    /// The triangle across edge `i`–`i + 1`; none across the boundary.
    pub(super) neighbours: [Option<usize>; 3],
}

/// Points along all boundaries and the Delaunay triangles between them that lie in the domain.
pub(super) struct Triangulation {
    pub(super) sites: Vec<Site>,
    pub(super) points: Vec<[f64; 2]>,
    pub(super) triangles: Vec<Triangle>,
}

/// Samples per size of the domain to begin with.
const FIRST: f64 = 240.0;
/// Points nearer to a corner than this share of the spacing are left out.
const FILLET: f64 = 0.25;
/// Most samples.
const MOST: usize = 30_000;

impl Triangulation {
    /// Samples the boundary, ever finer until the narrowest gap is at least two spacings wide.
    pub(super) fn of(domain: &Domain) -> Result<Self, SkeletonError> {
        let mut spacing = domain.size() / FIRST;
        loop {
            let triangulation = Self::with_spacing(domain, spacing)?;
            let gap = triangulation.narrowest(domain);
            if gap >= 2.0 * spacing || triangulation.sites.len() > MOST / 2 {
                return Ok(triangulation);
            }
            spacing *= 0.5;
        }
    }

    fn with_spacing(domain: &Domain, spacing: f64) -> Result<Self, SkeletonError> {
        let (mut sites, mut points, mut edges) = (Vec::new(), Vec::new(), Vec::new());
        for (loop_number, boundary) in domain.loops.iter().enumerate() {
            let start = sites.len();
            let numbers = domain.loop_corners(loop_number);
            // The kinks of a fillet beside its corner would only make branches and forks as small as it is.
            let beside = |s: f64| {
                let way = |c: f64| (s - c).abs().min(boundary.length() - (s - c).abs());
                boundary.corners().iter().any(|&c| c != s && way(c) < FILLET * spacing)
            };
            let corners = boundary.corners();
            for s in boundary.sample(spacing).into_iter().filter(|s| corners.contains(s) || !beside(*s)) {
                let corner = boundary.corners().iter().position(|&c| c == s).map(|i| numbers.start + i);
                let [x, y, _] = boundary.point(s);
                sites.push(Site { loop_number, s, corner });
                points.push([x, y]);
            }
            let count = sites.len() - start;
            // With the domain on the left: holes run counter-clockwise themselves.
            let edge = |i: usize| [start + i, start + (i + 1) % count];
            edges.extend((0..count).map(edge).map(|[a, b]| if loop_number == 0 { [a, b] } else { [b, a] }));
        }
        let triangles = inner_triangles(&points, &edges)?;
        Ok(Self { sites, points, triangles })
    }

    /// Shortest edge across the domain: from loop to loop, or from a loop to a far part of itself.
    fn narrowest(&self, domain: &Domain) -> f64 {
        let mut gap = f64::INFINITY;
        for triangle in &self.triangles {
            for i in (0..3).filter(|&i| triangle.neighbours[i].is_some()) {
                let (a, b) = (triangle.corners[i], triangle.corners[(i + 1) % 3]);
                let length = distance(self.points[a], self.points[b]);
                let across = if self.sites[a].loop_number == self.sites[b].loop_number {
                    let whole = domain.loops[self.sites[a].loop_number].length();
                    let along = (self.sites[a].s - self.sites[b].s).abs();
                    along.min(whole - along) > 10.0 * length
                } else {
                    true
                };
                if across {
                    gap = gap.min(length);
                }
            }
        }
        gap
    }

    /// The circumcentre of a triangle.
    pub(super) fn center(&self, triangle: usize) -> [f64; 2] {
        let [a, b, c] = self.triangles[triangle].corners.map(|i| self.points[i]);
        circumcenter(a, b, c)
    }
}

/// The centre of the circle through three points.
pub(super) fn circumcenter(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> [f64; 2] {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let area = 2.0 * (u[0] * v[1] - u[1] * v[0]);
    [a[0] + (v[1] * uu - u[1] * vv) / area, a[1] + (u[0] * vv - v[0] * uu) / area]
}

/// The Delaunay triangles on the left of the boundary edges.
fn inner_triangles(points: &[[f64; 2]], edges: &[[usize; 2]]) -> Result<Vec<Triangle>, SkeletonError> {
    let vertices = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let mut conflict = None;
    let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
        vertices,
        edges.to_vec(),
        |edge| {
            conflict.get_or_insert(edge);
        },
    )
    .map_err(|e| SkeletonError::Triangulation { reason: e.to_string() })?;
    if let Some([a, _]) = conflict {
        let [x, y] = points.get(a).copied().unwrap_or_default();
        return Err(SkeletonError::Triangulation {
            reason: format!("boundaries are too close near ({x:.3}, {y:.3})"),
        });
    }
    if cdt.num_vertices() != points.len() {
        return Err(SkeletonError::Triangulation {
            reason: "two points of the boundary coincide".to_owned(),
        });
    }
    let faces: Vec<_> = cdt.inner_faces().collect();
    let mut number = vec![usize::MAX; cdt.num_all_faces()];
    for (i, face) in faces.iter().enumerate() {
        number[face.fix().index()] = i;
    }
    let all: Vec<Triangle> = faces
        .iter()
        .map(|face| {
            let sides = face.adjacent_edges();
            Triangle {
                corners: sides.map(|e| e.from().fix().index()),
                neighbours: sides.map(|e| {
                    let across = number[e.rev().face().fix().index()];
                    (!e.is_constraint_edge() && across != usize::MAX).then_some(across)
                }),
            }
        })
        .collect();
    Ok(only_inside(&all, edges))
}

/// Keeps the triangles that belong to the domain: those on the left of boundary edges, and all that are reached from them without
/// crossing the boundary.
fn only_inside(all: &[Triangle], edges: &[[usize; 2]]) -> Vec<Triangle> {
    let mut after = vec![usize::MAX; edges.len()];
    for &[a, b] in edges {
        after[a] = b;
    }
    let mut order = vec![usize::MAX; all.len()];
    let mut inside: Vec<usize> = (0..all.len())
        .filter(|&t| (0..3).any(|i| after[all[t].corners[i]] == all[t].corners[(i + 1) % 3]))
        .collect();
    for (i, &t) in inside.iter().enumerate() {
        order[t] = i;
    }
    let mut next = 0;
    while next < inside.len() {
        for neighbour in all[inside[next]].neighbours.into_iter().flatten() {
            if order[neighbour] == usize::MAX {
                order[neighbour] = inside.len();
                inside.push(neighbour);
            }
        }
        next += 1;
    }
    inside
        .iter()
        .map(|&t| Triangle { neighbours: all[t].neighbours.map(|n| n.map(|n| order[n])), ..all[t] })
        .collect()
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
