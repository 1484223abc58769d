//! The domain: boundary loops and their corners, on the surface (docs/reference/geometry.md §1.1).

mod area;
mod boundary;
mod check;
mod curve;
mod error;
mod kinks;
pub mod params;
mod read;
mod side;
mod symmetry;

pub use boundary::{BoundaryLoop, Stretch};
pub use error::DomainError;
pub use params::{Corners, DomainParams, LoopParams, Symmetry};
pub use side::Side;

use crate::io::Inputs;
use crate::surface::Surface;
use curve::Curve;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// How fine the patterns on a domain are to be: what is short on its boundary is short against them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Grain {
    /// Edges of about this length, m.
    Length(f64),
    /// About this many panels.
    Panels(usize),
}

impl Grain {
    /// Length of an edge, m, where the surface has this area, m²: of N panels √(A/N).
    pub fn length(self, surface_area: f64) -> f64 {
        match self {
            Self::Length(length) => length,
            Self::Panels(panels) => (surface_area / panels.max(1) as f64).sqrt(),
        }
    }
}

/// Share of a target length within which the curve turns at a corner, however many kinks it takes (docs/reference/geometry.md §1.1).
const TURN: f64 = 0.1;

/// A region of the plan with its boundary on the surface.
#[derive(Clone)]
pub struct Domain {
    /// The boundary loops, all counter-clockwise in plan; loop 0 is the outer one, the others are holes.
    pub loops: Vec<BoundaryLoop>,
    /// The same loops in plan, by their plan lengths.
    pub plan_loops: Vec<BoundaryLoop>,
    /// Curve parameter of the mark on loop 0; it counts where no loop has a corner.
    mark: f64,
    /// Area of the surface within the boundary, m².
    surface_area: f64,
    /// Loops whose file leaves gaps that were closed, and the widest of each, m.
    pub closed_gaps: Vec<(usize, f64)>,
    /// What [`Domain::own_symmetries`] found, once it was asked for.
    own_symmetries: OnceLock<Vec<(Symmetry, crate::mesh::Symmetry)>>,
}

impl Domain {
    /// Makes the domain of a config on its surface and checks both against each other; the files that it names are among `inputs`. Corners
    /// that are to be found are single kinks: no pattern is in view that would tell what a short way is.
    ///
    /// # Errors
    /// See [`Domain::resolve_for`].
    pub fn resolve(
        params: &DomainParams,
        surface: &Arc<dyn Surface>,
        inputs: &Inputs,
    ) -> Result<Self, DomainError> {
        Self::resolve_for(params, surface, inputs, Grain::Length(0.0))
    }

    /// Makes the domain of a config on its surface, for patterns of a grain, and checks both against each other; the
    /// files that it names are among `inputs`.
    ///
    /// A loop given clockwise is turned round, its first point stays the first. Where the surface is not free, the boundary is the
    /// plan curve lifted onto it and a given z does not count. Corners that are to be found are where the curve turns within a
    /// tenth of a target length.
    ///
    /// # Errors
    /// See [`DomainError`]; loops and points at fault are named.
    pub fn resolve_for(
        params: &DomainParams,
        surface: &Arc<dyn Surface>,
        inputs: &Inputs,
        grain: Grain,
    ) -> Result<Self, DomainError> {
        if params.loops.is_empty() {
            return Err(DomainError::NoLoop);
        }
        let (mut curves, mut marked, mut closed_gaps) = (Vec::new(), Vec::new(), Vec::new());
        for (i, given) in params.loops.iter().enumerate() {
            let (curve, corners, gap) = read::curve(i, given, inputs)?;
            curves.push(curve);
            marked.push(corners);
            closed_gaps.extend((gap > 0.0).then_some((i, gap)));
        }
        check::extents(&curves)?;
        check::curves(&curves)?;
        check::covered(&curves, surface.as_ref())?;
        let plan_area = curves[0].area() - curves[1..].iter().map(Curve::area).sum::<f64>();
        let surface_area = area::on_surface(&curves, plan_area, surface.as_ref());
        let way = TURN * grain.length(surface_area);
        let corners: Vec<Vec<f64>> =
            marked.into_iter().zip(&curves).map(|(marked, curve)| marked.corners(curve, way)).collect();
        let mark = match params.mark_m {
            None => curves[0].rightmost(),
            Some(_) if corners.iter().any(|corners| !corners.is_empty()) => {
                return Err(DomainError::MarkBesideCorners);
            }
            Some([x, y]) => curves[0].closest([x, y, 0.0], true),
        };
        let loops: Vec<BoundaryLoop> = curves
            .into_iter()
            .zip(corners)
            .map(|(curve, corners)| BoundaryLoop::new(curve, surface, corners, way))
            .collect();
        let plan_loops = loops.iter().map(BoundaryLoop::in_plan).collect();
        Ok(Self { loops, plan_loops, mark, surface_area, closed_gaps, own_symmetries: OnceLock::new() })
    }

    /// Corners of all loops together.
    pub fn corner_count(&self) -> usize {
        self.loops.iter().map(|l| l.corners().len()).sum()
    }

    /// Corner numbers of one loop: corners count loop by loop, counter-clockwise along each.
    pub fn loop_corners(&self, loop_number: usize) -> std::ops::Range<usize> {
        let start = self.loops[..loop_number].iter().map(|l| l.corners().len()).sum();
        start..start + self.loops[loop_number].corners().len()
    }

    /// Position of a corner: its loop and arc length.
    pub fn corner(&self, corner: usize) -> Option<(usize, f64)> {
        (0..self.loops.len()).find_map(|i| {
            let range = self.loop_corners(i);
            range.contains(&corner).then(|| (i, self.loops[i].corners()[corner - range.start]))
        })
    }

    /// Where no loop has a corner: arc length on loop 0 of the mark that fixes the turn of a pattern, by default its point of
    /// largest x (docs/reference/geometry.md §0.4). It is not sharp.
    pub fn mark(&self) -> Option<f64> {
        (self.corner_count() == 0).then(|| self.loops[0].arc_length(self.mark))
    }

    /// Height of the surface over (x, y); `None` on a free surface and where it does not reach.
    pub fn height(&self, x: f64, y: f64) -> Option<f64> {
        self.loops[0].surface.as_ref()?.height(x, y)
    }

    /// Diagonal of the bounding box in plan, m.
    pub fn size(&self) -> f64 {
        let [low, high] = self.bounds();
        (high[0] - low[0]).hypot(high[1] - low[1])
    }

    /// Smallest and largest x and y, m.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        self.loops[0].curve.bounds()
    }

    /// Plan area without the holes, m².
    pub fn area(&self) -> f64 {
        self.loops[0].area() - self.loops[1..].iter().map(BoundaryLoop::area).sum::<f64>()
    }

    /// Area of the surface within the boundary, m²; on a free surface the plan area. It is a property of the domain alone, so
    /// that a target length taken from it is the same for all designs (docs/reference/geometry.md §2.2).
    pub fn surface_area(&self) -> f64 {
        self.surface_area
    }

    /// Angle within the domain at a corner, along the surface, rad, between the directions a tenth of a target length before and
    /// after it: what the panels there share. π/2 in a rectangle's corner, 3π/2
    /// at a re-entrant one and at the corner of a rectangular hole. π where there is no such corner, as
    /// anywhere on a smooth boundary.
    pub fn corner_angle(&self, corner: usize) -> f64 {
        let Some((label, s)) = self.corner(corner) else { return PI };
        let turning = self.loops[label].turning(s);
        PI + if label == 0 { -turning } else { turning }
    }

    /// Whether (x, y) lies in the domain or within 1e-9 of its size from the boundary.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        self.contains_within(point, 1e-9 * self.size())
    }

    /// Whether (x, y) lies in the domain or within `tolerance` metres of its boundary.
    pub fn contains_within(&self, point: [f64; 2], tolerance: f64) -> bool {
        let near = |l: &BoundaryLoop| {
            let q = l.curve.point(l.curve.closest([point[0], point[1], 0.0], true));
            (q[0] - point[0]).hypot(q[1] - point[1]) <= tolerance
        };
        let (outer, holes) = (&self.loops[0], &self.loops[1..]);
        (outer.surrounds(point) || near(outer)) && holes.iter().all(|h| !h.surrounds(point) || near(h))
    }
}
