//! The model file that `quadrille frame` reads, and the JSON it prints; docs/frame.md describes both.

mod answer;
mod parts;
mod section;

pub use answer::{answer, failure, refusal};

use super::frame::{FrameAnalysis, Order};
use super::model::{FrameModel, FrameParts, Material, Member, ModelError};
use super::section::SectionError;
use crate::json::{self, JsonError, Object};
use parts::{FileLoads, FileMember, FileSupport};
use section::FileSection;
use serde::Deserialize;
use serde::de::IgnoredAny;

/// Why a model file is refused.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// Not JSON, a key missing, a wrong type.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// Readable, but not a model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A section that cannot be.
    #[error("{}{source}", if *.place == "section" { String::new() } else { format!("{place}: ") })]
    Section {
        /// Which one.
        place: String,
        /// Why not.
        source: SectionError,
    },
    /// A section without a key of its kind.
    #[error("{place}: kind {kind:?} needs the key `{key}`; its keys: {}", .needed.join(", "))]
    NoKey {
        /// Which one.
        place: String,
        /// The kind.
        kind: &'static str,
        /// The key.
        key: &'static str,
        /// What the kind needs.
        needed: &'static [&'static str],
    },
    /// A section with a key of another kind.
    #[error("{place}: kind {kind:?} has no key `{key}`; its keys: {}", .needed.join(", "))]
    KeyOfOther {
        /// Which one.
        place: String,
        /// The kind.
        kind: &'static str,
        /// The key.
        key: &'static str,
        /// What the kind needs.
        needed: &'static [&'static str],
    },
    /// Neither `section` nor `sections`, both, or an empty list.
    #[error(
        "give either `section`, of all members, or `sections`, a list of which `members[…].section` names one by its number"
    )]
    WhichSection,
    /// A member that names a section where there is no list.
    #[error(
        "members[{member}].section: there is one `section` for all; give a list, `sections`, to choose from"
    )]
    SectionOfMember {
        /// The member.
        member: usize,
    },
    /// A member that names none where there are several.
    #[error(
        "members[{member}]: missing key `section`: which of the {count} `sections` it has, counted from 0"
    )]
    NoSection {
        /// The member.
        member: usize,
        /// How many there are.
        count: usize,
    },
    /// A beam without a height direction.
    #[error(
        "members[{member}]: missing key `up`, the direction of the section's height; only a truss needs none"
    )]
    NoUp {
        /// The member.
        member: usize,
    },
    /// A release of what has no bending.
    #[error(
        "members[{member}].{key}: a truss is not joined against rotation at all; leave it out, or leave out `kind`"
    )]
    ReleasedTruss {
        /// The member.
        member: usize,
        /// Which release.
        key: &'static str,
    },
    /// A joint that cannot be.
    #[error("{place}: {message}")]
    Release {
        /// Path of the joint.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// A support that supports nothing.
    #[error("supports[{support}]: missing key `fixed` (six booleans) or `stiffness` (six numbers)")]
    NoHold {
        /// The support.
        support: usize,
    },
    /// An analysis that does not exist.
    #[error("analysis.order = {0}: must be 1 or 2")]
    Order(u64),
    /// More buckling modes than anybody looks at, and than memory may hold.
    #[error("analysis.buckling_modes = {0}: must be at most {MOST_MODES}")]
    Modes(u32),
}

/// The most buckling modes of a model file.
const MOST_MODES: u32 = 1000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys material, section, nodes and members")]
struct File {
    material: Object<FileMaterial>,
    section: Option<Object<FileSection>>,
    sections: Option<Vec<Object<FileSection>>>,
    #[serde(default)]
    shear_deformation: bool,
    nodes: Vec<[f64; 3]>,
    members: Vec<Object<FileMember>>,
    #[serde(default)]
    supports: Vec<Object<FileSupport>>,
    #[serde(default)]
    loads: Object<FileLoads>,
    #[serde(default)]
    analysis: Object<FileAnalysis>,
    // For people, and for tests: not read.
    #[serde(default, rename = "name")]
    _name: IgnoredAny,
    #[serde(default, rename = "description")]
    _description: IgnoredAny,
    #[serde(default, rename = "source")]
    _source: IgnoredAny,
    #[serde(default, rename = "expected")]
    _expected: IgnoredAny,
    #[serde(default, rename = "tolerance")]
    _tolerance: IgnoredAny,
    #[serde(default, rename = "verification")]
    _verification: IgnoredAny,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys E, G, density and fy")]
struct FileMaterial {
    #[serde(rename = "E")]
    e: f64,
    #[serde(rename = "G")]
    g: f64,
    density: f64,
    fy: f64,
    #[serde(default = "steel")]
    thermal_expansion: f64,
}

/// α of steel, 1/K (EN 1993-1-1, 3.2.6).
fn steel() -> f64 {
    1.2e-5
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "an object with the keys order and buckling_modes")]
struct FileAnalysis {
    order: u64,
    buckling_modes: u32,
}

impl Default for FileAnalysis {
    fn default() -> Self {
        Self { order: 1, buckling_modes: 0 }
    }
}

/// Reads a model and what to analyse from JSON text. A key it does not know is an error.
///
/// # Errors
/// See [`FileError`].
pub fn read(text: &str) -> Result<(FrameModel, FrameAnalysis), FileError> {
    let Object(file): Object<File> = json::read(text)?;
    let Object(asked) = &file.analysis;
    let order = match asked.order {
        1 => Order::First,
        2 => Order::Second,
        other => return Err(FileError::Order(other)),
    };
    if asked.buckling_modes > MOST_MODES {
        return Err(FileError::Modes(asked.buckling_modes));
    }
    let analysis = FrameAnalysis { order, buckling_modes: asked.buckling_modes as usize };
    Ok((model(file)?, analysis))
}

fn model(file: File) -> Result<FrameModel, FileError> {
    let sections = match (&file.section, &file.sections) {
        (Some(Object(section)), None) => vec![section.section("section")?],
        (None, Some(list)) if !list.is_empty() => {
            let numbered = list.iter().enumerate();
            numbered.map(|(i, Object(s))| s.section(&format!("sections[{i}]"))).collect::<Result<_, _>>()?
        }
        _ => return Err(FileError::WhichSection),
    };
    let count = file.sections.is_some().then_some(sections.len());
    let members: Vec<Member> = file
        .members
        .iter()
        .enumerate()
        .map(|(m, Object(member))| member.member(m, count, &file.nodes))
        .collect::<Result<_, _>>()?;
    let mut supports = Vec::new();
    let mut settlements = Vec::new();
    for (s, Object(support)) in file.supports.iter().enumerate() {
        let (support, moved) = support.support(s)?;
        supports.push(support);
        settlements.extend(moved);
    }
    let Object(m) = &file.material;
    Ok(FrameModel::new(FrameParts {
        nodes: file.nodes,
        load_cases: vec![file.loads.0.case(members.len() as u32, settlements)],
        members,
        sections,
        material: Material {
            youngs_modulus: m.e,
            shear_modulus: m.g,
            density: m.density,
            strength: m.fy,
            thermal_expansion: m.thermal_expansion,
        },
        shear_deformation: file.shear_deformation,
        supports,
    })?)
}
