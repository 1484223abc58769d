//! Corners that are found within a tenth of a target length (docs/reference/geometry.md §1.1), and how far a curve lies from its chords.

use quadrille::domain::{Domain, DomainParams, Grain};
use quadrille::io::Inputs;
use quadrille::surface::{self, SurfaceParams};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn resolve(domain: &str, grain: Grain) -> Domain {
    let params: DomainParams = toml::from_str(domain).unwrap();
    let surface = surface::build(&SurfaceParams::Plane { z_m: 0.0 }, &Inputs::default()).unwrap();
    Domain::resolve_for(&params, &surface, &Inputs::default(), grain).unwrap()
}

fn outline(points: &[[f64; 2]]) -> String {
    format!("[[loop]]\nkind = 'polyline'\npoints_m = {points:?}\ncorners = 'auto'\n")
}

/// An L of 20 m whose corners are fillets of `r` metres with four kinks of 22.5° each.
fn ell(r: f64) -> Vec<[f64; 2]> {
    let corners = [[0.0, 0.0], [20.0, 0.0], [20.0, 8.0], [8.0, 8.0], [8.0, 20.0], [0.0, 20.0]];
    let mut points = Vec::new();
    for i in 0..6usize {
        let (before, at, after) = (corners[(i + 5) % 6], corners[i], corners[(i + 1) % 6]);
        let unit = |to: [f64; 2]| {
            let d = [to[0] - at[0], to[1] - at[1]];
            d.map(|x| x / d[0].hypot(d[1]))
        };
        let (u, v) = (unit(before), unit(after));
        // Half an octagon about the centre of the fillet.
        let center = [at[0] + r * (u[0] + v[0]), at[1] + r * (u[1] + v[1])];
        points.extend([0.5f64, 1.5, 2.5, 3.5].map(|k| {
            let angle: f64 = FRAC_PI_2 * k / 4.0;
            let (s, c) = angle.sin_cos();
            let out = r / (PI / 16.0).cos();
            [center[0] - out * (c * v[0] + s * u[0]), center[1] - out * (c * v[1] + s * u[1])]
        }));
    }
    points
}

#[test]
fn fillets_of_a_millimetre_are_corners() {
    for r in [0.001, 0.02] {
        let filleted = resolve(&outline(&ell(r)), Grain::Panels(300));
        assert_eq!(filleted.corner_count(), 6, "{r}");
        let quarters: Vec<f64> = (0..6).map(|c| filleted.corner_angle(c) / FRAC_PI_2).collect();
        for (found, expected) in quarters.iter().zip([1.0, 1.0, 1.0, 3.0, 1.0, 1.0]) {
            assert!((found - expected).abs() < 1e-9, "{quarters:?}");
        }
        let sharp = [[0.0, 0.0], [20.0, 0.0], [20.0, 8.0], [8.0, 8.0], [8.0, 20.0], [0.0, 20.0]];
        let corners: Vec<[f64; 3]> =
            filleted.loops[0].corners().iter().map(|&s| filleted.loops[0].point(s)).collect();
        for ([x, y], found) in sharp.iter().zip(&corners) {
            assert!((found[0] - x).hypot(found[1] - y) < r, "{corners:?}");
        }
        let walls = filleted.loops[0].corners();
        assert!((0..5).all(|i| filleted.loops[0].is_straight(walls[i], walls[i + 1])));
    }
    // Against panels of 0.05 m a fillet of 20 mm is a curve, and against no panel at all every kink of 22.5° is.
    assert_eq!(resolve(&outline(&ell(0.02)), Grain::Length(0.05)).corner_count(), 0);
    assert_eq!(resolve(&outline(&ell(0.001)), Grain::Length(0.0)).corner_count(), 0);
}

/// A mirrored outline has the mirrored corners, whichever way round and from whichever point it is drawn.
#[test]
fn corners_do_not_depend_on_how_an_outline_is_drawn() {
    let places = |points: &[[f64; 2]], sign: f64| {
        let domain = resolve(&outline(points), Grain::Panels(300));
        let curve = &domain.loops[0];
        let mut places: Vec<[f64; 2]> =
            curve.corners().iter().map(|&s| curve.point(s)).map(|[x, y, _]| [sign * x, y]).collect();
        places.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        places
    };
    let points = ell(0.001);
    let drawn = places(&points, 1.0);
    let mirrored: Vec<[f64; 2]> = points.iter().map(|[x, y]| [-x, *y]).collect();
    let mut reversed = points.clone();
    reversed.reverse();
    let mut shifted = points.clone();
    shifted.rotate_left(7);
    for (name, other) in [
        ("mirrored", places(&mirrored, -1.0)),
        ("reversed", places(&reversed, 1.0)),
        ("shifted", places(&shifted, 1.0)),
    ] {
        assert_eq!(other.len(), drawn.len(), "{name}");
        for (a, b) in drawn.iter().zip(&other) {
            assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12, "{name}: {drawn:?} {other:?}");
        }
    }
}

#[test]
fn drawn_curves_have_no_corners() {
    let circle = |radius: f64| -> Vec<[f64; 2]> {
        (0..200).map(|k| f64::from(k) * TAU / 200.0).map(|a| [radius * a.cos(), radius * a.sin()]).collect()
    };
    for panels in [10, 300, 5000] {
        assert_eq!(resolve(&outline(&circle(10.0)), Grain::Panels(panels)).corner_count(), 0, "{panels}");
    }
    let trefoil: Vec<[f64; 2]> = (0..200)
        .map(|k| f64::from(k) * TAU / 200.0)
        .map(|a| [a, 7.0 + 4.0 * (3.0 * a).cos()])
        .map(|[a, r]| [r * a.cos(), r * a.sin()])
        .collect();
    assert_eq!(resolve(&outline(&trefoil), Grain::Panels(300)).corner_count(), 0);
}

#[test]
fn gaps_of_chords() {
    let circle = resolve("[[loop]]\nkind = 'circle'\ncenter_m = [3, 4]\nradius_m = 5", Grain::Panels(100));
    let sagitta = |angle: f64| 5.0 * (1.0 - (0.5 * angle).cos());
    for angle in [0.1, 0.7, 2.0] {
        let found = circle.loops[0].gap(1.0, 1.0 + 5.0 * angle);
        assert!((found - sagitta(angle)).abs() < 1e-12, "{angle}: {found}");
        // Over the start of the loop.
        let length = circle.loops[0].length();
        assert!(
            (circle.loops[0].gap(length - 0.2, length - 0.2 + 5.0 * angle) - sagitta(angle)).abs() < 1e-12
        );
    }
    let ellipse =
        resolve("[[loop]]\nkind = 'ellipse'\ncenter_m = [0, 0]\nsemi_axes_m = [20, 5]", Grain::Panels(100));
    let curve = &ellipse.loops[0];
    for (from, to) in [(0.0, 4.0), (12.0, 19.0), (curve.length() - 3.0, curve.length() + 2.0)] {
        let (a, b) = (curve.point(from), curve.point(to));
        let chord = (b[0] - a[0]).hypot(b[1] - a[1]);
        let off = |s: f64| {
            let p = curve.point(s);
            ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])).abs() / chord
        };
        let farthest =
            (0..=10_000).map(|k| off(from + (to - from) * f64::from(k) / 10_000.0)).fold(0.0, f64::max);
        assert!((curve.gap(from, to) - farthest).abs() < 1e-6, "{from}: {} {farthest}", curve.gap(from, to));
    }
    let square = resolve(&outline(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]), Grain::Panels(16));
    let walls = &square.loops[0];
    assert_eq!((walls.gap(0.0, 3.0), walls.gap(15.0, 16.0)), (0.0, 0.0));
    // A chord over a corner, from one metre before to one after.
    assert!((walls.gap(3.0, 5.0) - 0.5f64.sqrt()).abs() < 1e-12);
    assert!((walls.gap(15.0, 17.0) - 0.5f64.sqrt()).abs() < 1e-12);
}

/// The skeleton sees a corner only where a sample is.
#[test]
fn a_corner_between_two_points_is_sampled() {
    let filleted = resolve(&outline(&ell(0.001)), Grain::Panels(300));
    let curve = &filleted.loops[0];
    for spacing in [0.3, 5.0] {
        let samples = curve.sample(spacing);
        assert!(samples.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(curve.corners().iter().all(|corner| samples.contains(corner)));
    }
}
