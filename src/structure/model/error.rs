//! What may be wrong with a model.

use super::parts::Direction;
use crate::structure::section::SectionError;

/// What is wrong with a model, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// No node.
    #[error("nodes: the model has none")]
    NoNodes,
    /// No member.
    #[error("members: the model has none")]
    NoMembers,
    /// More nodes or members than a `u32` counts.
    #[error("the model is too large: {0}")]
    TooLarge(&'static str),
    /// A number that is NaN or infinite.
    #[error("{place}: {value} is not a finite number")]
    NotFinite {
        /// Path of the value.
        place: String,
        /// The value.
        value: f64,
    },
    /// A reference past the end of a list.
    #[error("{place} = {index}, but there are only {len} {what} (counted from 0)")]
    OutOfRange {
        /// Path of the reference.
        place: String,
        /// What it says.
        index: u32,
        /// What it refers to.
        what: &'static str,
        /// How many there are.
        len: usize,
    },
    /// A member between a node and itself, or between nodes at one place.
    #[error("members[{member}]: its length is {length} m (nodes {start} and {end})")]
    ZeroLength {
        /// The member.
        member: usize,
        /// Its start node.
        start: u32,
        /// Its end node.
        end: u32,
        /// Its length, m.
        length: f64,
    },
    /// An `up` that is zero or along the member.
    #[error("members[{member}].up = {up:?} is zero or along the member, so it gives no height direction")]
    UpAlongMember {
        /// The member.
        member: usize,
        /// Its up vector.
        up: [f64; 3],
    },
    /// Two members between the same two nodes.
    #[error("members[{second}] joins the same nodes ({start} and {end}) as members[{first}]")]
    DuplicateMember {
        /// The earlier member.
        first: usize,
        /// The later member.
        second: usize,
        /// One node.
        start: u32,
        /// The other node.
        end: u32,
    },
    /// A node no member reaches.
    #[error("nodes[{node}] belongs to no member")]
    LooseNode {
        /// The node.
        node: usize,
    },
    /// A material property that is not positive.
    #[error("material.{name} = {value} must be {allowed}")]
    Material {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A section that cannot be.
    #[error("section {index}: {source}")]
    Section {
        /// Which section.
        index: usize,
        /// Why not.
        source: SectionError,
    },
    /// A stiffness that is negative or not a number.
    #[error("{place}: {value} must be 0 or more{}", if *.infinite { "; leave it out for a rigid one" } else { ": 0 is none, and what is not to move is fixed" })]
    Stiffness {
        /// Path of the value.
        place: String,
        /// The value.
        value: f64,
        /// Whether an infinite one would be allowed.
        infinite: bool,
    },
    /// A member that may turn about itself at both ends.
    #[error(
        "members[{member}]: torsion is released at both ends, so that it turns freely about itself: keep it, or a spring, at one \
         end"
    )]
    TurnsFreely {
        /// The member.
        member: usize,
    },
    /// A moment on a node that has no rotation.
    #[error(
        "{place}: node {node} joins nothing but trusses, which take no moment: leave the moment out, or let a beam end there"
    )]
    MomentOnTrusses {
        /// Path of the load.
        place: String,
        /// The node.
        node: u32,
    },
    /// A displacement prescribed where nothing is fixed.
    #[error(
        "node {node}: a displacement is prescribed in {direction:?}, where it is not fixed: fix it there too"
    )]
    NotFixed {
        /// The node.
        node: u32,
        /// The direction.
        direction: Direction,
    },
}
