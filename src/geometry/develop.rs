//! The chain from the canonical mesh to a checked pattern, each step a function of the one before (docs/reference/geometry.md §0).

use super::boundary::{self, BoundaryLoop};
use super::check;
use super::coarse::Coarse;
use super::corners::{self, LoopCorners};
use super::dense::{Dense, Edges, densify};
use super::density::Fineness;
use super::force_density;
use super::images::{self, Image};
use super::limits::Limits;
use super::optimise::{Ground, Optimiser, Sheet, Task};
use super::params::{Density, PatternParams, RelaxKind};
use super::pattern::Pattern;
use super::place::{self, Folds, Placed};
use super::rejection::Rejection;
use super::relax;
use super::topology;
use crate::domain::Domain;
use crate::domain::params::Pinched;
use crate::mesh::CanonicalMesh;
use crate::surface::Surface;

/// What is wrong with a mesh before any geometry: other loops than the domain, flat faces, pinched vertices, and, with `limits`, vertices
/// whose panels break them in every pattern (docs/reference/geometry.md §1.4).
pub fn topological_rejection(
    mesh: &CanonicalMesh,
    domain: &Domain,
    pinched: Pinched,
    limits: Option<&Limits>,
) -> Option<Rejection> {
    let coarse = Coarse::of(mesh);
    if coarse.loops.len() != domain.loops.len() {
        return Some(Rejection::OtherLoops { mesh: coarse.loops.len(), domain: domain.loops.len() });
    }
    let corners = corners::assign(&coarse, domain);
    topology::reject(&coarse, domain, &corners, pinched == Pinched::Allow)
        .or_else(|| limits.and_then(|limits| topology::reject_crowded(&coarse, domain, &corners, limits)))
}

/// Develops a design: corners → densities and geometry → checked.
///
/// [`topological_rejection`] is not asked again; a mesh it refuses gives some pattern or a fold.
///
/// # Errors
/// The [`Rejection`] of the first step that fails.
pub fn develop(
    mesh: &CanonicalMesh,
    domain: &Domain,
    surface: &dyn Surface,
    params: &PatternParams,
) -> Result<Pattern, Rejection> {
    let Shaped { pattern, refused } = shape(mesh, domain, surface, params)?;
    refused.map_or(Ok(pattern), Err)
}

/// A pattern, sound or not.
pub struct Shaped {
    /// The pattern.
    pub pattern: Pattern,
    /// What [`check::check`] says of it; `None` of a sound one.
    pub refused: Option<Rejection>,
}

impl Shaped {
    pub(super) fn of(pattern: Pattern, domain: &Domain, surface: &dyn Surface) -> Self {
        Self { refused: check::check(&pattern, domain, surface).err(), pattern }
    }
}

/// As [`develop`], a pattern that is not sound included: to look at what is wrong with it.
///
/// # Errors
/// The [`Rejection`] of the first step that leaves no pattern.
pub fn shape(
    mesh: &CanonicalMesh,
    domain: &Domain,
    surface: &dyn Surface,
    params: &PatternParams,
) -> Result<Shaped, Rejection> {
    let coarse = Coarse::of(mesh);
    if coarse.loops.len() != domain.loops.len() {
        return Err(Rejection::OtherLoops { mesh: coarse.loops.len(), domain: domain.loops.len() });
    }
    let corners = corners::assign(&coarse, domain);
    let limits = Limits::of(&params.limits, params.target_length(domain));
    let stage = Stage { coarse: &coarse, domain, surface, corners: &corners };
    let aims = limits.aims();
    let task = stage.task(params, &limits, &aims);
    let ground = Ground::new(domain, surface, limits.target_length).with_images(Image::all(mesh, domain));
    let optimiser = Optimiser::new(&task, &ground);
    let probe = stage.probe(params.max_faces)?.into_sheet(&ground);
    if params.relax.kind == RelaxKind::Optimise {
        let first = stage.place(&optimiser.coarse_rows(&probe)?, Folds::Unfold)?.into_sheet(&ground);
        return optimiser.run(first);
    }
    let rows = optimiser.pattern_rows(&probe)?;
    let relaxed = |folds| {
        let mut pattern = stage.relaxed(&rows, params, &limits, folds)?;
        images::even_out(&mut pattern, &ground.images, domain, surface);
        Ok(Shaped::of(pattern, domain, surface))
    };
    let shaped = relaxed(Folds::Leave)?;
    if shaped.refused.is_some() { relaxed(Folds::Unfold) } else { Ok(shaped) }
}

/// The net of equal force densities held by the boundary, then back onto the surface.
fn balance(
    dense: &Dense,
    edges: &Edges,
    placed: &mut Placed,
    surface: &dyn Surface,
) -> Result<(), Rejection> {
    let is_held = boundary::marked(dense.vertex_count, dense.loops.iter().flatten());
    let densities = vec![1.0; edges.list.len()];
    let net = force_density::solve(&placed.positions, &edges.list, &densities, &[], &is_held)?;
    for (v, place) in net.into_iter().enumerate().filter(|&(v, _)| !is_held[v]) {
        placed.positions[v] = surface.project(place);
    }
    Ok(())
}

/// Parts of every strip of the mesh on which lengths are first measured.
const PROBE_PARTS: u32 = 4;

struct Stage<'a> {
    coarse: &'a Coarse<'a>,
    domain: &'a Domain,
    surface: &'a dyn Surface,
    corners: &'a [LoopCorners],
}

struct Site {
    dense: Dense,
    edges: Edges,
    loops: Vec<BoundaryLoop>,
    placed: Placed,
}

impl Stage<'_> {
    fn task<'b>(&'b self, params: &PatternParams, limits: &'b Limits, aims: &'b Limits) -> Task<'b> {
        let t = limits.target_length;
        let panels = match params.density {
            Density::Panels => params.panels as f64,
            Density::TargetLength => self.domain.surface_area() / (t * t),
        };
        let fineness = match params.density {
            Density::Panels => Fineness::Panels(panels),
            Density::TargetLength => Fineness::Width(t),
        };
        let Self { coarse, domain, surface, corners } = *self;
        Task { coarse, domain, surface, corners, limits, aims, fineness, panels, max_faces: params.max_faces }
    }

    /// Placed and relaxed at the given densities.
    fn relaxed(
        &self,
        rows: &[u32],
        params: &PatternParams,
        limits: &Limits,
        folds: Folds,
    ) -> Result<Pattern, Rejection> {
        let mut site = self.place(rows, folds)?;
        let Site { dense, edges, loops, placed } = &mut site;
        if params.relax.kind == RelaxKind::ForceDensity {
            balance(dense, edges, placed, self.surface)?;
        } else {
            let sweeps = relax::Mesh::new(dense.vertex_count, &dense.panels, &edges.list, loops);
            relax::relax(placed, &sweeps, self.domain, self.surface, &params.relax);
        }
        Ok(site.into_pattern(self.coarse, self.corners, limits.target_length))
    }

    /// Every strip in the same number of parts, on which lengths are measured: in more than [`PROBE_PARTS`]
    /// where otherwise corners that no coarse vertex took would find no place between two that did.
    fn probe(&self, max_faces: usize) -> Result<Site, Rejection> {
        let place = |parts| self.place(&vec![parts; self.coarse.mesh.strips.len()], Folds::Leave);
        let untaken = self.corners.iter().map(LoopCorners::longest_untaken).max().unwrap_or(0);
        // Beyond this the pattern itself would have too many faces.
        let affordable = (max_faces / self.coarse.mesh.faces.len().max(1)).isqrt();
        match (place(PROBE_PARTS), (untaken + 1).min(affordable) as u32) {
            (Err(Rejection::CornerLost { .. }), more) if more > PROBE_PARTS => place(more),
            (placed, _) => placed,
        }
    }

    fn place(&self, parts: &[u32], folds: Folds) -> Result<Site, Rejection> {
        let dense = densify(self.coarse, parts);
        let edges = Edges::of(dense.vertex_count, &dense.panels);
        let loops = boundary::anchor(self.coarse, &dense, self.domain, self.corners)?;
        let placed = place::place(self.domain, self.surface, &dense, &edges, &loops, folds)?;
        Ok(Site { dense, edges, loops, placed })
    }
}

impl Site {
    fn into_sheet(self, ground: &Ground<'_>) -> Sheet {
        let points = self.placed.positions.into_iter().map(|p| ground.local(p)).collect();
        Sheet::placed(ground, self.dense, points, &self.loops, &self.placed.along)
    }

    fn into_pattern(self, coarse: &Coarse<'_>, corners: &[LoopCorners], target_length: f64) -> Pattern {
        let taken =
            |(l, c): (&BoundaryLoop, &LoopCorners)| if c.sharp { l.corners.clone() } else { Vec::new() };
        Pattern {
            positions: self.placed.positions,
            panels: self.dense.panels,
            edges: self.edges.list,
            corners: self.loops.iter().zip(corners).flat_map(taken).collect(),
            loop_corners: corners
                .iter()
                .map(|c| if c.sharp { c.numbers.clone() } else { c.numbers.start..c.numbers.start })
                .collect(),
            loops: self.loops.into_iter().map(|l| l.vertices).collect(),
            along: self.placed.along,
            coarse: (0..coarse.mesh.vertex_count as u32).collect(),
            coarse_face: self.dense.coarse_face,
            target_length,
        }
    }
}
