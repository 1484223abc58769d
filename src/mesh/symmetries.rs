//! Which symmetries a design has, as the tables write it.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// Reflections and rotations of the domain that map a design onto itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Symmetries {
    /// x → −x about the middle.
    pub mirror_x: bool,
    /// y → −y about the middle.
    pub mirror_y: bool,
    /// Turning by one n-th of a full turn about the middle: n, 1 for none.
    pub turns: u8,
}

impl Serialize for Symmetries {
    /// As it is printed.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Symmetries {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl Default for Symmetries {
    fn default() -> Self {
        Self { mirror_x: false, mirror_y: false, turns: 1 }
    }
}

impl fmt::Display for Symmetries {
    /// The names of the config, separated by spaces; nothing for a design without symmetry.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let turned = (self.turns > 1).then(|| format!("rotate-{}", self.turns));
        let mirror = |has: bool, name: &str| has.then(|| name.to_owned());
        let names = [mirror(self.mirror_x, "mirror-x"), mirror(self.mirror_y, "mirror-y"), turned];
        f.write_str(&names.into_iter().flatten().collect::<Vec<_>>().join(" "))
    }
}

/// A word that names no symmetry.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0:?} is no symmetry: mirror-x, mirror-y, rotate-n")]
pub struct UnknownSymmetry(String);

impl FromStr for Symmetries {
    type Err = UnknownSymmetry;

    fn from_str(text: &str) -> Result<Self, UnknownSymmetry> {
        let mut symmetries = Self::default();
        for word in text.split_whitespace() {
            let turns = word.strip_prefix("rotate-").and_then(|n| n.parse().ok()).filter(|&n| n > 1);
            match (word, turns) {
                ("mirror-x", _) => symmetries.mirror_x = true,
                ("mirror-y", _) => symmetries.mirror_y = true,
                (_, Some(turns)) => symmetries.turns = turns,
                _ => return Err(UnknownSymmetry(word.to_owned())),
            }
        }
        Ok(symmetries)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_and_read_back() {
        for text in ["", "mirror-x", "mirror-y", "mirror-x mirror-y rotate-2", "rotate-6"] {
            assert_eq!(text.parse::<Symmetries>().unwrap().to_string(), text);
        }
        assert!("rotate-x".parse::<Symmetries>().is_err() && "rotate-1".parse::<Symmetries>().is_err());
    }
}
