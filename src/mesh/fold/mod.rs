//! Symmetric meshes by a part of them: folded along mirrors, rewritten as a part, unfolded again.
//!
//! A mesh that a reflection maps onto itself is cut along the edges that the reflection keeps; where it flips edges their strips are
//! halved first. What is kept, the half, has *seams* on its boundary, along which it goes on in its image. The rules of the grammar run
//! on the half; unfolding reflects and glues it. A second mirror folds the half once more, and so on: folds are undone in reverse order.
//!
//! A fold needs the mesh alone, and of the domain where the reflection takes its loops and corners. Coordinates only tell which of the
//! two halves is kept, that of larger x (then y), and where reflected vertices are drawn.

mod cut;
mod unfold;

use super::ids::DartId;
use super::isomorphism::Symmetry;
use super::load::InitialMesh;
use super::quad_mesh::QuadMesh;

/// A reflection of the domain.
#[derive(Clone, PartialEq, Debug)]
pub struct Mirror {
    /// Its name in the config.
    pub name: &'static str,
    /// Where it takes loops and corners.
    pub symmetry: Symmetry,
    /// Where it takes a point (x, y), m: `[[a, b, c], [d, e, f]]` for (a x + b y + c, d x + e y + f).
    pub plan: [[f64; 3]; 2],
}

impl Mirror {
    /// The image of a point, m.
    pub fn image(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [u, v] = self.plan.map(|[a, b, c]| a * x + b * y + c);
        [u, v, z]
    }
}

/// Where and why an initial mesh cannot be folded.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum FoldError {
    /// A vertex lies where the reflection has none.
    #[error(
        "`{mirror}` does not map it to itself: vertex {vertex} at ({x:.3}, {y:.3}) has no image at ({u:.3}, {v:.3})"
    )]
    #[expect(missing_docs, reason = "the message says it")]
    Vertex { mirror: &'static str, vertex: usize, x: f64, y: f64, u: f64, v: f64 },
    /// An edge joins vertices whose images are not joined.
    #[error(
        "`{mirror}` does not map it to itself: the edge from vertex {} to {} has no image from {} to {}",
        edge[0], edge[1], image[0], image[1]
    )]
    #[expect(missing_docs, reason = "the message says it")]
    Edge { mirror: &'static str, edge: [usize; 2], image: [usize; 2] },
    /// Vertices and edges fit, faces, poles, loops or corners do not.
    #[error(
        "`{mirror}` does not map it to itself: the images of its faces have other poles, or other corners of the domain"
    )]
    #[expect(missing_docs, reason = "the message says it")]
    Marks { mirror: &'static str },
    /// The axis runs through a face from corner to corner.
    #[error(
        "`{mirror}` has its axis along the diagonal of the face with vertices {vertices:?}: it has to run along edges or across them"
    )]
    #[expect(missing_docs, reason = "the message says it")]
    Diagonal { mirror: &'static str, vertices: Vec<usize> },
    /// No edge is kept: there is nothing to cut along.
    #[error("`{mirror}` keeps no edge of it: the axis does not meet the mesh")]
    #[expect(missing_docs, reason = "the message says it")]
    NoAxis { mirror: &'static str },
    /// The seams' ends need corner numbers of their own.
    #[error("{count} corners and ends of seams, but at most {} are supported", super::load::MAX_CORNERS)]
    #[expect(missing_docs, reason = "the message says it")]
    TooManyCorners { count: usize },
}

/// How a mesh was folded once.
#[derive(Clone, Debug)]
struct Fold {
    mirror: Mirror,
    /// Corners of the mesh before: those from here on are the ends of this fold's seams.
    corner_count: u32,
    /// [`QuadMesh::images_in_loop`] of the mesh before.
    images: Vec<u32>,
}

/// An initial mesh folded along mirrors, one after another; along none it is the mesh itself.
#[derive(Clone, Debug)]
pub struct Folded {
    /// The part that strings are decoded on, and the marker's start on it.
    pub part: InitialMesh,
    folds: Vec<Fold>,
}

impl Folded {
    /// A mesh that is not folded.
    pub fn whole(initial: InitialMesh) -> Self {
        Self { part: initial, folds: Vec::new() }
    }

    /// Folds a mesh along each of the mirrors.
    ///
    /// # Errors
    /// Where the mesh is not symmetric, or what the axis crosses.
    pub fn new(initial: &InitialMesh, mirrors: &[Mirror]) -> Result<Self, FoldError> {
        let mut folded = Self::whole(initial.clone());
        let domain_corners = initial.mesh.corner_count();
        for (mirror, number) in mirrors.iter().zip(0..) {
            let (part, fold) = cut::cut(&folded.part, number, mirror, domain_corners)?;
            folded.part = part;
            folded.folds.push(fold);
        }
        Ok(folded)
    }

    /// Whether there is any fold.
    pub fn is_folded(&self) -> bool {
        !self.folds.is_empty()
    }

    /// The edges of the seams of [`Self::part`], each as the places of its ends, m.
    pub fn seams(&self) -> Vec<[[f64; 3]; 2]> {
        let mesh = &self.part.mesh;
        let on_seam = mesh.darts().filter(|&d| mesh.left(d).as_seam().is_some());
        on_seam.map(|d| [mesh.origin(d), mesh.end(d)].map(|v| mesh.position(v))).collect()
    }

    /// The whole mesh of a part that the grammar made of [`Self::part`], and the marker on it.
    pub fn unfold(&self, part: &QuadMesh, marker: DartId) -> (QuadMesh, DartId) {
        let mut whole = (part.clone(), marker);
        for (number, fold) in self.folds.iter().enumerate().rev() {
            whole = unfold::unfold(whole, number as u32, fold);
        }
        whole
    }
}
