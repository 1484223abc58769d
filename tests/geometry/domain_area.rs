//! Area of the surface within the domain, and the angles at its corners.

use quadrille::domain::{Domain, DomainParams};
use quadrille::geometry::PatternParams;
use quadrille::io::Inputs;
use quadrille::surface::{self, MeshSurface, Surface, SurfaceParams};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

fn resolve(domain: &str, surface: &str) -> Domain {
    let params: DomainParams = toml::from_str(domain).unwrap();
    let surface: SurfaceParams = toml::from_str(surface).unwrap();
    let surface = surface::build(&surface, &Inputs::default()).unwrap();
    Domain::resolve(&params, &surface, &Inputs::default()).unwrap()
}

fn polygon(points: &[[f64; 2]]) -> String {
    format!("[[loop]]\nkind = 'polyline'\npoints_m = {points:?}\n")
}

fn circle(center: [f64; 2], radius: f64) -> String {
    format!("[[loop]]\nkind = 'circle'\ncenter_m = {center:?}\nradius_m = {radius:?}\n")
}

fn off(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

const L: [[f64; 2]; 6] = [[0.0, 0.0], [30.0, 0.0], [30.0, 12.0], [14.0, 12.0], [14.0, 25.0], [0.0, 25.0]];

#[test]
fn a_plane_has_its_plan_area() {
    let ell = resolve(&(polygon(&L) + &circle([6.0, 7.0], 2.5)), "kind = 'plane'");
    assert_eq!(ell.surface_area(), ell.area());
    let free = resolve(&polygon(&L), "kind = 'free'");
    assert_eq!(free.surface_area(), free.area());
}

/// Caps of spheres and paraboloids, a barrel over a rectangle, a sloping plane over an L with a hole.
#[test]
fn closed_forms() {
    let cap = |radius: f64| {
        resolve(
            &circle([3.0, -2.0], radius),
            "kind = 'sphere'\ncenter_m = [3.0, -2.0, -1.0]\nradius_m = 10.0",
        )
        .surface_area()
    };
    for (radius, tolerance) in [(3.0f64, 1e-8), (8.0, 1e-6), (9.9, 1e-5)] {
        let height = 10.0 - (100.0 - radius * radius).sqrt();
        assert!(off(cap(radius), 2.0 * PI * 10.0 * height) < tolerance, "{radius}: {}", cap(radius));
    }
    assert!(off(cap(10.0), 200.0 * PI) < 1e-4, "half sphere: {}", cap(10.0));

    // z = base + rise (1 − (x² + y²)/100).
    let paraboloid = "kind = 'paraboloid'\ncenter_m = [0.0, 0.0]\nhalf_spans_m = [10.0, 10.0]\nrise_m = 8.0";
    let bowl = resolve(&circle([0.0, 0.0], 10.0), paraboloid).surface_area();
    let k = 2.0 * 8.0 / 100.0f64;
    let exact = 2.0 * PI / (3.0 * k * k) * ((1.0 + k * k * 100.0).powf(1.5) - 1.0);
    assert!(off(bowl, exact) < 1e-9, "{bowl} {exact}");

    let barrel = "kind = 'cylinder'\ncenter_m = [0.0, 0.0, 0.0]\naxis_deg = 0.0\nradius_m = 8.0";
    let roof = resolve(&polygon(&[[-9.0, -5.0], [9.0, -5.0], [9.0, 6.0], [-9.0, 6.0]]), barrel);
    let arc = 8.0 * ((5.0f64 / 8.0).asin() + (6.0f64 / 8.0).asin());
    assert!(off(roof.surface_area(), 18.0 * arc) < 1e-9, "{}", roof.surface_area());

    let slope = "kind = 'height'\nexpression = '0.75 * x'";
    let ell = resolve(&(polygon(&L) + &circle([6.0, 7.0], 2.5)), slope);
    assert!(off(ell.surface_area(), 1.25 * ell.area()) < 1e-14);
}

/// A bowl of 40 × 40 quads, each cut in two: over all of it the sum of its triangles; the same with the domain turned on it.
#[test]
fn a_mesh_has_the_area_of_its_triangles() {
    let at = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) * 0.5 - 10.0, f64::from(j) * 0.5 - 10.0);
        [x, y, 5.0 - 0.03 * (x * x + y * y)]
    };
    let vertices: Vec<[f64; 3]> = (0..=40).flat_map(|j| (0..=40).map(move |i| at(i, j))).collect();
    let faces: Vec<Vec<u32>> = (0..40)
        .flat_map(|j| (0..40).map(move |i| 41 * j + i))
        .flat_map(|a| [vec![a, a + 1, a + 42], vec![a, a + 42, a + 41]])
        .collect();
    let area = |face: &Vec<u32>| {
        let [a, b, c] = [0, 1, 2].map(|k| vertices[face[k] as usize]);
        let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        0.5 * n.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    let exact: f64 = faces.iter().map(area).sum();
    let surface: Arc<dyn Surface> = Arc::new(MeshSurface::new(&vertices, &faces).unwrap());
    let on_mesh = |points: &[[f64; 2]]| {
        let params: DomainParams = toml::from_str(&polygon(points)).unwrap();
        Domain::resolve(&params, &surface, &Inputs::default()).unwrap().surface_area()
    };
    let square = |side: f64| [[-side, -side], [side, -side], [side, side], [-side, side]];
    assert!(off(on_mesh(&square(10.0)), exact) < 1e-3, "{} {exact}", on_mesh(&square(10.0)));
    let straight = on_mesh(&square(6.0));
    for degrees in [15.0f64, 45.0, 70.0] {
        let (s, c) = degrees.to_radians().sin_cos();
        // A bowl of revolution: only its facets lie differently.
        let other = on_mesh(&square(6.0).map(|[x, y]| [c * x - s * y, s * x + c * y]));
        assert!(off(other, straight) < 1e-3, "{degrees}: {other} {straight}");
    }
}

/// The number is that of a grid of 15,544 × 11,720 points, 6 mm apart, in a program of its own; the grid here is a
/// coarser one.
#[test]
fn the_great_court() {
    let walls = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]];
    let court = resolve(&(polygon(&walls) + &circle([0.0, 0.0], 22.245)), "kind = 'great-court'");
    let surface =
        surface::build(&toml::from_str("kind = 'great-court'").unwrap(), &Inputs::default()).unwrap();
    let (nx, ny) = (1465, 1943);
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..nx {
        for j in 0..ny {
            let x = -36.625 + 73.25 * (f64::from(i) + 0.5) / f64::from(nx);
            let y = -51.125 + 97.15 * (f64::from(j) + 0.5) / f64::from(ny);
            if x * x + y * y > 22.245 * 22.245 {
                sum += 1.0 / surface.normal([x, y, 0.0])[2];
                count += 1.0;
            }
        }
    }
    let sampled = court.area() * sum / count;
    assert!(off(court.surface_area(), sampled) < 1e-5, "{} {sampled}", court.surface_area());
    assert!(off(court.surface_area(), 6180.2535) < 2e-6, "{}", court.surface_area());
    let params = PatternParams { panels: 2000, ..Default::default() };
    assert!(off(params.target_length(&court), (sampled / 2000.0).sqrt()) < 1e-5);
}

fn turned(points: &[[f64; 2]], angle: f64) -> Vec<[f64; 2]> {
    let (s, c) = angle.sin_cos();
    points.iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect()
}

/// An L with a round hole on a hilly surface that is turned, mirrored and moved with it.
#[test]
fn area_is_the_domains_own() {
    let hills = |u: &str, v: &str| {
        format!("kind = 'height'\nexpression = '3 * sin(0.3 * ({u})) * cos(0.2 * ({v})) + 0.01 * ({u})^2'")
    };
    let of = |points: &[[f64; 2]], hole: [f64; 2], u: &str, v: &str| {
        resolve(&(polygon(points) + &circle(hole, 2.5)), &hills(u, v)).surface_area()
    };
    let map = |f: fn([f64; 2]) -> [f64; 2]| L.map(f);
    let area = of(&L, [6.0, 7.0], "x", "y");
    let quarter = of(&map(|[x, y]| [-y, x]), [-7.0, 6.0], "y", "-x");
    let mirrored = of(&map(|[x, y]| [-x, y]), [-6.0, 7.0], "-x", "y");
    let moved = of(&map(|[x, y]| [x + 4096.0, y - 512.0]), [4102.0, -505.0], "x - 4096", "y + 512");
    for (name, other) in [("turned", quarter), ("mirrored", mirrored), ("moved", moved)] {
        assert!(off(other, area) < 1e-12, "{name}: {other} {area}");
    }
    for degrees in [10.0, 30.0, 45.0, 77.0] {
        let (s, c) = f64::to_radians(degrees).sin_cos();
        let (u, v) = (format!("{c} * x + {s} * y"), format!("{c} * y - {s} * x"));
        let hole = turned(&[[6.0, 7.0]], f64::to_radians(degrees))[0];
        let other = of(&turned(&L, f64::to_radians(degrees)), hole, &u, &v);
        assert!(off(other, area) < 1e-3, "{degrees}: {other} {area}");
    }
}

#[test]
fn angles_at_corners() {
    let hole = [[3.0, 3.0], [6.0, 3.0], [6.0, 6.0], [3.0, 6.0]];
    let ell = resolve(&(polygon(&L) + &polygon(&hole)), "kind = 'plane'");
    let quarters: Vec<f64> = (0..ell.corner_count()).map(|c| ell.corner_angle(c) / FRAC_PI_2).collect();
    let expected = [1.0, 1.0, 1.0, 3.0, 1.0, 1.0, 3.0, 3.0, 3.0, 3.0];
    assert!(quarters.iter().zip(expected).all(|(q, e)| (q - e).abs() < 1e-9), "{quarters:?}");
    assert_eq!(ell.corner_angle(10), PI);
    // On a slope the angle along the surface counts: legs (1, 0, 1) and (0, 1, 1) make 60°.
    let square = polygon(&[[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]]);
    let slope = resolve(&square, "kind = 'height'\nexpression = 'x + y'");
    for (corner, degrees) in [60.0, 120.0, 60.0, 120.0].into_iter().enumerate() {
        assert!((slope.corner_angle(corner).to_degrees() - degrees).abs() < 1e-6);
    }
}
