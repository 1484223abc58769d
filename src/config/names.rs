//! Which objectives are meant when a config names none.

/// The objectives of the paper.
pub const WITH_STRUCTURE: [&str; 6] =
    ["deflection", "utilisation", "buckling", "curvature", "skewness", "edge_spread"];
/// Those of them that need no frame analysis.
pub const WITHOUT_STRUCTURE: [&str; 3] = ["curvature", "skewness", "edge_spread"];
