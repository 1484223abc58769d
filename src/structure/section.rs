//! Cross sections: what a beam element and a stress check need to know of them.

use super::params::SectionParams;

/// A prismatic cross section in its local axes (y across, z up; SI: m², m³, m⁴).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Area A.
    pub area: f64,
    /// Second moment about local y: bending in the x–z plane.
    pub iy: f64,
    /// Second moment about local z: bending in the x–y plane.
    pub iz: f64,
    /// St. Venant torsion constant J.
    pub j: f64,
    /// Elastic modulus about y.
    pub wy: f64,
    /// Elastic modulus about z.
    pub wz: f64,
    /// Effective shear area along y (Timoshenko); 0 = rigid in shear.
    pub asy: f64,
    /// Effective shear area along z (Timoshenko); 0 = rigid in shear.
    pub asz: f64,
    /// What the stresses of torsion and shear need, where the section's shape is known.
    pub shear: Option<ShearStress>,
    /// The shape, where it is known: what other programs draw and check.
    pub shape: Option<Shape>,
}

/// The shape of a section, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A rectangular hollow section with sharp corners.
    Box {
        /// Along local y.
        width: f64,
        /// Along local z.
        height: f64,
        /// Of the walls.
        thickness: f64,
    },
    /// A solid round bar.
    Round {
        /// Its diameter.
        diameter: f64,
    },
    /// A round tube.
    Tube {
        /// Outer diameter.
        diameter: f64,
        /// Of the wall.
        thickness: f64,
    },
}

/// How torsion and shear forces turn into shear stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearStress {
    /// Torsion modulus Wt: τ = |Mt| / Wt.
    pub wt: f64,
    /// Shear area along y: τ = |Vy| / avy.
    pub avy: f64,
    /// Shear area along z: τ = |Vz| / avz.
    pub avz: f64,
}

/// Why a section cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SectionError {
    /// A dimension that is zero, negative or not a number.
    #[error("section {name} = {value} must be greater than 0")]
    NotPositive {
        /// Which dimension or property.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A property that is negative or not a number.
    #[error("section {name} = {value} must be 0 or more")]
    Negative {
        /// Which property.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Walls that meet in the middle.
    #[error("section {name} = {value} m must be greater than twice the wall thickness, {thickness} m")]
    WallsMeet {
        /// Which dimension.
        name: &'static str,
        /// Its value, m.
        value: f64,
        /// Wall thickness, m.
        thickness: f64,
    },
}

fn positive(name: &'static str, value: f64) -> Result<(), SectionError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(SectionError::NotPositive { name, value }) }
}

fn open(name: &'static str, value: f64, thickness: f64) -> Result<(), SectionError> {
    positive(name, value)?;
    if value > 2.0 * thickness { Ok(()) } else { Err(SectionError::WallsMeet { name, value, thickness }) }
}

impl Section {
    /// A rectangular hollow section: `height` along local z, `width` along local y, wall `thickness`, m.
    ///
    /// A, Iy, Iz and W are exact; J is Bredt's on the mid-line (a definition, not the exact thick-walled J);
    /// shear areas after EN 1993-1-1, 6.2.6(3) f): Av = A h / (b + h).
    ///
    /// # Errors
    /// A dimension ≤ 0, or one ≤ 2 `thickness`.
    pub fn rectangular_hollow(width: f64, height: f64, thickness: f64) -> Result<Self, SectionError> {
        positive("thickness", thickness)?;
        open("width", width, thickness)?;
        open("height", height, thickness)?;
        let (b, h, t) = (width, height, thickness);
        let (inner_b, inner_h) = (b - 2.0 * t, h - 2.0 * t);
        let (mid_b, mid_h) = (b - t, h - t);
        let area = b * h - inner_b * inner_h;
        let iy = (b * h.powi(3) - inner_b * inner_h.powi(3)) / 12.0;
        let iz = (h * b.powi(3) - inner_h * inner_b.powi(3)) / 12.0;
        let (avy, avz) = (area * b / (b + h), area * h / (b + h));
        Ok(Self {
            area,
            iy,
            iz,
            j: 2.0 * t * (mid_b * mid_h).powi(2) / (mid_b + mid_h),
            wy: iy / (0.5 * h),
            wz: iz / (0.5 * b),
            asy: avy,
            asz: avz,
            shear: Some(ShearStress { wt: 2.0 * mid_b * mid_h * t, avy, avz }),
            shape: Some(Shape::Box { width, height, thickness }),
        })
    }

    /// A solid round bar of the given `diameter`, m. Shear: κ = 0.9 for stiffness, τmax = 4/3 V/A for stress.
    ///
    /// # Errors
    /// A diameter ≤ 0.
    pub fn round(diameter: f64) -> Result<Self, SectionError> {
        positive("diameter", diameter)?;
        let area = std::f64::consts::FRAC_PI_4 * diameter.powi(2);
        let i = std::f64::consts::PI * diameter.powi(4) / 64.0;
        Ok(Self::circular(Shape::Round { diameter }, diameter, [area, i], [0.9 * area, 0.75 * area]))
    }

    /// A round tube of outer `diameter` and wall `thickness`, m. Shear: κ = 1/2 for stiffness (thin wall),
    /// Av = 2 A / π for stress (EN 1993-1-1, 6.2.6(3) g).
    ///
    /// # Errors
    /// A dimension ≤ 0, or a diameter ≤ 2 `thickness`.
    pub fn tube(diameter: f64, thickness: f64) -> Result<Self, SectionError> {
        positive("thickness", thickness)?;
        open("diameter", diameter, thickness)?;
        let inner = diameter - 2.0 * thickness;
        let area = std::f64::consts::FRAC_PI_4 * (diameter.powi(2) - inner.powi(2));
        let i = std::f64::consts::PI * (diameter.powi(4) - inner.powi(4)) / 64.0;
        let shear = [0.5 * area, 2.0 * area / std::f64::consts::PI];
        Ok(Self::circular(Shape::Tube { diameter, thickness }, diameter, [area, i], shear))
    }

    /// With A and I, and the shear areas for stiffness and stress.
    fn circular(shape: Shape, diameter: f64, [area, i]: [f64; 2], [stiff, stress]: [f64; 2]) -> Self {
        let radius = 0.5 * diameter;
        Self {
            area,
            iy: i,
            iz: i,
            j: 2.0 * i,
            wy: i / radius,
            wz: i / radius,
            asy: stiff,
            asz: stiff,
            shear: Some(ShearStress { wt: 2.0 * i / radius, avy: stress, avz: stress }),
            shape: Some(shape),
        }
    }

    /// The section of a config at the given height (diameter of round ones), m.
    ///
    /// # Errors
    /// See [`Section::rectangular_hollow`], [`Section::round`], [`Section::tube`].
    pub fn of_params(params: &SectionParams, height: f64) -> Result<Self, SectionError> {
        match *params {
            SectionParams::Box { width_m, thickness_m } => {
                Self::rectangular_hollow(width_m, height, thickness_m)
            }
            SectionParams::Round {} => Self::round(height),
            SectionParams::Tube { thickness_m } => Self::tube(height, thickness_m),
            SectionParams::Properties {
                width_m: _,
                area_m2: area,
                iy_m4: iy,
                iz_m4: iz,
                j_m4: j,
                wy_m3: wy,
                wz_m3: wz,
                asy_m2: asy,
                asz_m2: asz,
            } => Ok(Self { area, iy, iz, j, wy, wz, asy, asz, shear: None, shape: None }),
        }
    }

    /// Checks that every property is a number that stiffness and stress can be computed from. Zero means: not given
    /// (W), rigid (shear areas), or none (I, J: a motion that it alone would resist is then a mechanism).
    ///
    /// # Errors
    /// A not positive, or another property negative or not finite.
    pub fn check(&self) -> Result<(), SectionError> {
        positive("A", self.area)?;
        let others = [
            ("Iy", self.iy),
            ("Iz", self.iz),
            ("J", self.j),
            ("Wy", self.wy),
            ("Wz", self.wz),
            ("Asy", self.asy),
            ("Asz", self.asz),
        ];
        match others.into_iter().find(|(_, value)| !(*value >= 0.0 && value.is_finite())) {
            None => Ok(()),
            Some((name, value)) => Err(SectionError::Negative { name, value }),
        }
    }

    /// Whether it resists bending both ways and torsion (A it always has).
    pub fn resists_all(&self) -> bool {
        self.iy > 0.0 && self.iz > 0.0 && self.j > 0.0
    }

    /// Whether its elastic moduli are known, so that stresses can be given.
    pub fn has_moduli(&self) -> bool {
        self.wy > 0.0 && self.wz > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_of_the_reference_case() {
        // utilisation_box-like hand calculation: 150 × 300 × 10 mm.
        let s = Section::rectangular_hollow(0.15, 0.3, 0.01).unwrap();
        assert!((s.area - (0.15 * 0.3 - 0.13 * 0.28)).abs() < 1e-15);
        assert!((s.iy - (0.15 * 0.027 - 0.13 * 0.021952) / 12.0).abs() < 1e-15);
        assert!((s.j - 2.0 * 0.01 * (0.14f64 * 0.29).powi(2) / 0.43).abs() < 1e-15);
    }

    #[test]
    fn thin_tube_approaches_the_thin_wall_formula() {
        // A = π d t, I = π d³ t / 8 on the mid-line, error O((t/d)²).
        let (d, t) = (0.2, 0.0002);
        let s = Section::tube(d, t).unwrap();
        let mid = d - t;
        assert!((s.area / (std::f64::consts::PI * mid * t) - 1.0).abs() < 1e-12);
        assert!((s.iy / (std::f64::consts::PI * mid.powi(3) * t / 8.0) - 1.0).abs() < 2e-6);
    }

    #[test]
    fn walls_that_meet_are_refused() {
        assert!(matches!(
            Section::rectangular_hollow(0.25, 0.04, 0.02),
            Err(SectionError::WallsMeet { name: "height", .. })
        ));
        assert!(Section::tube(0.1, 0.05).is_err());
        assert!(Section::round(0.0).is_err());
        assert!(Section::round(f64::NAN).is_err());
    }
}
