//! The canonical mesh: all that the stages after the grammar may know of a design (docs/reference/geometry.md §0).

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// A canonical code (docs/reference/grammar.md §7): equal exactly for isomorphic meshes.
///
/// The first 128 bits of the SHA-256 of the code's numbers joined by commas; printed as its first 16 hex digits,
/// as the reference cases do.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Code(pub u128);

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", (self.0 >> 64) as u64)
    }
}

impl Serialize for Code {
    /// All 128 bits in 32 hexadecimal digits: formats like JSON have no numbers of that size.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:032x}", self.0))
    }
}

impl<'de> Deserialize<'de> for Code {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        u128::from_str_radix(&text, 16).map(Code).map_err(D::Error::custom)
    }
}

/// One strip of a [`CanonicalMesh`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Strip {
    /// The transverse edges from end to end, each as its two vertices; a pole end `(p, p)` is not listed.
    pub edges: Vec<[u32; 2]>,
    /// True for a loop.
    pub closed: bool,
    /// How many of its ends are poles: 0, 1 or 2.
    pub poles: u8,
}

/// The placed + reduced mesh, its vertices, faces and strips numbered in the order in which the smallest code
/// discovers them (docs/reference/geometry.md §0.1). Equal codes give equal values of this type.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CanonicalMesh {
    /// The placed + reduced code.
    pub code: Code,
    /// Number of vertices, numbered `0..vertex_count`.
    pub vertex_count: usize,
    /// Counter-clockwise faces `[a, b, c, d]`; a pseudo-quad is `[p, p, a, b]` with its pole `p` first.
    pub faces: Vec<[u32; 4]>,
    /// Boundary loops in label order (0 is the outer one): the origins of the outside darts in their direction,
    /// so the outer loop runs clockwise and a hole counter-clockwise when seen from above.
    pub loops: Vec<Vec<u32>>,
    /// For each corner number, the vertices that carry its mark, ascending; may be empty.
    pub corners: Vec<Vec<u32>>,
    /// All strips, each real edge in exactly one.
    pub strips: Vec<Strip>,
    /// For each face, the strip that holds its edges 0–1 and 2–3, and the one that holds 1–2 and 3–0.
    pub face_strips: Vec<[u32; 2]>,
}
