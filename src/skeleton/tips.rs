//! Where exactly a branch ends on the boundary.

use super::graph::{End, Graph, along, plan, stretch};
use super::triangulation::{Site, circumcenter, distance};
use crate::domain::Domain;

/// A corner belongs to the tip of a branch if a chord of this share of the branch's width cuts both off.
const FILLET: f64 = 0.2;

impl Graph {
    /// Puts the tip of every smooth end on a corner near it (in a fillet), or else in the middle of the arc that the last disc
    /// touches: where on an arc the triangles end is chance.
    pub(super) fn center_tips(&mut self, domain: &Domain) {
        for branch in self.branches.iter_mut().flatten() {
            for end in 0..2 {
                let End::Leaf(tip) = branch.ends[end] else { continue };
                if tip.corner.is_none() {
                    let pairs = branch.directed(end);
                    let corner = corner_near(domain, tip, &pairs);
                    branch.ends[end] = End::Leaf(corner.unwrap_or_else(|| centered(domain, tip, &pairs)));
                }
            }
        }
    }
}

/// The corner of the domain that lies about a smooth tip, within a chord that is short against the widest of the branch.
fn corner_near(domain: &Domain, tip: Site, pairs: &[[Site; 2]]) -> Option<Site> {
    let chord = |[right, left]: &[Site; 2]| distance(plan(domain, *right), plan(domain, *left));
    let widest = pairs.iter().map(chord).fold(0.0, f64::max);
    // Going away from the tip, the boundary runs from the left over the tip to the right.
    let &[right, left] = pairs
        .iter()
        .take_while(|pair| {
            chord(pair) < FILLET * widest && pair.iter().all(|s| s.loop_number == tip.loop_number)
        })
        .last()?;
    let whole = stretch(domain, left, right);
    domain.loop_corners(tip.loop_number).find_map(|corner| {
        let (loop_number, s) = domain.corner(corner)?;
        let site = Site { loop_number, s, corner: Some(corner) };
        (stretch(domain, left, site) <= whole).then_some(site)
    })
}

/// The middle of the arc about a tip that lies on its disc; `pairs` go away from the tip.
fn centered(domain: &Domain, tip: Site, pairs: &[[Site; 2]]) -> Site {
    let Some(&[a, b]) = pairs.first() else { return tip };
    let center = circumcenter(plan(domain, a), plan(domain, tip), plan(domain, b));
    let radius = distance(center, plan(domain, tip));
    let touches = |site: Site| (distance(center, plan(domain, site)) - radius).abs() < 0.01 * radius;
    // Going away from the tip, the boundary runs from the left over the tip to the right.
    match pairs.iter().take_while(|[right, left]| touches(*right) && touches(*left)).last() {
        Some(&[right, left]) => along(domain, left, right, 0.5),
        None => tip,
    }
}
