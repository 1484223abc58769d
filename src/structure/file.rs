//! The model file that `quadrille frame` reads, and the JSON it prints; docs/frame.md describes both.

use super::forces::{Resultants, Utilisation};
use super::frame::{FrameAnalysis, FrameError, FrameResult, Order};
use super::model::{
    FrameModel, FrameParts, LoadCase, Material, Member, ModelError, NodalLoad, Support, UniformLoad,
};
use super::section::{Section, SectionError};
use crate::json::{self, JsonError, Object};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

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
    #[error(transparent)]
    Section(#[from] SectionError),
    /// A section without a key of its kind.
    #[error("section: kind {kind:?} needs the key `{key}`; its keys: {}", .needed.join(", "))]
    NoKey {
        /// The kind.
        kind: &'static str,
        /// The key.
        key: &'static str,
        /// What the kind needs.
        needed: &'static [&'static str],
    },
    /// A section with a key of another kind.
    #[error("section: kind {kind:?} has no key `{key}`; its keys: {}", .needed.join(", "))]
    KeyOfOther {
        /// The kind.
        kind: &'static str,
        /// The key.
        key: &'static str,
        /// What the kind needs.
        needed: &'static [&'static str],
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
    section: Object<FileSection>,
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
}

/// The keys of all kinds; which of them a kind has is for [`FileSection::section`].
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(non_snake_case, reason = "the names of the file format, which are the engineer's symbols")]
struct FileSection {
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
    fn section(&self) -> Result<Section, FileError> {
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
                return Err(FileError::NoKey { kind, key, needed });
            }
            if value.is_some() && !needed.contains(&key) && !optional.contains(&key) {
                return Err(FileError::KeyOfOther { kind, key, needed });
            }
        }
        let of = |value: Option<f64>| value.unwrap_or(0.0);
        Ok(match self.kind {
            Kind::Box => Section::rectangular_hollow(of(self.width), of(self.height), of(self.thickness))?,
            Kind::Round => Section::round(of(self.diameter))?,
            Kind::Tube => Section::tube(of(self.diameter), of(self.thickness))?,
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
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys start, end and up")]
struct FileMember {
    start: u32,
    end: u32,
    up: [f64; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys node and fixed")]
struct FileSupport {
    node: u32,
    fixed: [bool; 6],
}

#[derive(Deserialize, Default)]
#[serde(
    default,
    deny_unknown_fields,
    expecting = "an object with the keys nodal, member_uniform and gravity, or some of them"
)]
struct FileLoads {
    nodal: Vec<Object<FileNodal>>,
    member_uniform: Vec<Object<FileUniform>>,
    gravity: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys node, force and moment")]
struct FileNodal {
    node: u32,
    #[serde(default)]
    force: [f64; 3],
    #[serde(default)]
    moment: [f64; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys member and force_per_length")]
struct FileUniform {
    member: u32,
    force_per_length: [f64; 3],
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
    let section = file.section.0.section()?;
    section.check()?;
    let loads = file.loads.0;
    let nodal = |Object(l): &Object<FileNodal>| {
        let ([fx, fy, fz], [mx, my, mz]) = (l.force, l.moment);
        NodalLoad { node: l.node, load: [fx, fy, fz, mx, my, mz] }
    };
    let loads = LoadCase {
        nodal: loads.nodal.iter().map(nodal).collect(),
        uniform: loads
            .member_uniform
            .iter()
            .map(|Object(l)| UniformLoad { member: l.member, force_per_length: l.force_per_length })
            .collect(),
        gravity: loads.gravity,
    };
    let Object(m) = &file.material;
    Ok(FrameModel::new(FrameParts {
        nodes: file.nodes,
        members: file
            .members
            .iter()
            .map(|Object(m)| Member { start: m.start, end: m.end, up: m.up, section: 0 })
            .collect(),
        sections: vec![section],
        material: Material { youngs_modulus: m.e, shear_modulus: m.g, density: m.density, strength: m.fy },
        shear_deformation: file.shear_deformation,
        supports: file.supports.iter().map(|Object(s)| Support { node: s.node, fixed: s.fixed }).collect(),
        load_cases: vec![loads],
    })?)
}

#[derive(Serialize)]
struct Answer<'a> {
    displacements: Vec<NodeValues<'a>>,
    reactions: Vec<Reaction<'a>>,
    member_forces: Vec<EndForces>,
    max_displacement: f64,
    max_displacement_node: u32,
    total_reaction: [f64; 3],
    buckling_factors: &'a [f64],
    utilisation: Option<f64>,
    utilisation_member: Option<u32>,
    utilisation_at_member_ends: Option<f64>,
    utilisation_with_inner: Option<f64>,
    utilisation_von_mises: Option<f64>,
    remarks: Vec<&'static str>,
}

#[derive(Serialize)]
struct NodeValues<'a> {
    node: u32,
    u: &'a [f64; 6],
}

#[derive(Serialize)]
struct Reaction<'a> {
    node: u32,
    r: &'a [Option<f64>; 6],
}

#[derive(Serialize)]
#[expect(non_snake_case, reason = "the names of the file format, which are the engineer's symbols")]
struct EndForces {
    member: u32,
    end: &'static str,
    N: f64,
    Vy: f64,
    Vz: f64,
    Mt: f64,
    My: f64,
    Mz: f64,
}

impl EndForces {
    fn new(member: usize, end: &'static str, r: &Resultants) -> Self {
        Self { member: member as u32, end, N: r.n, Vy: r.vy, Vz: r.vz, Mt: r.mt, My: r.my, Mz: r.mz }
    }
}

/// The JSON of an answer, for all nodes and members; one line.
pub fn answer(result: &FrameResult) -> serde_json::Result<Vec<u8>> {
    let worst = |of: fn(&Utilisation) -> f64| result.worst(of).map(|w| w.0);
    let answer = Answer {
        displacements: result
            .displacements
            .iter()
            .enumerate()
            .map(|(n, u)| NodeValues { node: n as u32, u })
            .collect(),
        reactions: result.reactions.iter().map(|(n, r)| Reaction { node: n.0, r }).collect(),
        member_forces: result
            .member_forces
            .iter()
            .enumerate()
            .flat_map(|(m, f)| [EndForces::new(m, "start", &f.start), EndForces::new(m, "end", &f.end)])
            .collect(),
        max_displacement: result.max_displacement.0,
        max_displacement_node: result.max_displacement.1.0,
        total_reaction: result.total_reaction,
        buckling_factors: &result.buckling_factors,
        utilisation: result.utilisation().map(|w| w.0),
        utilisation_member: result.utilisation().map(|w| w.1.0),
        utilisation_at_member_ends: worst(|u| u.ends),
        utilisation_with_inner: worst(|u| u.inner),
        utilisation_von_mises: worst(|u| u.von_mises),
        remarks: result.remarks(),
    };
    let mut bytes = serde_json::to_vec(&answer)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// The JSON of a model, or a file, that is refused: `error` is `refused`.
pub fn refusal(error: &impl std::fmt::Display) -> serde_json::Value {
    serde_json::json!({ "error": "refused", "message": error.to_string() })
}

/// The JSON of a failed analysis: `error` is `singular`, `unstable`, `not converged`, `not finite`, `ill-conditioned`
/// or `failed`.
pub fn failure(error: &FrameError) -> serde_json::Value {
    let (kind, motion) = match error {
        FrameError::Singular(motion) => ("singular", Some(motion)),
        FrameError::Unstable(motion) => ("unstable", Some(motion)),
        FrameError::NotFinite => ("not finite", None),
        FrameError::IllConditioned(_)
        | FrameError::Inexact(_)
        | FrameError::InexactFactors(_)
        | FrameError::NoDigits => ("ill-conditioned", None),
        FrameError::NotSettled { .. } | FrameError::NoConvergence => ("not converged", None),
        FrameError::TooLarge(_) | FrameError::NoSuchCase { .. } => ("failed", None),
    };
    let mut value = serde_json::json!({ "error": kind, "message": error.to_string() });
    if let Some(motion) = motion {
        value["node"] = motion.node.0.into();
        value["direction"] = serde_json::json!(motion.direction);
        value["motion"] = motion.motion.to_vec().into();
    }
    value
}
