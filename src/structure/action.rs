//! What acts on a structure in one combination of load cases.

/// What acts on a structure: forces, and displacements of its supports. Vectors are in elimination order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Action {
    /// Loads, held unknowns included.
    pub f: Vec<f64>,
    /// N of each member if its ends were held: −EAα ΔT. Empty where nothing changes its temperature.
    pub initial: Vec<f64>,
    /// Prescribed displacements of held unknowns; empty where there are none.
    pub settled: Vec<f64>,
    /// Strain energy that the last digits of the prescribed displacements have.
    pub noise: f64,
    /// Force and moment that the prescribed displacements would take, were all other nodes held: with the loads the
    /// measure of balance.
    pub scale: [f64; 2],
}

impl Action {
    /// A share of it.
    pub fn scaled(&self, share: f64) -> Self {
        let scaled = |v: &[f64]| v.iter().map(|v| share * v).collect();
        Self {
            f: scaled(&self.f),
            initial: scaled(&self.initial),
            settled: scaled(&self.settled),
            noise: share * share * self.noise,
            scale: self.scale.map(|scale| share * scale),
        }
    }

    /// Puts the prescribed displacements into a vector that has none.
    pub fn add_settled(&self, u: &mut [f64]) {
        u.iter_mut().zip(&self.settled).for_each(|(u, settled)| *u += settled);
    }
}
