//! The initial coarse quad mesh (docs/reference/geometry.md §1.3): from the medial axis of the domain, or as the config gives it.
//!
//! The skeleton decomposition follows Oval, Rippmann, Mesnil, Van Mele, Baverel, Block (2019), *Feature-based topology finding of
//! patterns for shell structures*: points along the boundary are triangulated (Delaunay); triangles with three neighbours are the
//! forks of the medial axis; the domain is cut along the branches between forks and from each fork to the boundary points that
//! its disc touches. Here forks are then moved to where they are exactly equally far from their boundaries, roughness of a
//! boundary is pruned, forks that coincide are joined or, where that makes a vertex of more than six edges, opened, corners that the
//! axis misses get a strip, long smooth ends are corridors, and smooth ends get a layer of quads along the boundary, so that no
//! vertex of it has a single face.

mod forked;
mod forkless;
mod graph;
mod initial;
mod join;
mod layout;
mod number;
mod open;
pub mod params;
pub mod picture;
mod refine;
mod tidy;
mod tips;
mod triangulation;

pub use initial::{InitialError, initial};

use crate::domain::Domain;
use crate::mesh::{BaseMesh, BaseMeshError, InitialMesh};
use graph::Graph;
use layout::Layout;
use triangulation::Triangulation;

/// Why a domain has no skeleton mesh.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SkeletonError {
    /// The triangulation fails.
    #[error(
        "the medial axis cannot be found: {reason}; give an initial mesh instead (topology.initial = {{ file = \"…\" }})"
    )]
    Triangulation {
        /// Why.
        reason: String,
    },
    /// The decomposition is no valid quad mesh.
    #[error(
        "the medial axis gives no quad mesh here: {reason}; give an initial mesh instead (topology.initial = {{ file = \"…\" }})"
    )]
    NoMesh {
        /// Why.
        reason: String,
    },
}

impl From<BaseMeshError> for SkeletonError {
    fn from(error: BaseMeshError) -> Self {
        Self::NoMesh { reason: error.to_string() }
    }
}

/// The initial mesh of a domain from its medial axis: quads only, vertices numbered loop by loop along the boundary and then
/// inside, face 0 at the first vertex. Its corners carry the corners of the domain, or its mark where it has none.
///
/// # Errors
/// A domain that cannot be decomposed, with the reason.
pub fn initial_mesh(domain: &Domain) -> Result<BaseMesh, SkeletonError> {
    let mut layout = decompose(domain)?;
    tidy::boundary(&mut layout, domain);
    layout.place_corners(domain);
    layout.fill_loops(domain);
    layout.pad_pinched(domain);
    let base = number::base_mesh(&layout, domain)?;
    InitialMesh::from_base(&base)?;
    Ok(base)
}

/// The quads of the medial axis.
fn decompose(domain: &Domain) -> Result<Layout, SkeletonError> {
    if forkless::is_disc(domain) {
        return Ok(forkless::disc(domain));
    }
    let mut graph = Graph::of(&Triangulation::of(domain)?);
    graph.simplify(domain);
    graph.center_tips(domain);
    if !graph.fork_numbers().is_empty() {
        refine::forks(&mut graph, domain);
        open::forks(&mut graph, domain);
        open::apart(&mut graph, domain);
        open::shared_points(&mut graph, domain);
        return Ok(forked::layout(&graph, domain));
    }
    let none = || SkeletonError::NoMesh { reason: "it has neither forks nor ends".to_owned() };
    let branch = graph.branches.iter().flatten().next().ok_or_else(none)?;
    match forkless::path_ends(branch) {
        Some(ends) => Ok(forkless::path(domain, branch, ends)),
        None => forkless::ring(domain, branch).ok_or_else(none),
    }
}
