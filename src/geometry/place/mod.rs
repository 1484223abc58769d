//! First positions of the dense mesh, by direct linear solves (docs/reference/geometry.md §2.1).

mod annulus;
mod hubs;
mod polar;

use super::boundary::BoundaryLoop;
use super::dense::{Dense, Edges};
use super::laplacian::{Laplacian, Weights};
use super::optimise::net::Net;
use super::optimise::{Ground, Sheet};
use super::rejection::Rejection;
use super::untangle::{even_out, untangle};
use crate::domain::{BoundaryLoop as Curve, Domain};
use crate::surface::{Surface, SurfaceKind};

/// Points of a curve looked at to find its middle and whether it is convex.
const SAMPLES: usize = 256;

/// Positions in plan, and where the boundary vertices stand.
pub struct Shape {
    /// x, y of every vertex, m.
    pub plan: Vec<[f64; 2]>,
    /// For each loop, the arc length of each of its vertices, m.
    pub along: Vec<Vec<f64>>,
}

/// A dense mesh with positions.
pub struct Placed {
    /// Positions on the surface (on the boundary curves for boundary vertices), m.
    pub positions: Vec<[f64; 3]>,
    /// For each loop, the arc length of each vertex of [`BoundaryLoop::vertices`], m.
    pub along: Vec<Vec<f64>>,
}

/// What placing does with corners that the linear solves leave folded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Folds {
    /// Leaves them: relaxing turns nearly all of them over, and ends more evenly from there. Not so between several holes.
    Leave,
    /// Turns them over before anything else.
    Unfold,
}

/// Places every vertex of a dense mesh.
///
/// # Errors
/// [`Rejection::NotFinite`] if a system is singular or a position is no number.
pub fn place(
    domain: &Domain,
    surface: &dyn Surface,
    dense: &Dense,
    edges: &Edges,
    loops: &[BoundaryLoop],
    folds: Folds,
) -> Result<Placed, Rejection> {
    let failed = Rejection::NotFinite { stage: "placing" };
    let mut shape = in_plan(domain, dense, edges, loops).ok_or_else(|| failed.clone())?;
    // Between several holes the linear solves crowd panels against them, which relaxing would take long to spread: strips would be
    // measured too short. A free form is in balance as it is.
    let is_crowded = domain.loops.len() > 2 && surface.kind() != SurfaceKind::Free;
    if folds == Folds::Unfold || is_crowded {
        unfold(&mut shape, domain, surface, dense, loops, is_crowded);
    }
    let positions =
        lift(domain, surface, edges, loops, shape.plan, &shape.along).ok_or_else(|| failed.clone())?;
    if positions.iter().flatten().all(|x| x.is_finite()) {
        Ok(Placed { positions, along: shape.along })
    } else {
        Err(failed)
    }
}

/// Turns folded corners over where the linear solves left some, the boundary held, and evens the pattern out if asked for.
fn unfold(
    shape: &mut Shape,
    domain: &Domain,
    surface: &dyn Surface,
    dense: &Dense,
    loops: &[BoundaryLoop],
    evened: bool,
) {
    let ground = Ground::new(domain, surface, (domain.area() / dense.panels.len() as f64).sqrt());
    let points = shape.plan.iter().map(|&[x, y]| ground.local([x, y, 0.0])).collect();
    let sheet = Sheet::placed(&ground, dense.clone(), points, loops, &shape.along);
    let net = Net::new(&ground, &sheet, 2, true);
    let mut found = untangle(&net, 1.0).unwrap_or_else(|| net.start());
    if evened {
        found = even_out(&net, 1.0, found);
    }
    let mut places = net.places();
    net.place_in_plan(&found, &mut places);
    for (plan, point) in shape.plan.iter_mut().zip(places.points) {
        let [x, y, _] = ground.global(point);
        *plan = [x, y];
    }
}

fn in_plan(domain: &Domain, dense: &Dense, edges: &Edges, loops: &[BoundaryLoop]) -> Option<Shape> {
    if let Some(chart) = annulus::chart(domain) {
        return annulus::place(domain, &chart, &dense.panels, edges, loops, dense.vertex_count);
    }
    let phases = hubs::phases(domain, &edges.list, loops, dense.vertex_count)?;
    let along: Vec<Vec<f64>> = loops.iter().zip(phases).map(|(l, phase)| l.even(phase)).collect();
    let mut is_fixed = vec![false; dense.vertex_count];
    let mut x = vec![0.0; dense.vertex_count];
    let mut y = x.clone();
    for ((held, along), curve) in loops.iter().zip(&along).zip(&domain.loops) {
        for (&v, &s) in held.vertices.iter().zip(along) {
            let [px, py, _] = curve.point(s);
            is_fixed[v as usize] = true;
            x[v as usize] = px;
            y[v as usize] = py;
        }
    }
    let harmonic = Laplacian::new(&edges.list, Weights::Equal, &is_fixed)?;
    harmonic.extend(&mut x);
    harmonic.extend(&mut y);
    Some(Shape { plan: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(), along })
}

/// From plan to space: boundary vertices exactly onto their curves, the others onto the surface above, or, where there
/// is none, at harmonic heights.
fn lift(
    domain: &Domain,
    surface: &dyn Surface,
    edges: &Edges,
    loops: &[BoundaryLoop],
    plan: Vec<[f64; 2]>,
    along: &[Vec<f64>],
) -> Option<Vec<[f64; 3]>> {
    let mut positions: Vec<[f64; 3]> = plan.into_iter().map(|[x, y]| [x, y, 0.0]).collect();
    let mut is_fixed = vec![false; positions.len()];
    for ((held, along), curve) in loops.iter().zip(along).zip(&domain.loops) {
        for (&v, &s) in held.vertices.iter().zip(along) {
            is_fixed[v as usize] = true;
            positions[v as usize] = curve.point(s);
        }
    }
    let free = || (0..is_fixed.len()).filter(|&v| !is_fixed[v]);
    match surface.kind() {
        SurfaceKind::Height => {
            for v in free() {
                positions[v] = surface.project(positions[v]);
            }
        }
        SurfaceKind::Closest => {
            for v in free() {
                let [x, y, _] = positions[v];
                positions[v] = match surface.height(x, y) {
                    Some(z) => [x, y, z],
                    None => surface.project(positions[v]),
                };
            }
        }
        SurfaceKind::Free => {
            let mut z: Vec<f64> = positions.iter().map(|p| p[2]).collect();
            Laplacian::new(&edges.list, Weights::Equal, &is_fixed)?.extend(&mut z);
            for (position, z) in positions.iter_mut().zip(z) {
                position[2] = z;
            }
        }
    }
    Some(positions)
}

/// Centroid of the area within a curve, from points along it.
fn centroid(curve: &Curve) -> [f64; 2] {
    let points: Vec<[f64; 3]> =
        (0..SAMPLES).map(|i| curve.point(curve.length() * i as f64 / SAMPLES as f64)).collect();
    let [ox, oy, _] = points[0];
    let (mut area, mut cx, mut cy) = (0.0, 0.0, 0.0);
    for i in 0..SAMPLES {
        let ([ax, ay, _], [bx, by, _]) = (points[i], points[(i + 1) % SAMPLES]);
        let cross = (ax - ox) * (by - oy) - (bx - ox) * (ay - oy);
        area += cross;
        cx += cross * (ax + bx - 2.0 * ox);
        cy += cross * (ay + by - 2.0 * oy);
    }
    [ox + cx / (3.0 * area), oy + cy / (3.0 * area)]
}
