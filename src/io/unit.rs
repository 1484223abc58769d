//! The unit of a file's coordinates: OBJ has no place for it, and CAD programs write millimetres as often as metres.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A unit of length. Coordinates are turned into metres when a file is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LengthUnit {
    /// Metres.
    #[default]
    M,
    /// Centimetres.
    Cm,
    /// Millimetres.
    Mm,
    /// International feet, 0.3048 m.
    Ft,
    /// Inches, 0.0254 m.
    In,
}

impl LengthUnit {
    /// A length in this unit, in metres: as near as a double comes to the decimal that a file in metres would say.
    pub fn metres(self, length: f64) -> f64 {
        match self {
            Self::M => length,
            Self::Cm => length / 100.0,
            Self::Mm => length / 1000.0,
            Self::Ft => length * 3048.0 / 10_000.0,
            Self::In => length * 254.0 / 10_000.0,
        }
    }

    /// Whether it is the metre, which configs need not name.
    pub fn is_metre(&self) -> bool {
        *self == Self::M
    }
}

#[cfg(test)]
mod tests {
    use super::LengthUnit;

    #[test]
    fn lengths_become_those_that_a_file_in_metres_would_say() {
        let units = [LengthUnit::M, LengthUnit::Cm, LengthUnit::Mm, LengthUnit::Ft, LengthUnit::In];
        assert_eq!(units.map(|unit| unit.metres(36_625.0)), [36_625.0, 366.25, 36.625, 11_163.3, 930.275]);
        assert_eq!(LengthUnit::Mm.metres(0.1), 1e-4);
    }
}
