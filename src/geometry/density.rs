//! Into how many parts each strip is divided (GEOMETRY §2.2).

use super::coarse::Coarse;
use super::dense::{Dense, panel_count};
use super::params::{Density, PatternParams};
use super::rejection::Rejection;
use super::vector::{Vec3, distance};

/// Parts of every strip of the mesh on which lengths are measured.
pub const PROBE_PARTS: u32 = 4;
/// Steps of the bisection for t: enough for the last bit.
const STEPS: usize = 64;

/// Densities by strip and the target length they come from.
#[derive(Clone, PartialEq, Debug)]
pub struct Densities {
    /// n(s) of each strip.
    pub parts: Vec<u32>,
    /// Target length t, m.
    pub target_length: f64,
}

/// Length of each strip: the mean over its transverse edges of their length on the placed probe mesh, m.
pub fn strip_lengths(coarse: &Coarse<'_>, probe: &Dense, positions: &[Vec3]) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); coarse.mesh.strips.len()];
    for (path, &s) in probe.edge_paths.iter().zip(&coarse.edge_strip) {
        let length: f64 =
            path.windows(2).map(|w| distance(positions[w[0] as usize], positions[w[1] as usize])).sum();
        let (sum, count) = &mut sums[s as usize];
        *sum += length;
        *count += 1.0;
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

/// n(s) = max(1, ⌈length / t − 10⁻⁶⌉).
pub fn parts(lengths: &[f64], target_length: f64) -> Vec<u32> {
    lengths.iter().map(|l| ((l / target_length - 1e-6).ceil() as u32).max(1)).collect()
}

/// Densities of all strips by the rule of the config.
///
/// # Errors
/// [`Rejection::TooManyFaces`] over `max_faces`; [`Rejection::NotFinite`] if a length is no number.
pub fn choose(coarse: &Coarse<'_>, lengths: &[f64], params: &PatternParams) -> Result<Densities, Rejection> {
    if !lengths.iter().all(|l| l.is_finite() && *l > 0.0) {
        return Err(Rejection::NotFinite { stage: "measuring strips" });
    }
    let densities = match (params.density, params.target_length_m) {
        (Density::TargetLength, Some(t)) => Densities { parts: parts(lengths, t), target_length: t },
        _ => nearest_to(coarse, lengths, params.panels),
    };
    let n = panel_count(coarse, &densities.parts);
    if n > params.max_faces {
        return Err(Rejection::TooManyFaces { n, max: params.max_faces });
    }
    Ok(densities)
}

/// The t whose number of panels comes nearest to `panels`, by bisection of its logarithm; of two as near the denser one.
fn nearest_to(coarse: &Coarse<'_>, lengths: &[f64], panels: usize) -> Densities {
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    // At the longest strip's length every strip has one part; at 1/panels of the shortest there are more than enough.
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let (mut fine, mut rough) = (shortest / (panels.max(1) as f64 + 1.0), longest);
    for _ in 0..STEPS {
        let middle = (fine * rough).sqrt();
        if panel_count(coarse, &parts(lengths, middle)) >= panels {
            fine = middle;
        } else {
            rough = middle;
        }
    }
    let off = |t: f64| panel_count(coarse, &parts(lengths, t)).abs_diff(panels);
    let target_length = if off(rough) < off(fine) { rough } else { fine };
    Densities { parts: parts(lengths, target_length), target_length }
}
