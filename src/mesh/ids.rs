//! Handles: one `u32` each, so that a vertex is never taken for a face.

use std::fmt;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The number as an index into an array.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($letter, "{}"), self.0)
            }
        }
    };
}

id!(
    /// A vertex of a coarse mesh.
    VertexId, "v"
);
id!(
    /// A face of a coarse mesh.
    FaceId, "f"
);
id!(
    /// A strip label (docs/reference/grammar.md §5).
    StripId, "s"
);
id!(
    /// A dart: a directed edge `(u, v)` of a coarse mesh with what lies on its left.
    DartId, "d"
);
