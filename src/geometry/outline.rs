//! How a pattern keeps the boundary of its domain: its own boundary is a chain of chords (docs/reference/geometry.md §2.6).

use super::pattern::Pattern;
use crate::domain::Domain;

/// Farthest that the boundary curve of the domain lies in plan from the chord of the pattern that spans it, m.
pub fn gap(pattern: &Pattern, domain: &Domain) -> f64 {
    let mut farthest = 0.0f64;
    for (along, curve) in pattern.along.iter().zip(&domain.loops) {
        for (i, &from) in along.iter().enumerate() {
            let to = along.get(i + 1).copied().unwrap_or(along[0] + curve.length());
            farthest = farthest.max(curve.gap(from, to));
        }
    }
    farthest
}

/// Area in plan within the pattern's outer boundary, without its holes, m².
pub fn area(pattern: &Pattern) -> f64 {
    let enclosed = |vertices: &Vec<u32>| -> f64 {
        let place = |i: usize| pattern.positions[vertices[i % vertices.len()] as usize];
        // Relative to the first vertex, so that a domain far from the origin loses no digits.
        let [ox, oy, _] = place(0);
        let twice = |i: usize| {
            let ([ax, ay, _], [bx, by, _]) = (place(i), place(i + 1));
            (ax - ox) * (by - oy) - (bx - ox) * (ay - oy)
        };
        0.5 * (0..vertices.len()).map(twice).sum::<f64>()
    };
    let mut areas = pattern.loops.iter().map(enclosed);
    areas.next().unwrap_or(0.0) - areas.sum::<f64>()
}
