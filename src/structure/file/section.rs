//! Sections of a model file.

use super::FileError;
use crate::structure::section::Section;
use serde::Deserialize;

/// The keys of all kinds; which of them a kind has is for [`FileSection::section`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(non_snake_case, reason = "the names of the file format, which are the engineer's symbols")]
pub struct FileSection {
    kind: Kind,
    #[serde(default, deserialize_with = "given")]
    width: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    height: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    thickness: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    diameter: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    A: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    Iy: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    Iz: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    J: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    Wy: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    Wz: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    Asy: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    Asz: Option<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    Properties,
    Box,
    Round,
    Tube,
}

impl Kind {
    /// Its name, the keys it needs and those it may have.
    fn keys(self) -> (&'static str, &'static [&'static str], &'static [&'static str]) {
        match self {
            Self::Properties => ("properties", &["A", "Iy", "Iz", "J"], &["Wy", "Wz", "Asy", "Asz"]),
            Self::Box => ("box", &["width", "height", "thickness"], &[]),
            Self::Round => ("round", &["diameter"], &[]),
            Self::Tube => ("tube", &["diameter", "thickness"], &[]),
        }
    }
}

/// A number that is there; `null` is none.
fn given<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    f64::deserialize(deserializer).map(Some)
}

impl FileSection {
    /// The section, if its kind has the keys that are given and no others.
    pub fn section(&self, place: &str) -> Result<Section, FileError> {
        let (kind, needed, optional) = self.kind.keys();
        let all = [
            ("width", self.width),
            ("height", self.height),
            ("thickness", self.thickness),
            ("diameter", self.diameter),
            ("A", self.A),
            ("Iy", self.Iy),
            ("Iz", self.Iz),
            ("J", self.J),
            ("Wy", self.Wy),
            ("Wz", self.Wz),
            ("Asy", self.Asy),
            ("Asz", self.Asz),
        ];
        for (key, value) in all {
            if value.is_none() && needed.contains(&key) {
                return Err(FileError::NoKey { place: place.into(), kind, key, needed });
            }
            if value.is_some() && !needed.contains(&key) && !optional.contains(&key) {
                return Err(FileError::KeyOfOther { place: place.into(), kind, key, needed });
            }
        }
        let of = |value: Option<f64>| value.unwrap_or(0.0);
        let wrong = |source| FileError::Section { place: place.into(), source };
        let section = match self.kind {
            Kind::Box => Section::rectangular_hollow(of(self.width), of(self.height), of(self.thickness))
                .map_err(wrong)?,
            Kind::Round => Section::round(of(self.diameter)).map_err(wrong)?,
            Kind::Tube => Section::tube(of(self.diameter), of(self.thickness)).map_err(wrong)?,
            Kind::Properties => Section {
                area: of(self.A),
                iy: of(self.Iy),
                iz: of(self.Iz),
                j: of(self.J),
                wy: of(self.Wy),
                wz: of(self.Wz),
                asy: of(self.Asy),
                asz: of(self.Asz),
                shear: None,
                shape: None,
            },
        };
        section.check().map_err(wrong)?;
        Ok(section)
    }
}
