//! Why a design is refused: data, not an error of the run (docs/reference/search.md §1.2).

use std::fmt;

/// The reason for which geometry refuses a design, with what is needed to rank it among other refused ones.
#[derive(Clone, PartialEq, Debug)]
pub enum Rejection {
    /// Coarse faces that would have no area, and inner edges that would lie in a straight wall (docs/reference/geometry.md §1.4).
    Flat {
        /// Flat faces, ascending.
        faces: Vec<u32>,
        /// Inner edges with both ends on the same straight side.
        edges: Vec<[u32; 2]>,
    },
    /// Boundary vertices with one face that take no corner, ascending.
    Pinched {
        /// The coarse vertices.
        vertices: Vec<u32>,
    },
    /// It has not the symmetry that every pattern is to have.
    NotSymmetric {
        /// Its name.
        symmetry: &'static str,
    },
    /// Vertices with too many panels for the valence limit or for the angle there is, or too few at a corner
    /// (docs/reference/geometry.md §1.4).
    Crowded {
        /// The coarse vertices, ascending.
        vertices: Vec<u32>,
        /// Sum of the relative excesses.
        excess: f64,
    },
    /// A stretch of boundary has fewer vertices than the domain has corners there.
    CornerLost {
        /// The domain's corner.
        corner: usize,
    },
    /// The mesh does not have the boundary loops of the domain.
    OtherLoops {
        /// Loops of the mesh.
        mesh: usize,
        /// Loops of the domain.
        domain: usize,
    },
    /// More panels than `max_faces`.
    TooManyFaces {
        /// How many it would have.
        n: usize,
        /// The limit.
        max: usize,
    },
    /// Panels that are turned over.
    Folds {
        /// Number of folded panels.
        folded: usize,
        /// Number of all panels.
        panels: usize,
    },
    /// Vertices that lie outside the domain.
    OutsideDomain {
        /// Their number.
        vertices: usize,
        /// Number of all panels.
        panels: usize,
    },
    /// Edges without length, or different boundary vertices at one place.
    Coincident {
        /// The nearest two.
        vertices: [u32; 2],
        /// Whether an edge joins them.
        is_edge: bool,
        /// Middle between them, m.
        place: [f64; 3],
        /// Their distance, m.
        distance: f64,
        /// How many such pairs there are.
        pairs: usize,
        /// Number of all panels.
        panels: usize,
    },
    /// A position that is no number.
    NotFinite {
        /// The stage of geometry that made it.
        stage: &'static str,
    },
}

impl Rejection {
    /// The stage by which failures are ranked: 3 folds, 4 pinched or flat, 5 too many faces, 6 not finite.
    pub fn stage(&self) -> u8 {
        match self {
            Self::Folds { .. } | Self::OutsideDomain { .. } | Self::Coincident { .. } => 3,
            Self::Flat { .. }
            | Self::Pinched { .. }
            | Self::NotSymmetric { .. }
            | Self::Crowded { .. }
            | Self::CornerLost { .. } => 4,
            Self::TooManyFaces { .. } => 5,
            Self::NotFinite { .. } | Self::OtherLoops { .. } => 6,
        }
    }

    /// How bad it is within its stage; positive, larger is worse.
    pub fn measure(&self) -> f64 {
        match self {
            Self::Folds { folded, panels } => *folded as f64 / *panels as f64,
            Self::OutsideDomain { vertices, panels } => *vertices as f64 / *panels as f64,
            Self::Coincident { pairs, panels, .. } => *pairs as f64 / *panels as f64,
            Self::Flat { faces, edges } => (faces.len() + edges.len()) as f64,
            Self::Pinched { vertices } => vertices.len() as f64,
            Self::Crowded { excess, .. } => *excess,
            Self::CornerLost { .. }
            | Self::NotSymmetric { .. }
            | Self::NotFinite { .. }
            | Self::OtherLoops { .. } => 1.0,
            Self::TooManyFaces { n, max } => libm::log(*n as f64 / (*max).max(1) as f64),
        }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flat { faces, edges } => {
                write!(f, "flat: {} faces, {} edges in a straight wall", faces.len(), edges.len())
            }
            Self::Pinched { vertices } => {
                write!(
                    f,
                    "pinched: {} vertices with one panel on the boundary or beside an axis",
                    vertices.len()
                )
            }
            Self::NotSymmetric { symmetry } => {
                write!(f, "not symmetric: without parallel strips it does not have {symmetry}")
            }
            Self::Crowded { vertices, .. } => {
                write!(
                    f,
                    "crowded: {} vertices have too many or too few panels in every pattern",
                    vertices.len()
                )
            }
            Self::CornerLost { corner } => write!(f, "corner {corner} finds no boundary vertex"),
            Self::OtherLoops { mesh, domain } => {
                write!(f, "{mesh} boundary loops where the domain has {domain}")
            }
            Self::TooManyFaces { n, max } => write!(f, "{n} panels, at most {max} allowed"),
            Self::Folds { folded, panels } => write!(f, "{folded} of {panels} panels folded"),
            Self::OutsideDomain { vertices, .. } => write!(f, "{vertices} vertices outside the domain"),
            Self::Coincident { vertices: [u, v], is_edge, place: [x, y, z], distance, .. } => {
                let what = if *is_edge { "joined by a member" } else { "both on the boundary" };
                write!(
                    f,
                    "vertices {u} and {v}, {what}, stand on one place near ({x:.3}, {y:.3}, {z:.3}), {distance:.1e} m apart"
                )
            }
            Self::NotFinite { stage } => write!(f, "a position is not finite after {stage}"),
        }
    }
}
