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

/// The number of tokens of a string (GRAMMAR §2), or what is wrong with it and where.
pub fn count_tokens(text: &str) -> Result<usize, String> {
    let mut count = 0;
    let mut after_add = false;
    for (position, character) in text.chars().enumerate() {
        match character.to_ascii_uppercase() {
            ' ' => continue,
            '*' | '°' | 'O' if after_add => after_add = false,
            letter @ ('T' | 'P' | 'D' | 'A') => {
                count += 1;
                after_add = letter == 'A';
            }
            _ => {
                return Err(format!(
                    "found '{character}' at position {position}; allowed: T, P, D, A, A*, A°"
                ));
            }
        }
    }
    Ok(count)
}
