//! What is allowed, but would make a run worthless, as the real sizes of domain and surface and all supports together show.

use super::Study;
use crate::structure::model::Direction;
use crate::structure::params::SupportParams;

/// A surface this much larger than the domain is more likely in another unit.
const VAST: f64 = 20.0;
/// Beyond this a domain is more likely given in millimetres.
const KILOMETRE: f64 = 1000.0;
/// A shortest member over this share of the panels' mean side is kept by hardly any pattern: singularities draw members together.
const LONG: f64 = 0.6;

impl Study {
    /// Things that are allowed but seldom meant, in words.
    pub fn warnings(&self) -> Vec<String> {
        let rest = [
            self.free_directions(),
            self.unchecked_combinations(),
            self.vast_domain(),
            self.vast_surface(),
            self.long_members(),
        ];
        self.closed_gaps().chain(rest.into_iter().flatten()).collect()
    }

    /// Boundaries that were not quite closed.
    fn closed_gaps(&self) -> impl Iterator<Item = String> {
        self.domain.closed_gaps.iter().map(|(number, gap)| {
            format!(
                "domain.loop[{number}]: the polyline of the file has a gap of {gap:.3e} m, which was closed"
            )
        })
    }

    /// Directions that no support holds.
    fn free_directions(&self) -> Option<String> {
        let supports = &self.structure.as_ref()?.supports;
        let is_free = |direction: &Direction| {
            let d = *direction as usize;
            supports.iter().map(SupportParams::holds).all(|(fixed, springs)| !fixed[d] && springs[d] == 0.0)
        };
        let free = [Direction::Ux, Direction::Uy, Direction::Uz].into_iter().filter(is_free);
        let names: Vec<String> = free.map(Direction::name).collect();
        (!names.is_empty()).then(|| {
            format!("structure.support: nothing fixes {}: every design is a mechanism", names.join(", "))
        })
    }

    /// Combinations that no requirement names: they have no say in what is feasible.
    fn unchecked_combinations(&self) -> Option<String> {
        let structure = self.structure.as_ref().filter(|structure| !structure.requirements.is_empty())?;
        let checked =
            |name: &String| structure.requirements.iter().any(|r| r.combination.as_ref() == Some(name));
        let names: Vec<&str> =
            structure.combinations.keys().filter(|name| !checked(name)).map(String::as_str).collect();
        (!names.is_empty()).then(|| {
            format!(
                "structure.combinations: no [[structure.requirement]] names {}: nothing is checked there, and a design that \
                 fails there counts as feasible",
                names.join(", ")
            )
        })
    }

    /// Millimetres taken for metres.
    fn vast_domain(&self) -> Option<String> {
        let [low, high] = self.domain.bounds();
        let [width, depth] = [0, 1].map(|axis| high[axis] - low[axis]);
        (width.max(depth) > KILOMETRE).then(|| {
            format!(
                "domain.loop: {width:.0} m × {depth:.0} m: are these millimetres? Lengths are in metres; say unit = \"mm\" beside \
                 the file of an OBJ loop (and of surface and initial mesh), divide numbers written in the config by 1000"
            )
        })
    }

    fn vast_surface(&self) -> Option<String> {
        let [low, high] = self.surface.bounds()?;
        let (surface, domain) = ((high[0] - low[0]).hypot(high[1] - low[1]), self.domain.size());
        (surface > VAST * domain).then(|| {
            format!(
                "surface.file: the mesh is {surface:.0} m across, the domain {domain:.6} m: is its file in \
                 another unit? (surface.unit = \"mm\", \"cm\", \"ft\" or \"in\" has it turned into metres)"
            )
        })
    }

    fn long_members(&self) -> Option<String> {
        let least = self.pattern.limits.min_edge_m?;
        let side = self.limits.target_length;
        (least > LONG * side).then(|| {
            format!(
                "pattern.limits.min_edge_m = {least} is {:.2} of the panels' mean side, about {side:.3} m: hardly any \
                 pattern keeps that; set it lower, or ask for fewer panels (its default is 2 × the width of the section; of a round \
                 one 2 × its largest height)",
                least / side
            )
        })
    }
}
