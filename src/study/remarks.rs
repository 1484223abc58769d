//! What is allowed, but shows its fault only beside the real sizes of domain and surface.

use super::Study;
use crate::geometry::params::Density;

/// A surface this much larger than the domain is more likely in another unit.
const VAST: f64 = 20.0;
/// A shortest member over this share of the panels' mean side is kept by hardly any pattern: singularities draw members together.
const LONG: f64 = 0.6;

impl Study {
    /// Things that are allowed but seldom meant, in words.
    pub fn warnings(&self) -> Vec<String> {
        [self.vast_surface(), self.long_members()].into_iter().flatten().collect()
    }

    fn vast_surface(&self) -> Option<String> {
        let [low, high] = self.surface.bounds()?;
        let (surface, domain) = ((high[0] - low[0]).hypot(high[1] - low[1]), self.domain.size());
        (surface > VAST * domain).then(|| {
            format!(
                "surface.file: the mesh is {surface:.0} m across, the domain {domain:.6} m: files are read in metres; is this \
                 one in another unit?"
            )
        })
    }

    fn long_members(&self) -> Option<String> {
        let least = self.pattern.limits.min_edge_m?;
        let side = match (self.pattern.density, self.pattern.target_length_m) {
            (Density::TargetLength, Some(length)) => length,
            _ => (self.domain.area() / self.pattern.panels as f64).sqrt(),
        };
        (least > LONG * side).then(|| {
            format!(
                "pattern.limits.min_edge_m = {least} is {:.2} of the panels' mean side, about {side:.3} m in plan: hardly any \
                 pattern keeps that; set it lower, or ask for fewer panels (its default is 2 × the width of the section; of a round \
                 one 2 × its largest height)",
                least / side
            )
        })
    }
}
