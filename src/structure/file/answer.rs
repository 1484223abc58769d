//! The JSON that is printed.

use crate::structure::forces::{Resultants, Utilisation};
use crate::structure::frame::{FrameError, FrameResult};
use serde::Serialize;

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
    #[serde(skip_serializing_if = "Vec::is_empty")]
    joint_rotations: Vec<JointRotations<'a>>,
}

#[derive(Serialize)]
struct JointRotations<'a> {
    member: u32,
    start: &'a [f64; 3],
    end: &'a [f64; 3],
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
        joint_rotations: result
            .joint_rotations
            .iter()
            .map(|(member, [start, end])| JointRotations { member: member.0, start, end })
            .collect(),
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
