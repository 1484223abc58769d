//! Same or different (docs/reference/grammar.md §6): codes under the options of isomorphism, the canonical mesh, symmetries.

use super::canonical::{CanonicalMesh, Code, Strip};
use super::code::{self, Numbering};
use super::ids::DartId;
use super::quad_mesh::{Dart, Left, Mark, QuadMesh};
use super::reduce::fewest_parallel;
use super::strips;

/// Options of isomorphism.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Equivalence {
    /// Labels of boundary loops and corner marks count.
    pub placed: bool,
    /// Parallel strips do not count.
    pub reduce: bool,
    /// A mirrored mesh is the same.
    pub mirror: bool,
}

impl Default for Equivalence {
    fn default() -> Self {
        Self { placed: true, reduce: true, mirror: false }
    }
}

impl Equivalence {
    /// The code of a mesh: equal exactly for meshes that are the same under these options.
    pub fn code(self, mesh: &QuadMesh) -> Code {
        self.representative(mesh).code()
    }

    /// What stands for a mesh under these options: of the reduced meshes, if they are asked for, the one with the
    /// smallest code.
    pub fn representative(self, mesh: &QuadMesh) -> Representative {
        let mut candidates =
            if self.reduce { fewest_parallel(mesh, self.placed) } else { vec![mesh.clone()] }.into_iter();
        let first = candidates.next().unwrap_or_else(|| mesh.clone());
        candidates.fold(self.numbered(first), |best, candidate| best.smaller(self.numbered(candidate)))
    }

    fn numbered(self, mesh: QuadMesh) -> Representative {
        let upright = Representative::new(mesh, self.placed);
        if self.mirror {
            let image = Representative::new(mirrored(&upright.mesh), self.placed);
            upright.smaller(image)
        } else {
            upright
        }
    }
}

/// A mesh with its smallest code.
#[derive(Clone, Debug)]
pub struct Representative {
    /// The mesh, reduced or mirrored where that was asked for.
    pub mesh: QuadMesh,
    numbering: Numbering,
}

impl Representative {
    fn new(mesh: QuadMesh, placed: bool) -> Self {
        let numbering = code::number(&mesh, placed);
        Self { mesh, numbering }
    }

    /// Its code.
    pub fn code(&self) -> Code {
        self.numbering.code()
    }

    fn smaller(self, other: Self) -> Self {
        if other.numbering.is_smaller_than(&self.numbering) { other } else { self }
    }
}

/// The mesh seen from behind: all faces turned over, everything else the same.
pub fn mirrored(mesh: &QuadMesh) -> QuadMesh {
    let reversed = |d: DartId| {
        let dart = mesh.dart(d);
        Dart {
            next: dart.prev,
            prev: dart.next,
            origin: mesh.end(d),
            pole: mesh.dart(dart.next).pole,
            ..*dart
        }
    };
    QuadMesh { darts: mesh.darts().map(reversed).collect(), ..mesh.clone() }
}

/// A symmetry of the domain, as it acts on what a placed mesh knows of the domain.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Symmetry {
    /// Boundary loop `k` goes to `loops[k]`.
    pub loops: Vec<u32>,
    /// Corner `k` goes to `corners[k]`.
    pub corners: Vec<u32>,
    /// It turns the orientation over: a reflection.
    pub reversed: bool,
}

impl Symmetry {
    /// Where a corner goes; one that is not named stays.
    pub fn corner(&self, corner: u32) -> u32 {
        self.corners.get(corner as usize).copied().unwrap_or(corner)
    }

    /// What comes to lie on the left of a dart that has this on its left: another loop, on an outside dart.
    pub fn left(&self, left: Left) -> Left {
        let image = |label: u32| Left::outside(self.loops.get(label as usize).copied().unwrap_or(label));
        left.as_loop().map_or(left, image)
    }

    /// The mesh on the other side of the symmetry. Labels and corners the lists do not name stay.
    pub fn apply(&self, mesh: &QuadMesh) -> QuadMesh {
        let mut image = if self.reversed { mirrored(mesh) } else { mesh.clone() };
        for dart in &mut image.darts {
            dart.left = self.left(dart.left);
        }
        for mark in &mut image.marks {
            *mark = Mark { corner: self.corner(mark.corner), ..*mark };
        }
        image.marks.sort_unstable();
        image
    }
}

/// The canonical mesh of a design (docs/reference/geometry.md §0.1): placed and reduced, numbered in the order in which the smallest
/// code discovers it. A function of the placed + reduced code alone: roots that tie are automorphisms.
pub fn canonical_mesh(mesh: &QuadMesh) -> CanonicalMesh {
    numbered(&Equivalence::default().representative(mesh))
}

/// The canonical mesh with the smallest code over a group of symmetries of the domain (docs/reference/geometry.md §0.5); the
/// identity always belongs to it.
pub fn canonical_mesh_under(mesh: &QuadMesh, symmetries: &[Symmetry]) -> CanonicalMesh {
    let placed = Equivalence::default();
    let images = symmetries.iter().map(|symmetry| placed.representative(&symmetry.apply(mesh)));
    numbered(&images.fold(placed.representative(mesh), Representative::smaller))
}

/// Writes a mesh down in the order in which its smallest placed code finds it.
fn numbered(representative: &Representative) -> CanonicalMesh {
    let (mesh, order) = (&representative.mesh, &representative.numbering.order);
    let vertex = discovery(mesh.vertex_count(), order.iter().map(|&d| mesh.origin(d).index()));
    let number = |d: DartId| vertex[mesh.origin(d).index()];
    let mut faces = Vec::with_capacity(mesh.face_count());
    let mut face_first: Vec<Option<DartId>> = vec![None; mesh.face_count()];
    let mut loops: Vec<Vec<u32>> = vec![Vec::new(); mesh.loop_count()];
    let mut strip_number = vec![u32::MAX; mesh.next_strip as usize];
    let mut canonical_strips = Vec::new();
    let mut face_darts = Vec::with_capacity(mesh.face_count());
    for &d in order {
        let label = mesh.strip(d).index();
        if strip_number[label] == u32::MAX {
            strip_number[label] = canonical_strips.len() as u32;
            let chain = strips::chain(mesh, d);
            canonical_strips.push(Strip {
                edges: chain.darts.iter().map(|&e| [number(e), number(mesh.twin(e))]).collect(),
                closed: chain.closed,
                poles: chain.pole_count(),
            });
        }
        match mesh.left(d).as_face() {
            Some(face) if face_first[face.index()].is_none() => {
                face_first[face.index()] = Some(d);
                let first = mesh.along(d).find(|&e| mesh.dart(e).pole).unwrap_or(d);
                let corners: Vec<u32> = mesh.along(first).map(number).collect();
                faces.push(match corners[..] {
                    [p, a, b] => [p, p, a, b],
                    [a, b, c, d] => [a, b, c, d],
                    _ => [0; 4],
                });
                face_darts.push(first);
            }
            Some(_) => {}
            None => {
                let label = mesh.left(d).as_loop().unwrap_or(0) as usize;
                if loops[label].is_empty() {
                    loops[label] = mesh.along(d).map(number).collect();
                }
            }
        }
    }
    // A pseudo-quad [p, p, a, b] has its edge (p, p), in the strip of (a, b), first, then p–a in that of (b, p).
    let face_strips = face_darts
        .iter()
        .map(|&first| {
            let next = mesh.next(first);
            let pair = if mesh.dart(first).pole { [next, first] } else { [first, next] };
            pair.map(|d| strip_number[mesh.strip(d).index()])
        })
        .collect();
    let mut corners: Vec<Vec<u32>> = mesh
        .corners()
        .into_iter()
        .map(|carriers| carriers.into_iter().map(|v| vertex[v.index()]).collect())
        .collect();
    corners.iter_mut().for_each(|carriers| carriers.sort_unstable());
    CanonicalMesh {
        code: representative.code(),
        vertex_count: mesh.vertex_count(),
        faces,
        loops,
        corners,
        strips: canonical_strips,
        face_strips,
    }
}

/// Numbers in the order of first appearance.
fn discovery(count: usize, found: impl Iterator<Item = usize>) -> Vec<u32> {
    let mut number = vec![u32::MAX; count];
    let mut following = 0;
    for index in found {
        if number[index] == u32::MAX {
            number[index] = following;
            following += 1;
        }
    }
    number
}
