//! The surface of a triangle or quad mesh: points go to the closest point of what is seen of it from above.

use super::error::SurfaceError;
use super::skin::Skin;
use super::triangle::{Triangle, square, sub, vector_area};
use super::{Surface, SurfaceKind};
use crate::io::obj::{self, ObjFile};
use crate::io::{Input, LengthUnit, ReadError};
use std::path::Path;

/// A mesh as a surface: its upper skin. Quads are cut along their shorter diagonal; vertices may be unwelded, faces wound either
/// way.
#[derive(Clone, Debug)]
pub struct MeshSurface {
    skin: Skin,
    /// What to say where it does not reach: that most of it faces y, as the roofs of files with y up do.
    hint: String,
}

impl MeshSurface {
    /// Reads an OBJ file whose coordinates have the given unit.
    ///
    /// # Errors
    /// A line at fault; a file without faces.
    pub fn read(Input { file, bytes }: Input<'_>, unit: LengthUnit) -> Result<Self, SurfaceError> {
        let obj = obj::read(Input { file, bytes }, unit)?;
        check_faces(&obj, file)?;
        let no_faces = || SurfaceError::NoFaces { file: file.to_owned(), hint: obj.hint() };
        let mut surface = Self::new(&obj.vertices, &obj.faces).ok_or_else(no_faces)?;
        if !surface.hint.is_empty() {
            let line = obj.face_lines.first().copied().unwrap_or_default();
            surface.hint = format!("; {}:{line}{}", file.display(), surface.hint.replacen(';', ":", 1));
        }
        Ok(surface)
    }

    /// A mesh from its triangles and quads; faces without area do not count. `None` if none is left.
    pub fn new(vertices: &[[f64; 3]], faces: &[Vec<u32>]) -> Option<Self> {
        let triangles: Vec<Triangle> = faces.iter().flat_map(|face| cut(vertices, face)).collect();
        let [_, y, z] = triangles
            .iter()
            .map(vector_area)
            .fold([0.0; 3], |sum: [f64; 3], area| std::array::from_fn(|k| sum[k] + area[k].abs()));
        let hint = if y > z {
            "; most of the mesh faces y, as in files with y up: files are read with z up, so export it with z up"
        } else {
            ""
        };
        Some(Self { skin: Skin::new(triangles.into_iter())?, hint: hint.to_owned() })
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

/// The triangles of a face. Where both diagonals of a quad are equally long, that from its least corner is taken, wherever the file
/// begins.
fn cut(vertices: &[[f64; 3]], face: &[u32]) -> Vec<Triangle> {
    let p = |i: usize| vertices[face[i] as usize];
    let diagonal = |i: usize, j: usize| square(sub(p(i), p(j)));
    let turned = || {
        let (first, second) = (diagonal(0, 2), diagonal(1, 3));
        let least = (1..4).fold(0, |least, i| if p(i) < p(least) { i } else { least });
        let is_tie = (first - second).abs() <= 1e-9 * first.max(second);
        if is_tie { least % 2 == 1 } else { second < first }
    };
    match face.len() {
        3 => vec![[p(0), p(1), p(2)]],
        4 if turned() => vec![[p(1), p(2), p(3)], [p(1), p(3), p(0)]],
        4 => vec![[p(0), p(1), p(2)], [p(0), p(2), p(3)]],
        _ => Vec::new(),
    }
}

impl Surface for MeshSurface {
    fn kind(&self) -> SurfaceKind {
        SurfaceKind::Closest
    }

    fn height(&self, x: f64, y: f64) -> Option<f64> {
        self.skin.height(x, y)
    }

    fn project(&self, point: [f64; 3]) -> [f64; 3] {
        self.skin.closest(point).point
    }

    fn normal(&self, point: [f64; 3]) -> [f64; 3] {
        self.foot(point).1
    }

    fn foot(&self, point: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let closest = self.skin.closest(point);
        (closest.point, self.skin.normal(&closest))
    }

    fn extent(&self) -> String {
        let [[x0, y0], [x1, y1]] = self.skin.bounds;
        format!("the mesh lies within x {x0} to {x1}, y {y0} to {y1}{}", self.hint)
    }

    fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        Some(self.skin.bounds)
    }

    fn is_smooth(&self) -> bool {
        false
    }
}
