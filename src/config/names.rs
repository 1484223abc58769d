//! Names that a config may use for what other stages offer.

/// The objectives of the paper.
pub const WITH_STRUCTURE: [&str; 6] =
    ["deflection", "utilisation", "buckling", "curvature", "skewness", "edge_spread"];
/// Those of them that need no frame analysis.
pub const WITHOUT_STRUCTURE: [&str; 3] = ["curvature", "skewness", "edge_spread"];

/// Objectives that need a frame analysis.
const STRUCTURAL: [&str; 4] = ["deflection", "utilisation", "buckling", "mass"];

/// All known objectives.
pub fn objectives() -> Vec<&'static str> {
    STRUCTURAL.iter().chain(&WITHOUT_STRUCTURE).copied().collect()
}

/// Whether an objective needs a frame analysis.
pub fn needs_structure(name: &str) -> bool {
    STRUCTURAL.contains(&name)
}
