//! Boundary loops: exact curves, arc lengths, corners, and what is refused.

use quadrille::domain::{Domain, DomainError, DomainParams, Symmetry};
use quadrille::io::Inputs;
use quadrille::surface::{self, SurfaceParams};
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn resolve(domain: &str, surface: &str) -> Result<Domain, DomainError> {
    let params: DomainParams = toml::from_str(domain).unwrap();
    let surface: SurfaceParams = toml::from_str(surface).unwrap();
    let surface = surface::build(&surface, &Inputs::default()).unwrap();
    Domain::resolve(&params, &surface, &Inputs::read(Path::new("tests/data/domain"), params.files()))
}

const COURT: &str = r#"
    [[loop]]
    kind = "polyline"
    points_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]
    corners = "all"
    [[loop]]
    kind = "circle"
    center_m = [0.0, 0.0]
    radius_m = 22.245
"#;

#[test]
fn the_great_court() {
    let court = resolve(COURT, "kind = 'great-court'").unwrap();
    let (walls, circle) = (&court.loops[0], &court.loops[1]);
    assert!((walls.length() - 2.0 * (73.25 + 97.15)).abs() < 1e-10);
    assert!((circle.length() - TAU * 22.245).abs() < 1e-10);
    assert_eq!(walls.corners().len(), 4);
    assert_eq!(court.corner_count(), 4);
    assert_eq!(court.mark(), None);
    assert_eq!(court.loop_corners(1), 4..4);
    assert_eq!(court.corner(2), Some((0, walls.corners()[2])));
    assert_eq!(walls.point(walls.corners()[2]), [36.625, 46.025, 19.71]);
    assert!((court.area() - (73.25 * 97.15 - PI * 22.245 * 22.245)).abs() < 1e-9);
    assert!(court.contains([30.0, 0.0]) && court.contains([36.625, 0.0]) && court.contains([22.245, 0.0]));
    assert!(!court.contains([0.0, 0.0]) && !court.contains([36.63, 0.0]));
    for k in 0..200 {
        let s = walls.length() * f64::from(k) / 200.0;
        let [x, y, z] = walls.point(s);
        assert!(x.abs() == 36.625 || y == 46.025 || y == -51.125, "({x}, {y}) is not on a wall");
        assert_eq!(z, 19.71);
        assert!((walls.closest([x, y, 0.0]) - s).abs() < 1e-9);
        let s = circle.length() * f64::from(k) / 200.0;
        let [x, y, z] = circle.point(s);
        assert!((x.hypot(y) - 22.245).abs() < 1e-12 && (z - 20.955).abs() < 1e-9);
        assert!((circle.closest([0.3 * x, 0.3 * y, 0.0]) - s).abs() < 1e-9);
    }
    assert!(walls.is_straight(walls.corners()[3], walls.corners()[0]));
    assert!(!walls.is_straight(walls.corners()[0], walls.corners()[2]));
    assert!(!circle.is_straight(0.0, 1.0));
}

#[test]
fn a_clockwise_polyline_is_turned_and_keeps_its_first_point() {
    let domain = resolve(
        "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [0, 2], [1, 3], [3, 2], [3, 0]]\ncorners = [1, 3]",
        "kind = 'plane'",
    )
    .unwrap();
    let l = &domain.loops[0];
    assert_eq!(l.point(0.0), [0.0, 0.0, 0.0]);
    assert_eq!(l.point(1.5), [1.5, 0.0, 0.0]);
    assert_eq!(
        l.corners().iter().map(|&s| l.point(s)).collect::<Vec<_>>(),
        [[3.0, 2.0, 0.0], [0.0, 2.0, 0.0]]
    );
    assert_eq!(l.tangent(0.5), [1.0, 0.0, 0.0]);
}

#[test]
fn corners_found_by_angle() {
    // A square with two slightly bent sides.
    let text = "[[loop]]\nkind = 'polyline'\ncorners = 'auto'\n\
                points_m = [[0, 0], [2, -0.1], [4, 0], [4, 4], [2, 4.1], [0, 4]]";
    let domain = resolve(text, "kind = 'free'").unwrap();
    assert_eq!(domain.corner_count(), 4);
    let strict = format!("{text}\ncorner_angle_deg = 3.0");
    assert_eq!(resolve(&strict, "kind = 'free'").unwrap().corner_count(), 6);
}

/// On z = x²/2 the boundary y = 0, 0 ≤ x ≤ 1 has the length (√2 + asinh 1)/2.
#[test]
fn lengths_on_a_curved_surface() {
    let domain = resolve(
        "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1, 0], [1, 1], [0, 1]]",
        "kind = 'paraboloid'\nhalf_spans_m = [1.0, 1e9]\nrise_m = -0.5",
    )
    .unwrap();
    let side = 0.5 * (2f64.sqrt() + 1f64.asinh());
    let l = &domain.loops[0];
    assert!((l.corners()[1] - side).abs() < 1e-12, "{} {side}", l.corners()[1]);
    assert!((l.length() - 2.0 * side - 2.0).abs() < 1e-12);
    for k in 0..50 {
        let x = f64::from(k) / 50.0;
        let s = 0.5 * (x * (1.0 + x * x).sqrt() + x.asinh());
        assert!((l.point(s)[0] - x).abs() < 1e-9);
        assert!((l.closest([x, 0.0, 0.0]) - s).abs() < 1e-9);
    }
}

#[test]
fn an_ellipse_has_its_perimeter_and_its_mark() {
    let domain = resolve(
        "[[loop]]\nkind = 'ellipse'\ncenter_m = [1, 2]\nsemi_axes_m = [3, 1]\nrotation_deg = 90",
        "kind = 'plane'",
    )
    .unwrap();
    let l = &domain.loops[0];
    // Perimeter of the ellipse 3, 1: 13.36489322055495.
    assert!((l.length() - 13.364_893_220_554_95).abs() < 1e-9, "{}", l.length());
    let mark = l.point(domain.mark().unwrap());
    assert!((mark[0] - 2.0).abs() < 1e-9 && (mark[1] - 2.0).abs() < 1e-6);
    assert!((domain.area() - 3.0 * PI).abs() < 1e-12);
}

#[test]
fn a_mark_can_be_given() {
    let disc = |mark: &str| {
        let text = format!("{mark}\n[[loop]]\nkind = 'circle'\ncenter_m = [1, 0]\nradius_m = 2");
        resolve(&text, "kind = 'plane'").unwrap()
    };
    let above = disc("mark_m = [1, 9]");
    let [x, y, _] = above.loops[0].point(above.mark().unwrap());
    assert!((x - 1.0).abs() < 1e-12 && (y - 2.0).abs() < 1e-12, "({x}, {y})");
    // A mirror that moves the mark is none.
    assert!(above.symmetries(&[Symmetry::MirrorX]).is_ok());
    let refused = disc("").symmetries(&[Symmetry::MirrorX]).err().map(|error| error.to_string());
    assert!(refused.as_ref().is_some_and(|error| error.contains("mark_m")), "{refused:?}");
    let beside = resolve(&format!("mark_m = [1, 9]\n{COURT}"), "kind = 'plane'").err();
    assert!(
        beside.as_ref().is_some_and(|error| error.to_string().starts_with("domain.mark_m")),
        "{beside:?}"
    );
}

#[test]
fn a_free_boundary_keeps_its_height() {
    let domain = resolve(
        "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0, 0], [3, 0, 4], [3, 4, 0], [0, 4, 0]]\n\
         [[loop]]\nkind = 'circle'\ncenter_m = [1.5, 2, 7]\nradius_m = 0.5",
        "kind = 'free'",
    )
    .unwrap();
    assert_eq!(domain.loops[0].point(2.5), [1.5, 0.0, 2.0]);
    assert_eq!(domain.loops[1].point(0.0), [2.0, 2.0, 7.0]);
}

#[test]
fn wrong_boundaries_are_refused_by_name() {
    let square = "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [4, 0], [4, 4], [0, 4]]\n";
    let with = |rest: &str| format!("{square}[[loop]]\n{rest}");
    for (text, part) in [
        ("loop = []".to_owned(), "no loop"),
        ("[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1, 1]]".into(), "at least 3 points, found 2"),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1, 1], [0, 1], [1, 0]]".into(),
            "edge 0–1 meets edge 2–3",
        ),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [2, 0], [1, 0]]".into(),
            "crosses or touches itself",
        ),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [2, 0], [2, 2], [1, 0], [0, 2]]".into(),
            "touches itself",
        ),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1, 0], [1, 0], [0, 1]]".into(),
            "points 1 and 2 coincide",
        ),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1, 0], [0, 1], [0, 0]]".into(),
            "points 3 and 0 coincide",
        ),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1, nan], [0, 1]]".into(),
            "points_m[1][1] is NaN",
        ),
        (
            "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [1], [0, 1]]".into(),
            "points_m[1] has 1 coordinates",
        ),
        (format!("{square}corners = [0, 4]"), "corner 4 does not exist"),
        (format!("{square}corners = [1, 1]"), "corner 1 is listed twice"),
        (format!("{square}corner_angle_deg = 0.0"), "corner_angle_deg"),
        (with("kind = 'circle'\ncenter_m = [2, 2]\nradius_m = -1"), "radius_m must be positive"),
        (with("kind = 'circle'\ncenter_m = [2, 2]\nradius_m = inf"), "not finite"),
        (with("kind = 'circle'\ncenter_m = [2, 2]\nradius_m = 2"), "loops 0 and 1 cross or touch near (2.0"),
        (with("kind = 'circle'\ncenter_m = [9, 2]\nradius_m = 2"), "loop 1, a hole, lies outside"),
        (with("kind = 'circle'\ncenter_m = [2, 2]\nradius_m = 20"), "loop 1, a hole, lies outside"),
        (with("kind = 'ellipse'\ncenter_m = [2, 2]\nsemi_axes_m = [1, 3]"), "loops 0 and 1 cross"),
        (
            with("kind = 'polyline'\npoints_m = [[1, 1], [2, 1], [4, 2]]"),
            "loops 0 and 1 cross or touch near (4",
        ),
        (
            with(
                "kind = 'circle'\ncenter_m = [2, 2]\nradius_m = 1.5\n[[loop]]\nkind = 'circle'\ncenter_m = [2, 2]\nradius_m = 1",
            ),
            "loop 2, a hole, lies inside loop 1",
        ),
        (
            with(
                "kind = 'circle'\ncenter_m = [1, 2]\nradius_m = 0.5\n[[loop]]\nkind = 'circle'\ncenter_m = [2, 2]\nradius_m = 0.5",
            ),
            "loops 1 and 2 cross or touch near (1.",
        ),
        (with("kind = 'obj'\nfile = 'missing.obj'"), "missing.obj"),
        (with("kind = 'obj'\nfile = 'open.obj'"), "open.obj:6: the polyline is open"),
        (with("kind = 'obj'\nfile = 'broken.obj'"), "broken.obj:3: y is `zero`"),
        (with("kind = 'obj'\nfile = 'hole.obj'\npolyline = 7"), "number 7 (from 0) does not exist"),
    ] {
        let error =
            resolve(&text, "kind = 'plane'").err().unwrap_or_else(|| panic!("accepted: {text}")).to_string();
        assert!(error.contains(part), "{text}\n{error}\n{part}");
    }
}

#[test]
fn a_hole_from_an_obj_file() {
    let text = "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [4, 0], [4, 4], [0, 4]]\n\
                [[loop]]\nkind = 'obj'\nfile = 'hole.obj'\n";
    let domain = resolve(text, "kind = 'plane'").unwrap();
    assert_eq!(domain.loops[1].corners().len(), 4);
    assert!((domain.area() - 15.0).abs() < 1e-12);
}

#[test]
fn a_surface_that_does_not_cover_the_domain() {
    for (surface, part) in [
        ("kind = 'sphere'\ncenter_m = [0, 0, 0]\nradius_m = 40", "the sphere reaches 40 m"),
        ("kind = 'cylinder'\ncenter_m = [0, 0, 0]\nradius_m = 40", "the cylinder reaches 40 m"),
    ] {
        let error = resolve(COURT, surface).err().unwrap().to_string();
        assert!(error.contains("does not cover the domain") && error.contains(part), "{error}");
    }
    let whole = COURT.split("[[loop]]\n    kind = \"circle\"").next().unwrap();
    assert!(resolve(whole, "kind = 'great-court'").err().unwrap().to_string().contains("does not cover"));
}
