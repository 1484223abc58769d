//! Geometry and density chosen together (docs/reference/geometry.md §6): an energy of angles and lengths with barriers at the limits of a
//! pattern that can be built, minimised on coarse patterns whose densities follow their shape, then on the pattern itself.
//!
//! ```text
//! placed (N/4) → [coarse descent → lengths → rows]³⁺ → pattern (N) → Q1, Q2, Q3 until the limits hold → other rows
//! ```
//!
//! Everything is a function of the canonical mesh: canonical arrays, one order of sums, no chance.

pub mod descent;
mod energy;
mod ground;
pub mod net;
mod resample;
mod rows;
mod sheet;

pub use ground::Ground;
pub use sheet::{Sheet, State};

use super::coarse::Coarse;
use super::corners::LoopCorners;
use super::dense::panel_count;
use super::density::{self, Fineness};
use super::develop::Shaped;
use super::images;
use super::limits::{self, Extremes, Limits};
use super::rejection::Rejection;
use super::untangle::untangle;
use super::vector::Vec3;
use crate::domain::Domain;
use crate::surface::Surface;
use descent::{Bounds, Energy, descend};
use energy::{Terms, Weights};
use net::{Net, Places};
use rows::Rungs;

/// ℓ, what edges are drawn to, in target lengths.
const REST: f64 = 1.02;
/// By how much the barriers keep off the limits of the shortest and the longest edge, the smallest angle and the gap.
const SHORT_RESERVE: f64 = 1.06;
const LONG_RESERVE: f64 = 0.95;
const ANGLE_RESERVE: f64 = 1.075;
const GAP_RESERVE: f64 = 0.95;
/// The coarse pattern has N divided by this.
const COARSENESS: f64 = 4.0;
/// Coarse descents.
const ROUNDS: usize = 3;
/// More of them while a strip has not the rows that its longest rung asks for.
const MORE_ROUNDS: usize = 4;
/// Times that strips with too long rungs get one row more.
const REPAIRS: usize = 3;
/// Energies after Q1 and Q2 over which a try ends: of 117 designs of the Great Court none that went on from more came to keep its limits.
const HOPELESS: [f64; 2] = [1e4, 1e3];

/// One descent: weights of angles and lengths, half the barriers' power, most steps, relative gain that counts as small.
struct Stage {
    angle: f64,
    length: f64,
    half_power: u32,
    iterations: usize,
    tolerance: f64,
}

impl Stage {
    /// The weights of a descent on a pattern whose panels are `coarseness` times as long as the target length.
    fn weights(&self, limits: &Limits, coarseness: f64) -> Weights {
        let unit = limits.target_length / coarseness;
        let sin = libm::sin((ANGLE_RESERVE * limits.min_angle).min(std::f64::consts::FRAC_PI_2));
        Weights {
            angle: self.angle,
            length: self.length,
            half_power: self.half_power,
            rest: REST * coarseness,
            range: [SHORT_RESERVE * limits.min_edge / unit, LONG_RESERVE * limits.max_edge / unit],
            sin_squared: sin * sin,
            gap: GAP_RESERVE * limits.max_gap / unit,
        }
    }
}

const COARSE: Stage = Stage { angle: 0.2, length: 0.2, half_power: 8, iterations: 25, tolerance: 1e-3 };
/// Q1 always, Q2 and Q3 while a limit is broken.
const FINE: [Stage; 3] = [
    Stage { angle: 0.2, length: 0.2, half_power: 8, iterations: 40, tolerance: 3e-4 },
    Stage { angle: 0.05, length: 0.03, half_power: 8, iterations: 60, tolerance: 3e-4 },
    Stage { angle: 0.02, length: 0.01, half_power: 16, iterations: 60, tolerance: 3e-4 },
];

/// What a pattern is made from.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The coarse mesh.
    pub coarse: &'a Coarse<'a>,
    /// Its domain.
    pub domain: &'a Domain,
    /// Its surface, which is not free.
    pub surface: &'a dyn Surface,
    /// The domain's corners on it.
    pub corners: &'a [LoopCorners],
    /// What the pattern is to keep.
    pub limits: &'a Limits,
    /// What it is drawn to keep: the same, or [`Limits::aims`] of it.
    pub aims: &'a Limits,
    /// Rows by a number of panels or by a width in metres.
    pub fineness: Fineness,
    /// N, what coarse patterns are a quarter of.
    pub panels: f64,
    /// Most panels.
    pub max_faces: usize,
}

/// Makes patterns for one task.
pub struct Optimiser<'a> {
    task: &'a Task<'a>,
    ground: &'a Ground<'a>,
    caps: Vec<u32>,
}

/// What one stage leaves.
struct Descended {
    energy: f64,
    state: State,
    shaped: Shaped,
    /// Whether it keeps all limits.
    is_good: bool,
}

/// A sheet after its last descent.
struct Tried {
    sheet: Sheet,
    shaped: Shaped,
    /// Infinite where something is folded, outside or out of order.
    energy: f64,
    /// Whether it keeps all limits.
    is_good: bool,
}

impl<'a> Optimiser<'a> {
    /// An optimiser in the ground's units, which are target lengths.
    pub fn new(task: &'a Task<'a>, ground: &'a Ground<'a>) -> Self {
        Self { caps: rows::caps(task), task, ground }
    }

    /// Rows of the pattern itself, measured on a placed sheet of any densities.
    ///
    /// # Errors
    /// [`Rejection::TooManyFaces`].
    pub fn pattern_rows(&self, sheet: &Sheet) -> Result<Vec<u32>, Rejection> {
        let rows = self.rows(sheet, &[]);
        self.check_count(&rows)?;
        Ok(rows)
    }

    /// The pattern from a sheet of about N/4 panels, placed, not smoothed.
    ///
    /// # Errors
    /// [`Rejection::TooManyFaces`]. Limits that are not kept, folds and vertices outside are no errors here.
    pub fn run(&self, placed: Sheet) -> Result<Shaped, Rejection> {
        let shaped = self.shape_coarsely(placed);
        let rows = self.rows(&shaped, &self.enough_rows(&shaped, 1.0));
        self.check_count(&rows)?;
        let mut tried = self.try_rows(&shaped, &rows);
        if !tried.energy.is_finite() {
            let doubled: Vec<u32> = shaped.dense_parts(self.task.coarse).iter().map(|n| 2 * n).collect();
            if self.check_count(&doubled).is_ok() {
                tried = self.try_rows(&shaped, &doubled);
            }
        }
        if tried.is_good { Ok(tried.shaped) } else { Ok(self.repair(tried)) }
    }

    /// Coarse descents, each on rows that follow the shape found before, those after the third enough for its longest rungs; the last
    /// that nothing is folded in.
    fn shape_coarsely(&self, placed: Sheet) -> Sheet {
        let (mut shaped, mut is_clean) = self.descend(placed, &COARSE);
        for round in 1..ROUNDS + MORE_ROUNDS {
            if !is_clean {
                break;
            }
            let mut at_least = Vec::new();
            if round >= ROUNDS {
                at_least = self.enough_rows(&shaped, self.coarseness(&shaped));
                if self.has_rows(&shaped, &at_least) {
                    break;
                }
            }
            let rows = self.rows_of_coarse(&shaped, &at_least);
            if rows == shaped.dense_parts(self.task.coarse) || self.check_count(&rows).is_err() {
                break;
            }
            let next = resample::resample(self.task.coarse, self.ground, &shaped, &rows);
            let (found, found_clean) = self.descend(next, &COARSE);
            is_clean = found_clean;
            if is_clean {
                shaped = found;
            }
        }
        shaped
    }

    /// Rows of a coarse pattern of about N/4 panels, measured on a sheet of any densities.
    ///
    /// # Errors
    /// [`Rejection::TooManyFaces`]: a boundary with a point far away asks for more than memory holds.
    pub fn coarse_rows(&self, sheet: &Sheet) -> Result<Vec<u32>, Rejection> {
        let rows = self.rows_of_coarse(sheet, &[]);
        self.check_count(&rows)?;
        Ok(rows)
    }

    fn rows_of_coarse(&self, sheet: &Sheet, at_least: &[u32]) -> Vec<u32> {
        let fineness = Fineness::Panels(self.task.panels / COARSENESS);
        self.choose_rows(sheet, at_least, fineness, COARSENESS.sqrt())
    }

    /// Rows of the pattern itself.
    fn rows(&self, sheet: &Sheet, at_least: &[u32]) -> Vec<u32> {
        let fineness = match self.task.fineness {
            Fineness::Panels(panels) => Fineness::Panels(panels),
            Fineness::Width(width) => Fineness::Width(width / self.task.limits.target_length),
        };
        self.choose_rows(sheet, at_least, fineness, 1.0)
    }

    /// Rows in proportion to mean rungs, as many as corners, sides and `at_least` (nothing, or a number a strip) ask for.
    fn choose_rows(&self, sheet: &Sheet, at_least: &[u32], fineness: Fineness, coarseness: f64) -> Vec<u32> {
        let Task { coarse, aims, .. } = *self.task;
        let lengths: Vec<f64> = rows::rungs(coarse, sheet).iter().map(Rungs::mean).collect();
        let mut bounds = rows::bounds(coarse, self.ground, sheet, aims, &self.caps, coarseness);
        bounds.least.iter_mut().zip(at_least).for_each(|(least, more)| *least = (*least).max(*more));
        let mut rows = density::choose(coarse, &lengths, fineness, &bounds);
        // Strips that are images of each other have equal rows, but where lengths that should be equal differ by more than rounding.
        images::even_rows(coarse, &self.ground.images, &mut rows);
        rows
    }

    /// Rows with which no rung of a strip is longer than the longest edge, or as many as the strip may have.
    fn enough_rows(&self, sheet: &Sheet, coarseness: f64) -> Vec<u32> {
        let longest = coarseness * LONG_RESERVE * self.task.aims.max_edge / self.task.aims.target_length;
        let enough = |(rungs, &cap): (&Rungs, &u32)| ((rungs.most / longest).ceil() as u32).clamp(1, cap);
        rows::rungs(self.task.coarse, sheet).iter().zip(&self.caps).map(enough).collect()
    }

    fn check_count(&self, rows: &[u32]) -> Result<(), Rejection> {
        let n = panel_count(self.task.coarse, rows);
        let max = self.task.max_faces;
        if n > max { Err(Rejection::TooManyFaces { n, max }) } else { Ok(()) }
    }

    /// The sheet with other rows, through Q1 to Q3 or as far as the limits ask.
    fn try_rows(&self, from: &Sheet, rows: &[u32]) -> Tried {
        let mut sheet = resample::resample(self.task.coarse, self.ground, from, rows);
        let mut run = self.run_on(&mut sheet);
        let mut last = self.after_stage(&mut run, &FINE[0]);
        for (stage, hopeless) in FINE[1..].iter().zip(HOPELESS) {
            if last.is_good || last.energy > hopeless {
                break;
            }
            last = self.after_stage(&mut run, stage);
        }
        let Descended { energy, state, shaped, is_good } = last;
        sheet.set(state);
        Tried { sheet, shaped, energy, is_good }
    }

    fn after_stage(&self, run: &mut Run<'_>, stage: &Stage) -> Descended {
        let energy = run.stage(stage, self.task.aims, 1.0);
        let state = run.net.state(run.x.clone());
        let pattern = run.net.sheet.pattern(self.task, self.ground, &state);
        let shaped = Shaped::of(pattern, self.task.domain, self.task.surface);
        let is_good = energy.is_finite() && self.keeps_limits(&shaped);
        Descended { energy, state, shaped, is_good }
    }

    /// At most three times, strips get the rows that their longest rungs ask for; the first pattern that keeps the limits, or the one
    /// that came.
    fn repair(&self, mut tried: Tried) -> Shaped {
        let mut shaped = None;
        for _ in 0..REPAIRS {
            let enough = self.enough_rows(&tried.sheet, 1.0);
            let is_hopeless = tried.energy > HOPELESS[0];
            if is_hopeless || self.has_rows(&tried.sheet, &enough) {
                break;
            }
            let rows = self.rows(&tried.sheet, &enough);
            if self.check_count(&rows).is_err() {
                break;
            }
            let next = self.try_rows(&tried.sheet, &rows);
            if next.is_good {
                return next.shaped;
            }
            let before = std::mem::replace(&mut tried, next);
            shaped.get_or_insert(before.shaped);
        }
        shaped.unwrap_or(tried.shaped)
    }

    /// Whether every strip has so many rows.
    fn has_rows(&self, sheet: &Sheet, rows: &[u32]) -> bool {
        rows.iter().zip(sheet.dense_parts(self.task.coarse)).all(|(&enough, n)| enough <= n)
    }

    /// Untangled in plan where needed, then one descent; whether nothing is folded.
    fn descend(&self, mut sheet: Sheet, stage: &Stage) -> (Sheet, bool) {
        let coarseness = self.coarseness(&sheet);
        let mut run = self.run_on(&mut sheet);
        let energy = run.stage(stage, self.task.aims, coarseness);
        let state = run.net.state(run.x);
        sheet.set(state);
        (sheet, energy.is_finite())
    }

    /// A sheet's unknowns, untangled in plan where needed.
    fn run_on<'s>(&'s self, sheet: &'s mut Sheet) -> Run<'s> {
        let rest = REST * self.coarseness(sheet);
        if self.ground.is_height() {
            let net = Net::new(self.ground, sheet, 2, false);
            let x = untangle(&net, rest).unwrap_or_else(|| net.start());
            return Run::new(net, x);
        }
        let net = Net::new(self.ground, sheet, 2, false);
        if let Some(state) = untangle(&net, rest).map(|x| net.state(x)) {
            sheet.set(state);
        }
        let net = Net::new(self.ground, sheet, 3, false);
        let x = net.start();
        Run::new(net, x)
    }

    /// Mean edge length of a sheet in target lengths, √(N/Nc).
    fn coarseness(&self, sheet: &Sheet) -> f64 {
        (self.task.panels / sheet.quads.len() as f64).sqrt()
    }

    fn keeps_limits(&self, shaped: &Shaped) -> bool {
        shaped.refused.is_none()
            && limits::excesses(&Extremes::of(&shaped.pattern, self.task.domain), self.task.limits)
                .iter()
                .all(|limit| limit.excess <= 0.0)
    }
}

/// A sheet on its way down.
struct Run<'a> {
    net: Net<'a>,
    x: Vec<f64>,
    terms: Terms,
    places: Places,
    by_point: Vec<Vec3>,
}

impl<'a> Run<'a> {
    fn new(net: Net<'a>, mut x: Vec<f64>) -> Self {
        let mut places = net.places();
        net.place(&mut x, &mut places);
        let by_point = vec![[0.0; 3]; places.points.len()];
        Self { terms: Terms::of(&net), net, x, places, by_point }
    }

    /// One descent; the energy at its end.
    fn stage(&mut self, stage: &Stage, limits: &Limits, coarseness: f64) -> f64 {
        let weights = stage.weights(limits, coarseness);
        let bounds = Bounds { iterations: stage.iterations, tolerance: stage.tolerance, rest: weights.rest };
        let mut energy = Shape {
            net: &self.net,
            terms: &self.terms,
            weights,
            places: &mut self.places,
            by_point: &mut self.by_point,
        };
        descend(&self.net, &mut energy, &mut self.x, bounds)
    }
}

struct Shape<'a, 'b> {
    net: &'a Net<'b>,
    terms: &'a Terms,
    weights: Weights,
    places: &'a mut Places,
    by_point: &'a mut Vec<Vec3>,
}

impl Energy for Shape<'_, '_> {
    fn value(&mut self, x: &mut [f64], gradient: &mut [f64]) -> f64 {
        // What is seen in plan first: most steps that are too long cost no heights.
        self.net.place_in_plan(x, self.places);
        let is_height = self.net.ground.is_height();
        if self.net.is_out_of_order(x) || (is_height && self.terms.is_folded(&self.places.points)) {
            return f64::INFINITY;
        }
        self.net.lift(x, self.places);
        if self.net.is_outside(self.places) {
            return f64::INFINITY;
        }
        let sum = self.terms.energy(self.places, &self.weights, self.by_point);
        if !sum.is_finite() {
            return f64::INFINITY;
        }
        self.net.pull(self.places, self.by_point, gradient, false);
        sum + energy::gaps(self.net, x, self.places, &self.weights, gradient)
    }

    fn make_tangential(&self, direction: &mut [f64]) {
        self.net.make_tangential(self.places, direction);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dense::{Edges, densify};
    use crate::geometry::params::PatternParams;
    use crate::geometry::place::{self, Folds};
    use crate::geometry::{boundary, corners};
    use crate::mesh::isomorphism::canonical_mesh;
    use crate::study::Study;

    const SQUARE: &str =
        "[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0, 0], [30, 0], [30, 20], [0, 20]]\n";
    const OVAL: &str = "[[domain.loop]]\nkind = \"ellipse\"\ncenter_m = [10, 8]\nsemi_axes_m = [14, 6]\n";

    fn study(text: &str) -> Study {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("case.toml");
        std::fs::write(&file, format!("version = 1\n{text}")).unwrap();
        Study::of(&crate::config::ResolvedConfig::open(&file, &[]).unwrap()).unwrap()
    }

    /// The slope that the gradient gives along a direction against differences of the energy.
    fn slopes(study: &Study, stage: &Stage) -> (f64, f64) {
        let mesh = canonical_mesh(&study.initial.mesh);
        let coarse = Coarse::of(&mesh);
        let (domain, surface) = (&study.domain, study.surface.as_ref());
        let numbering = corners::assign(&coarse, domain);
        let params = PatternParams { panels: 200, ..PatternParams::default() };
        let limits = Limits::of(&params.limits, params.target_length(domain));
        let ground = Ground::new(domain, surface, limits.target_length);
        let dense = densify(&coarse, &vec![4; mesh.strips.len()]);
        let loops = boundary::anchor(&coarse, &dense, domain, &numbering).unwrap();
        let edges = Edges::of(dense.vertex_count, &dense.panels);
        let placed = place::place(domain, surface, &dense, &edges, &loops, Folds::Unfold).unwrap();
        let points = placed.positions.iter().map(|&p| ground.local(p)).collect();
        let sheet = Sheet::placed(&ground, dense, points, &loops, &placed.along);
        let net = Net::new(&ground, &sheet, if ground.is_height() { 2 } else { 3 }, false);
        let x = net.start();
        let mut run = Run::new(net, x);
        let weights = stage.weights(&limits, 1.0);
        let mut shape = Shape {
            net: &run.net,
            terms: &run.terms,
            weights,
            places: &mut run.places,
            by_point: &mut run.by_point,
        };
        let n = run.net.unknowns;
        let mut gradient = vec![0.0; n];
        assert!(shape.value(&mut run.x.clone(), &mut gradient).is_finite());
        let mut direction: Vec<f64> = (0..n).map(|i| libm::sin(2.3 * i as f64)).collect();
        shape.make_tangential(&mut direction);
        let given: f64 = gradient.iter().zip(&direction).map(|(g, d)| g * d).sum();
        let step = 1e-6;
        let mut at = |k: f64| {
            let mut x: Vec<f64> = run.x.iter().zip(&direction).map(|(x, d)| x + k * step * d).collect();
            shape.value(&mut x, &mut vec![0.0; n])
        };
        (given, (at(1.0) - at(-1.0)) / (2.0 * step))
    }

    #[test]
    fn gradients_are_the_energies_derivatives() {
        let grid = "[topology]\ninitial = { grid = [3, 2] }\n";
        let surfaces = [
            format!("{SQUARE}[surface]\nkind = \"height\"\nexpression = \"3*sin(x/9)*cos(y/7)\"\n{grid}"),
            format!("{SQUARE}[surface]\nkind = \"sphere\"\ncenter_m = [15, 10, -20]\nradius_m = 40\n{grid}"),
            format!(
                "{SQUARE}[surface]\nkind = \"cylinder\"\ncenter_m = [15, 10, -20]\nradius_m = 30\naxis_deg = 20\n{grid}"
            ),
            format!("{OVAL}[surface]\nkind = \"plane\"\n"),
            format!("{OVAL}[surface]\nkind = \"height\"\nexpression = \"2*sin(x/9)\"\n"),
        ];
        for text in &surfaces {
            let study = study(text);
            for stage in &FINE {
                let (given, measured) = slopes(&study, stage);
                assert!(
                    (given - measured).abs() <= 1e-5 * given.abs().max(measured.abs()),
                    "{text}: {given} {measured}"
                );
            }
        }
    }
}
