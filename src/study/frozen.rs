//! What of the initial mesh no rule may touch (docs/reference/grammar.md §2.6).

use super::StudyError;
use crate::mesh::fold::{Folded, Mirror};
use crate::mesh::{InitialMesh, strips};
use crate::search::SearchParams;
use std::collections::BTreeSet;

type Polygon = Vec<[f64; 2]>;

/// Freezes what the config says, on the part that strings are decoded on: a face of it whose middle, or an image of it, lies in a frozen
/// face or region of the whole mesh.
///
/// # Errors
/// A strip that is not there, a region without a face.
pub fn freeze(
    start: &mut Folded,
    initial: &InitialMesh,
    mirrors: &[Mirror],
    search: &SearchParams,
) -> Result<(), StudyError> {
    start.part.poles = search.poles;
    let mesh = &initial.mesh;
    let labels = strips::labels(mesh);
    let mut chosen = BTreeSet::new();
    for (place, number) in search.frozen.strips.iter().enumerate() {
        let label = labels.iter().find(|label| label.0 == *number);
        let largest = labels.last().map_or(0, |label| label.0);
        chosen.insert(label.ok_or(StudyError::FrozenStrip { place, number: *number, largest })?);
    }
    let mut frozen: Vec<Polygon> = Vec::new();
    let mut middles: Vec<[f64; 2]> = Vec::new();
    for first in mesh.face_darts() {
        let corners = mesh.along(first).map(|d| mesh.position(mesh.origin(d)));
        let outline: Polygon = corners.map(|[x, y, _]| [x, y]).collect();
        middles.push(middle(&outline));
        if mesh.along(first).any(|d| chosen.contains(&mesh.strip(d))) {
            frozen.push(outline);
        }
    }
    for (place, region) in search.frozen.regions_m.iter().enumerate() {
        if !middles.iter().any(|&p| holds(region, p)) {
            return Err(StudyError::FrozenRegion { place });
        }
    }
    frozen.extend(search.frozen.regions_m.iter().cloned());
    if !frozen.is_empty() {
        start.part.mesh.freeze(|p| {
            let images = mirrors.iter().fold(vec![p], |points, mirror| {
                let reflected: Vec<[f64; 3]> = points.iter().map(|&q| mirror.image(q)).collect();
                [points, reflected].concat()
            });
            images.iter().any(|&[x, y, _]| frozen.iter().any(|polygon| holds(polygon, [x, y])))
        });
    }
    Ok(())
}

fn middle(outline: &[[f64; 2]]) -> [f64; 2] {
    let sum = outline.iter().fold([0.0; 2], |[u, v], [x, y]| [u + x, v + y]);
    sum.map(|s| s / outline.len() as f64)
}

/// Whether a polygon holds a point, by the number of its sides that a ray crosses.
fn holds(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let following = polygon.iter().cycle().skip(1);
    let crossed = polygon
        .iter()
        .zip(following)
        .filter(|&(&[ax, ay], &[bx, by])| (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax));
    crossed.count() % 2 == 1
}
