//! The largest values of one combination, and where they are.

use super::Place;
use super::model::GridshellModel;
use crate::structure::forces::{BetweenAll, Utilisation};
use crate::structure::model::NodeId;
use crate::structure::params::Quantity;
use crate::structure::solver::Solver;
use nalgebra::Vector3;

/// The largest values of one combination, and where they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metrics {
    /// Resultant displacement, m.
    pub deflection: (f64, Place),
    /// Vertical displacement, m.
    pub deflection_vertical: (f64, Place),
    /// Elastic utilisation outside the excluded zones (member ends only in second order).
    pub utilisation: (f64, Place),
    /// The same of all members.
    pub utilisation_all: (f64, Place),
    /// Von Mises utilisation outside the excluded zones.
    pub von_mises: (f64, Place),
    /// Elastic utilisation outside the excluded zones, extremes between the ends included.
    pub inner: (f64, Place),
    /// The same of all members.
    pub inner_all: (f64, Place),
    /// Pull on a support, N.
    pub uplift: (f64, Place),
    /// Horizontal movement of a supported node, m.
    pub slide: (f64, Place),
}

/// The answer of one combination.
#[derive(Clone, Copy)]
pub struct Answer<'a> {
    /// Displacements, in elimination order.
    pub u: &'a [f64],
    /// Loads, in elimination order.
    pub f: &'a [f64],
    /// What else decides the forces of the members.
    pub between: BetweenAll<'a>,
}

/// What each member uses of the strength.
pub fn utilisations(
    model: &GridshellModel,
    solver: &Solver<'_>,
    answer: Answer<'_>,
) -> impl Iterator<Item = Utilisation> {
    let strength = model.frame.material().strength;
    let section = solver.sections()[0];
    (0..model.frame.members().len())
        .map(move |m| solver.forces_of(m, answer.u, answer.between.of(m)).utilisation(&section, strength))
}

/// The largest values; `reactions` is room.
pub fn measure(
    model: &GridshellModel,
    solver: &Solver<'_>,
    answer: Answer<'_>,
    reactions: &mut Vec<f64>,
) -> Metrics {
    let mut metrics = Metrics::NONE;
    for n in 0..model.frame.nodes().len() as u32 {
        let first = solver.system().first(n);
        let [x, y, z] = [answer.u[first], answer.u[first + 1], answer.u[first + 2]];
        raise(&mut metrics.deflection, Vector3::new(x, y, z).norm(), Place::Node(n));
        raise(&mut metrics.deflection_vertical, z.abs(), Place::Node(n));
    }
    solver.reactions_into(answer.u, answer.between.axial, answer.f, reactions);
    for node in model.frame.supported() {
        let NodeId(n) = node;
        let first = solver.system().first(n);
        if let Some(push) = solver.support_reaction(node, answer.u, reactions)[2] {
            raise(&mut metrics.uplift, -push, Place::Node(n));
        }
        let slide = Vector3::new(answer.u[first], answer.u[first + 1], 0.0).norm();
        raise(&mut metrics.slide, slide, Place::Node(n));
    }
    for (m, used) in utilisations(model, solver, answer).enumerate() {
        let place = Place::Edge(model.edge[m]);
        let elastic = if answer.between.axial.is_some() { used.ends } else { used.inner };
        raise(&mut metrics.utilisation_all, elastic, place);
        raise(&mut metrics.inner_all, used.inner, place);
        if model.counts[m] {
            raise(&mut metrics.utilisation, elastic, place);
            raise(&mut metrics.inner, used.inner, place);
            raise(&mut metrics.von_mises, used.von_mises, place);
        }
    }
    metrics
}

impl Metrics {
    /// One quantity in the unit of its column, and where it is. Buckling factors are no matter of one state: none is told.
    pub fn of(&self, quantity: Quantity) -> (f64, Place) {
        match quantity {
            Quantity::Deflection => self.deflection,
            Quantity::DeflectionVertical => self.deflection_vertical,
            Quantity::Utilisation => self.utilisation,
            Quantity::UtilisationAll => self.utilisation_all,
            Quantity::UtilisationVonMises => self.von_mises,
            Quantity::Uplift => (self.uplift.0 / 1e3, self.uplift.1),
            Quantity::SupportSlide => self.slide,
            Quantity::BucklingFactor | Quantity::Buckling => (0.0, Place::Whole),
        }
    }

    const NONE: Self = {
        let none = (0.0, Place::Whole);
        Self {
            deflection: none,
            deflection_vertical: none,
            utilisation: none,
            utilisation_all: none,
            von_mises: none,
            inner: none,
            inner_all: none,
            uplift: none,
            slide: none,
        }
    };
}

/// Keeps the larger; a NaN stays, to be found by the check of the whole response.
fn raise(worst: &mut (f64, Place), value: f64, place: Place) {
    if value > worst.0 || value.is_nan() {
        *worst = (value, place);
    }
}
