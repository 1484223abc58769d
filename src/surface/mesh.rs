//! The surface of a triangle or quad mesh: points go to the closest point of it.

use super::error::SurfaceError;
use super::tree::TriangleTree;
use super::{Surface, SurfaceKind};
use crate::io::obj::{self, ObjFile};
use crate::io::{Input, LengthUnit, ReadError};
use std::path::Path;

/// A mesh as a surface. Quads are cut along their shorter diagonal; vertices may be unwelded.
#[derive(Clone, Debug)]
pub struct MeshSurface {
    tree: TriangleTree,
    /// Unit normal of each triangle, on the whole upwards.
    normals: Vec<[f64; 3]>,
    bounds: [[f64; 2]; 2],
    /// How far in plan the mesh reaches beyond its edges: exporters round to millimetres (ECOSYSTEM §3b).
    tolerance: f64,
}

impl MeshSurface {
    /// Reads an OBJ file whose coordinates have the given unit.
    ///
    /// # Errors
    /// A line at fault; a file without faces.
    pub fn read(input: Input<'_>, unit: LengthUnit) -> Result<Self, SurfaceError> {
        let obj = obj::read(input, unit)?;
        check_faces(&obj, input.file)?;
        Self::new(&obj.vertices, &obj.faces)
            .ok_or_else(|| SurfaceError::NoFaces { file: input.file.to_owned() })
    }

    /// A mesh from its triangles and quads; faces without area do not count. `None` if none is left.
    pub fn new(vertices: &[[f64; 3]], faces: &[Vec<u32>]) -> Option<Self> {
        let mut triangles = Vec::new();
        let mut normals = Vec::new();
        let mut sum = [0.0; 3];
        for corners in faces.iter().flat_map(|face| cut(vertices, face)) {
            let n = vector_area(&corners);
            let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            if length > 0.0 {
                triangles.push(corners);
                normals.push(n.map(|v| v / length));
                sum = std::array::from_fn(|k| sum[k] + n[k]);
            }
        }
        let tree = TriangleTree::new(&triangles)?;
        if sum[2] < 0.0 {
            normals.iter_mut().for_each(|n| *n = n.map(|v| -v));
        }
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for p in triangles.iter().flatten() {
            for k in 0..2 {
                bounds[0][k] = bounds[0][k].min(p[k]);
                bounds[1][k] = bounds[1][k].max(p[k]);
            }
        }
        let size = (bounds[1][0] - bounds[0][0]).hypot(bounds[1][1] - bounds[0][1]);
        Some(Self { tree, normals, bounds, tolerance: 1e-4 * size })
    }
}

/// Refuses faces that are neither triangles nor quads, and those that name a vertex twice.
fn check_faces(obj: &ObjFile, file: &Path) -> Result<(), SurfaceError> {
    for (face, &line) in obj.faces.iter().zip(&obj.face_lines) {
        let twice = face.iter().enumerate().find_map(|(i, v)| face[..i].contains(v).then_some(v));
        let reason = match (face.len(), twice) {
            (_, Some(v)) => format!("the face names vertex {} twice", v + 1),
            (3 | 4, None) => continue,
            (count, None) => format!(
                "the face has {count} vertices; allowed: triangles and quads (export without n-gons, or triangulate)"
            ),
        };
        return Err(ReadError::Line { file: file.to_owned(), line, reason }.into());
    }
    Ok(())
}

/// The triangles of a face.
fn cut(vertices: &[[f64; 3]], face: &[u32]) -> Vec<[[f64; 3]; 3]> {
    let p = |i: usize| vertices[face[i] as usize];
    let diagonal =
        |i: usize, j: usize| (0..3).map(|k| (p(i)[k] - p(j)[k]) * (p(i)[k] - p(j)[k])).sum::<f64>();
    match face.len() {
        3 => vec![[p(0), p(1), p(2)]],
        4 if diagonal(1, 3) < diagonal(0, 2) => vec![[p(1), p(2), p(3)], [p(1), p(3), p(0)]],
        4 => vec![[p(0), p(1), p(2)], [p(0), p(2), p(3)]],
        _ => Vec::new(),
    }
}

/// Half the cross product of two sides.
fn vector_area([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
    [0.5 * (u[1] * v[2] - u[2] * v[1]), 0.5 * (u[2] * v[0] - u[0] * v[2]), 0.5 * (u[0] * v[1] - u[1] * v[0])]
}

impl Surface for MeshSurface {
    fn kind(&self) -> SurfaceKind {
        SurfaceKind::Closest
    }

    fn height(&self, x: f64, y: f64) -> Option<f64> {
        // Without the tolerance first: a fold or a neighbour just beside must not lift the height.
        self.tree.highest(x, y, 0.0).or_else(|| self.tree.highest(x, y, self.tolerance))
    }

    fn project(&self, point: [f64; 3]) -> [f64; 3] {
        self.tree.closest(point).point
    }

    fn normal(&self, point: [f64; 3]) -> [f64; 3] {
        self.normals[self.tree.closest(point).triangle as usize]
    }

    fn foot(&self, point: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let closest = self.tree.closest(point);
        (closest.point, self.normals[closest.triangle as usize])
    }

    fn extent(&self) -> String {
        let [[x0, y0], [x1, y1]] = self.bounds;
        let upright = x0 == x1 || y0 == y1;
        let hint = if upright { "; it stands upright: files are read with z up" } else { "" };
        format!("the mesh lies within x {x0} to {x1}, y {y0} to {y1}{hint}")
    }

    fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        Some(self.bounds)
    }

    fn is_smooth(&self) -> bool {
        false
    }
}
