//! Members, supports and loads of a model file.

use super::FileError;
use crate::json::Object;
use crate::structure::model::{
    LoadCase, Member, MemberKind, NodalLoad, PressureLoad, Settlement, Support, TemperatureLoad, UniformLoad,
};
use crate::structure::params::EndJointParams;
use nalgebra::Vector3;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys start, end and up")]
pub struct FileMember {
    start: u32,
    end: u32,
    up: Option<[f64; 3]>,
    section: Option<u32>,
    #[serde(default)]
    kind: FileKind,
    start_release: Option<Object<EndJointParams>>,
    end_release: Option<Object<EndJointParams>>,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum FileKind {
    #[default]
    Beam,
    Truss,
}

impl FileMember {
    /// The member, number `m`, in a model with so many `sections`: a list, where it names one.
    pub fn member(&self, m: usize, sections: Option<usize>, nodes: &[[f64; 3]]) -> Result<Member, FileError> {
        let section = match (self.section, sections) {
            (Some(section), Some(_)) => section,
            (None, None | Some(1)) => 0,
            (Some(_), None) => return Err(FileError::SectionOfMember { member: m }),
            (None, Some(count)) => return Err(FileError::NoSection { member: m, count }),
        };
        let releases = [("start_release", &self.start_release), ("end_release", &self.end_release)];
        if self.kind == FileKind::Truss
            && let Some((key, _)) = releases.iter().find(|(_, r)| r.is_some())
        {
            return Err(FileError::ReleasedTruss { member: m, key });
        }
        for (key, release) in releases {
            if let Some((axis, message)) = release.as_ref().and_then(|Object(release)| release.problem()) {
                return Err(FileError::Release { place: format!("members[{m}].{key}.{axis}"), message });
            }
        }
        let up = match (self.up, self.kind) {
            (Some(up), _) => up,
            (None, FileKind::Truss) => self.any_up(nodes),
            (None, FileKind::Beam) => return Err(FileError::NoUp { member: m }),
        };
        let kind = match self.kind {
            FileKind::Truss => MemberKind::Truss,
            FileKind::Beam => MemberKind::Beam(
                releases
                    .map(|(_, release)| release.as_ref().map_or(EndJointParams::default(), |r| r.0).joint(1)),
            ),
        };
        Ok(Member { start: self.start, end: self.end, up, section, kind })
    }

    /// A height direction for what needs none: up, or along x for what stands upright.
    fn any_up(&self, nodes: &[[f64; 3]]) -> [f64; 3] {
        let at = |n: u32| nodes.get(n as usize).copied().map(Vector3::from).unwrap_or_default();
        let along = at(self.end) - at(self.start);
        if along.x.hypot(along.y) > 1e-6 * along.z.abs() { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys node and fixed")]
pub struct FileSupport {
    node: u32,
    fixed: Option<[bool; 6]>,
    stiffness: Option<[f64; 6]>,
    displacement: Option<[f64; 6]>,
}

impl FileSupport {
    /// The support, number `s`, and how it moves.
    pub fn support(&self, s: usize) -> Result<(Support, Option<Settlement>), FileError> {
        if self.fixed.is_none() && self.stiffness.is_none() {
            return Err(FileError::NoHold { support: s });
        }
        let fixed = self.fixed.unwrap_or_default();
        let moved = self.displacement.map(|displacement| Settlement { node: self.node, displacement });
        Ok((Support { node: self.node, fixed, stiffness: self.stiffness.unwrap_or_default() }, moved))
    }
}

#[derive(Deserialize, Default)]
#[serde(
    default,
    deny_unknown_fields,
    expecting = "an object with the keys nodal, member_uniform, pressure, temperature and gravity, or some of them"
)]
pub struct FileLoads {
    nodal: Vec<Object<FileNodal>>,
    member_uniform: Vec<Object<FileUniform>>,
    pressure: Vec<Object<FilePressure>>,
    temperature: Vec<Object<FileTemperature>>,
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
#[serde(deny_unknown_fields, expecting = "an object with the keys member and force_per_length")]
struct FilePressure {
    member: u32,
    force_per_length: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys member and kelvin")]
struct FileTemperature {
    member: Option<u32>,
    kelvin: f64,
}

impl FileLoads {
    /// The load case, for so many members.
    pub fn case(&self, members: u32, settlements: Vec<Settlement>) -> LoadCase {
        let nodal = |Object(l): &Object<FileNodal>| {
            let ([fx, fy, fz], [mx, my, mz]) = (l.force, l.moment);
            NodalLoad { node: l.node, load: [fx, fy, fz, mx, my, mz] }
        };
        let uniform = |Object(l): &Object<FileUniform>| UniformLoad {
            member: l.member,
            force_per_length: l.force_per_length,
        };
        let pressure = |Object(l): &Object<FilePressure>| PressureLoad {
            member: l.member,
            force_per_length: l.force_per_length,
        };
        let warmed = |Object(l): &Object<FileTemperature>| {
            let kelvin = l.kelvin;
            let which = l.member.map_or(0..members, |member| member..member.saturating_add(1));
            which.map(move |member| TemperatureLoad { member, kelvin })
        };
        LoadCase {
            nodal: self.nodal.iter().map(nodal).collect(),
            uniform: self.member_uniform.iter().map(uniform).collect(),
            pressure: self.pressure.iter().map(pressure).collect(),
            temperature: self.temperature.iter().flat_map(warmed).collect(),
            gravity: self.gravity,
            settlements,
        }
    }
}
