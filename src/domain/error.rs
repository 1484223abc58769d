//! What can be wrong with a domain. Loops and points are numbered from 0, as in the config.

use super::params::{DomainParams, LoopParams};
use crate::io::ReadError;

/// Why a domain is refused.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum DomainError {
    /// No loop at all.
    #[error("domain: no loop; the first [[domain.loop]] is the outer boundary")]
    NoLoop,
    /// A point is not `[x, y]` or `[x, y, z]`.
    #[error("domain.loop[{loop_number}].{what} has {found} coordinates, allowed are [x, y] and [x, y, z]")]
    Coordinates {
        /// The loop.
        loop_number: usize,
        /// Which point: its key within the loop.
        what: String,
        /// How many numbers it has.
        found: usize,
    },
    /// A number that is not finite.
    #[error("domain.loop[{loop_number}].{what} is {value}, which is not finite")]
    NotFinite {
        /// The loop.
        loop_number: usize,
        /// Which number: its key within the loop.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A length that must be positive.
    #[error("domain.loop[{loop_number}].{key} must be positive, found {value}")]
    NotPositive {
        /// The loop.
        loop_number: usize,
        /// The key.
        key: &'static str,
        /// Its value.
        value: f64,
    },
    /// Fewer than three points.
    #[error("domain.loop[{loop_number}]: a polyline needs at least 3 points, found {found}")]
    TooFewPoints {
        /// The loop.
        loop_number: usize,
        /// How many there are.
        found: usize,
    },
    /// Two consecutive points coincide in plan.
    #[error(
        "domain.loop[{loop_number}]: points {first} and {second} coincide in plan at ({x}, {y}); \
             the last point is joined to the first by itself"
    )]
    ZeroEdge {
        /// The loop.
        loop_number: usize,
        /// The first point.
        first: usize,
        /// The second point.
        second: usize,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// Two edges of one polyline cross or touch.
    #[error("domain.loop[{loop_number}]: the boundary crosses or touches itself: edge {}–{} meets edge {}–{} near ({x:.6}, {y:.6})",
            first[0], first[1], second[0], second[1])]
    SelfCrossing {
        /// The loop.
        loop_number: usize,
        /// The points of one edge.
        first: [usize; 2],
        /// The points of the other.
        second: [usize; 2],
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// A corner index beyond the points.
    #[error("domain.loop[{loop_number}]: corner {corner} does not exist, the points are 0 to {last}")]
    NoSuchCorner {
        /// The loop.
        loop_number: usize,
        /// The index.
        corner: usize,
        /// The largest one allowed.
        last: usize,
    },
    /// The same corner twice.
    #[error("domain.loop[{loop_number}]: corner {corner} is listed twice")]
    CornerTwice {
        /// The loop.
        loop_number: usize,
        /// The index.
        corner: usize,
    },
    /// An angle limit outside 0..180.
    #[error("domain.loop[{loop_number}]: corner_angle_deg must lie between 0 and 180, found {value}")]
    CornerAngle {
        /// The loop.
        loop_number: usize,
        /// Its value.
        value: f64,
    },
    /// Two loops cross or touch.
    #[error("domain: loops {first} and {second} cross or touch near ({x:.6}, {y:.6})")]
    LoopsMeet {
        /// One loop.
        first: usize,
        /// The other.
        second: usize,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// A hole is not inside the outer loop.
    #[error("domain: loop {loop_number}, a hole, lies outside loop 0, the outer boundary")]
    HoleOutside {
        /// The hole.
        loop_number: usize,
    },
    /// A hole lies in another.
    #[error("domain: loop {inner}, a hole, lies inside loop {outer}, another hole")]
    HoleInHole {
        /// The one inside.
        inner: usize,
        /// The one around it.
        outer: usize,
    },
    /// The file cannot be read.
    #[error("domain.loop[{loop_number}]: {error}")]
    File {
        /// The loop.
        loop_number: usize,
        /// Why.
        error: ReadError,
    },
    /// The file does not have this polyline.
    #[error(
        "domain.loop[{loop_number}]: {file} has {found} polylines (`l`), number {polyline} (from 0) does not exist: export the boundary as a polyline{hint}"
    )]
    NoSuchPolyline {
        /// The loop.
        loop_number: usize,
        /// The file.
        file: String,
        /// The polyline asked for.
        polyline: usize,
        /// How many there are.
        found: usize,
        /// What the file has instead.
        hint: String,
    },
    /// Points of a file.
    #[error("{error}; in {file}:{}", numbers(lines))]
    InFile {
        /// The file.
        file: String,
        /// The lines of the points.
        lines: Vec<usize>,
        /// What is wrong with them.
        error: Box<DomainError>,
    },
    /// A polyline that makes sense only with y up.
    #[error(
        "domain.loop[{loop_number}]: {file}:{line}: the polyline has its area in x and z, as in files with y up: files are read with z \
         up, so export it with z up"
    )]
    YUp {
        /// The loop.
        loop_number: usize,
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
    },
    /// The polyline does not return to its first point.
    #[error(
        "domain.loop[{loop_number}]: {file}:{line}: the polyline is open, its ends are {gap:.6} m apart: it must end in its first vertex"
    )]
    OpenPolyline {
        /// The loop.
        loop_number: usize,
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// How far apart its ends are, m.
        gap: f64,
    },
    /// A loop that no structure has: its measures leave the range of numbers, or drown in rounding.
    #[error(
        "domain.loop[{loop_number}]: it extends over {} m, allowed are 1e-6 to 1e9 m; lengths are metres",
        extents.map(|extent| format!("{extent:e}")).join(" × ")
    )]
    Extents {
        /// The loop.
        loop_number: usize,
        /// In x and y, m.
        extents: [f64; 2],
    },
    /// The surface does not reach everywhere.
    #[error("surface: it does not cover the domain: no finite height at ({x:.6}, {y:.6}); {extent}")]
    NotCovered {
        /// Where.
        x: f64,
        /// Where.
        y: f64,
        /// Where the surface is.
        extent: String,
    },
    /// A mark where corners hold the pattern.
    #[error(
        "domain.mark_m: found beside corners, which hold the pattern; allowed where no loop has a corner"
    )]
    MarkBesideCorners,
    /// A symmetry of the config that boundary or surface do not have.
    #[error("domain.symmetries: the domain does not have `{symmetry}`: {reason}")]
    NotSymmetric {
        /// The symmetry.
        symmetry: &'static str,
        /// What has no image.
        reason: String,
    },
}

impl DomainError {
    /// The key of the config that says what is wrong. Points of a file are the file's.
    pub fn key(&self, params: &DomainParams) -> String {
        match self {
            Self::NoLoop => "domain.loop".to_owned(),
            Self::NotCovered { .. } => "surface".to_owned(),
            Self::MarkBesideCorners => "domain.mark_m".to_owned(),
            Self::NotSymmetric { .. } => "domain.symmetries".to_owned(),
            Self::Coordinates { loop_number, what, .. } | Self::NotFinite { loop_number, what, .. } => {
                format!("domain.loop[{loop_number}].{what}")
            }
            Self::NotPositive { loop_number, key, .. } => format!("domain.loop[{loop_number}].{key}"),
            Self::ZeroEdge { loop_number, second, .. } => point(params, *loop_number, *second),
            Self::SelfCrossing { loop_number, first, .. } => point(params, *loop_number, first[0]),
            Self::TooFewPoints { loop_number, .. } => points(params, *loop_number),
            Self::NoSuchCorner { loop_number, .. } | Self::CornerTwice { loop_number, .. } => {
                format!("domain.loop[{loop_number}].corners")
            }
            Self::CornerAngle { loop_number, .. } => format!("domain.loop[{loop_number}].corner_angle_deg"),
            Self::NoSuchPolyline { loop_number, polyline: 1.., .. } => {
                format!("domain.loop[{loop_number}].polyline")
            }
            Self::InFile { error, .. } => error.key(params),
            Self::NoSuchPolyline { loop_number, .. }
            | Self::YUp { loop_number, .. }
            | Self::File { loop_number, .. }
            | Self::OpenPolyline { loop_number, .. } => {
                format!("domain.loop[{loop_number}].file")
            }
            Self::Extents { loop_number, .. }
            | Self::LoopsMeet { second: loop_number, .. }
            | Self::HoleOutside { loop_number }
            | Self::HoleInHole { inner: loop_number, .. } => format!("domain.loop[{loop_number}]"),
        }
    }
}

/// Line numbers as a list.
fn numbers(lines: &[usize]) -> String {
    lines.iter().map(usize::to_string).collect::<Vec<_>>().join(" and ")
}

/// The key that gives the points of a loop.
fn points(params: &DomainParams, loop_number: usize) -> String {
    let is_file = matches!(params.loops.get(loop_number), Some(LoopParams::Obj { .. }));
    format!("domain.loop[{loop_number}].{}", if is_file { "file" } else { "points_m" })
}

/// The key of one point of a loop.
fn point(params: &DomainParams, loop_number: usize, point: usize) -> String {
    let key = points(params, loop_number);
    if key.ends_with("file") { key } else { format!("{key}[{point}]") }
}
