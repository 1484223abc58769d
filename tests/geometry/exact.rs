//! Patterns whose positions are known exactly: flat grids, nets of equal force densities, minimal surfaces
//! (docs/reference/geometry.md §2.4, §3).

use quadrille::domain::{Domain, DomainParams};
use quadrille::geometry::params::{RelaxKind, RelaxParams};
use quadrille::geometry::{Pattern, PatternParams, develop, metrics};
use quadrille::io::Inputs;
use quadrille::mesh::isomorphism::canonical_mesh;
use quadrille::mesh::{BaseMesh, CanonicalMesh, InitialMesh};
use quadrille::surface::{Surface, SurfaceParams, build};
use std::fmt::Write as _;
use std::sync::Arc;

fn site(domain: &str, surface: &SurfaceParams) -> (Domain, Arc<dyn Surface>) {
    let surface = build(surface, &Inputs::default()).expect("a surface");
    let params: DomainParams = toml::from_str(domain).expect("a domain");
    (Domain::resolve(&params, &surface, &Inputs::default()).expect("a domain"), surface)
}

fn canonical(base: &BaseMesh) -> CanonicalMesh {
    canonical_mesh(&InitialMesh::from_base(base).expect("a mesh").mesh)
}

/// One quad with its four corners.
fn single_quad() -> CanonicalMesh {
    canonical(&BaseMesh {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        faces: vec![vec![0, 1, 2, 3]],
        corners: (0..4).map(|k| vec![k]).collect(),
        ..BaseMesh::default()
    })
}

/// A ring of four quads; the mark is on the positive x axis.
fn ring() -> CanonicalMesh {
    let circle = |radius: f64| {
        (0..4)
            .map(move |k| [[radius, 0.0], [0.0, radius], [-radius, 0.0], [0.0, -radius]][k])
            .map(|[x, y]| [x, y, 0.0])
    };
    canonical(&BaseMesh {
        vertices: circle(1.0).chain(circle(2.0)).collect(),
        faces: (0..4).map(|k| vec![k, 4 + k, 4 + (k + 1) % 4, (k + 1) % 4]).collect(),
        corners: vec![vec![4]],
        ..BaseMesh::default()
    })
}

fn params(panels: usize, kind: RelaxKind, sweeps: usize) -> PatternParams {
    PatternParams { panels, relax: RelaxParams { kind, sweeps, damping: 0.5 }, ..PatternParams::default() }
}

const PLANE: SurfaceParams = SurfaceParams::Plane { z_m: 0.0 };

fn rectangle(width: f64, height: f64) -> String {
    format!(
        "[[loop]]\nkind = \"polyline\"\npoints_m = [[0.0, 0.0], [{width:?}, 0.0], [{width:?}, {height:?}], [0.0, {height:?}]]\n"
    )
}

#[test]
fn a_flat_square_grid_is_perfect() {
    let (domain, surface) = site(&rectangle(1.0, 1.0), &PLANE);
    let mesh = single_quad();
    for kind in [RelaxKind::Area, RelaxKind::Uniform, RelaxKind::Cotangent, RelaxKind::ForceDensity] {
        let pattern = develop(&mesh, &domain, surface.as_ref(), &params(100, kind, 100)).expect("a pattern");
        assert_eq!(pattern.panels.len(), 100);
        for p in &pattern.positions {
            for x in [p[0], p[1]] {
                assert!((x - (10.0 * x).round() / 10.0).abs() < 1e-12, "{kind:?}: {p:?}");
            }
        }
        let found = metrics::measure(&pattern, &mesh, &domain);
        for value in [found.curvature, found.skewness, found.edge_spread, found.planarity] {
            assert!(value < 1e-12, "{kind:?}: {found:?}");
        }
    }
}

#[test]
fn one_panel_of_two_by_one() {
    let (domain, surface) = site(&rectangle(2.0, 1.0), &PLANE);
    let mesh = single_quad();
    let mut params = params(1, RelaxKind::Area, 100);
    params.max_faces = 1;
    let pattern = develop(&mesh, &domain, surface.as_ref(), &params).expect("a pattern");
    let found = metrics::measure(&pattern, &mesh, &domain);
    assert_eq!((found.panels, found.nodes, found.members), (1, 4, 4));
    assert!(found.skewness.abs() < 1e-15 && (found.edge_spread - 0.5).abs() < 1e-15, "{found:?}");
    assert!((found.panel_area_mean - 2.0).abs() < 1e-15 && (found.aspect_mean - 2.0).abs() < 1e-15);
}

#[test]
fn one_corner_lifted() {
    for h in [0.01f64, 0.3, 1.0, 1.4] {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, h], [0.0, 1.0, 0.0]];
        let middle = [0.5, 0.5, h / 4.0];
        let mean = corners
            .iter()
            .map(|p| (0..3).map(|k| (p[k] - middle[k]) * (p[k] - middle[k])).sum::<f64>().sqrt())
            .sum::<f64>()
            / 4.0;
        let expected = (h / 4.0) / (1.0 + h * h / 2.0).sqrt() / mean;
        let found = metrics::panel_curvature(&corners);
        assert!((found - expected).abs() < 1e-14, "{h}: {found} {expected}");
    }
}

/// Two rings at different heights, given as polygons so fine that the net's vertices are on circles.
fn two_rings(inner: (f64, f64), outer: (f64, f64)) -> String {
    let mut text = String::new();
    for (radius, z) in [outer, inner] {
        let _ = write!(
            text,
            "[[loop]]\nkind = \"circle\"\ncenter_m = [0.0, 0.0, {z:?}]\nradius_m = {radius:?}\n"
        );
    }
    text
}

fn radius(p: &[f64; 3]) -> f64 {
    (p[0] * p[0] + p[1] * p[1]).sqrt()
}

/// Rings of a free net between two circles, from the outer one in: the vertices sorted by height.
fn rings(pattern: &Pattern) -> Vec<Vec<[f64; 3]>> {
    let n = pattern.loops[0].len();
    let mut sorted = pattern.positions.clone();
    sorted.sort_by(|a, b| a[2].total_cmp(&b[2]));
    sorted.chunks(n).map(<[_]>::to_vec).collect()
}

#[test]
fn uniform_free_form_follows_the_recurrence() {
    let (domain, surface) = site(&two_rings((1.0, 1.5), (2.0, 0.0)), &SurfaceParams::Free {});
    let mesh = ring();
    for kind in [RelaxKind::Uniform, RelaxKind::ForceDensity] {
        let pattern = develop(&mesh, &domain, surface.as_ref(), &params(150, kind, 4000)).expect("a pattern");
        let rings = rings(&pattern);
        let n = pattern.loops[0].len() as f64;
        assert!(rings.len() > 3 && n > 10.0, "{} rings of {n}", rings.len());
        let factor = 4.0 - 2.0 * (std::f64::consts::TAU / n).cos();
        let rise = 1.5 / (rings.len() - 1) as f64;
        let mean: Vec<f64> = rings.iter().map(|ring| ring.iter().map(radius).sum::<f64>() / n).collect();
        for (k, ring) in rings.iter().enumerate() {
            for p in ring {
                assert!((radius(p) - mean[k]).abs() < 1e-9, "{kind:?}: ring {k} is round");
                assert!((p[2] - rise * k as f64).abs() < 1e-9, "{kind:?}: ring {k} at {}", p[2]);
            }
        }
        for k in 1..rings.len() - 1 {
            let gap = mean[k + 1] + mean[k - 1] - factor * mean[k];
            assert!(gap.abs() < 1e-9, "{kind:?}: ring {k} is off by {gap:e}");
        }
    }
}

/// Between two rings of r = c cosh(z/c) the soap film is that catenoid (the wide one: it is stable).
#[test]
fn cotangent_free_form_is_a_catenoid() {
    let at = |z: f64| (libm::cosh(z), z);
    let (domain, surface) = site(&two_rings(at(0.1), at(1.0)), &SurfaceParams::Free {});
    let pattern = develop(&ring(), &domain, surface.as_ref(), &params(1500, RelaxKind::Cotangent, 3000))
        .expect("a pattern");
    let worst = pattern
        .positions
        .iter()
        .map(|p| (radius(p) - libm::cosh(p[2])).abs() / radius(p))
        .fold(0.0, f64::max);
    assert!(worst < 0.01, "off the catenoid by {worst} of the radius");
    assert!(worst > 0.0);
}

/// A patch of z = θ/2 between ρ = 1 and ρ = 2, θ from 0 to 2.4.
#[test]
fn cotangent_free_form_is_a_helicoid() {
    const PITCH: f64 = 0.5;
    const TURN: f64 = 2.4;
    let at = |rho: f64, theta: f64| [rho * libm::cos(theta), rho * libm::sin(theta), PITCH * theta];
    let pieces = 60;
    let mut points: Vec<[f64; 3]> =
        (0..=pieces).map(|i| at(2.0, TURN * f64::from(i) / f64::from(pieces))).collect();
    points.extend((0..=pieces).rev().map(|i| at(1.0, TURN * f64::from(i) / f64::from(pieces))));
    let last = pieces as usize;
    let domain = format!(
        "[[loop]]\nkind = \"polyline\"\npoints_m = {points:?}\ncorners = [0, {last}, {}, {}]\n",
        last + 1,
        2 * last + 1
    );
    let (domain, surface) = site(&domain, &SurfaceParams::Free {});
    let pattern =
        develop(&single_quad(), &domain, surface.as_ref(), &params(600, RelaxKind::Cotangent, 3000))
            .expect("a pattern");
    let worst =
        pattern.positions.iter().map(|p| (p[2] - PITCH * libm::atan2(p[1], p[0])).abs()).fold(0.0, f64::max);
    assert!(worst < 0.01, "off the helicoid by {worst} of the inner radius");
}
