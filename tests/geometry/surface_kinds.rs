//! Surfaces of the config: heights, closest points, normals, and what is refused.

use quadrille::domain::{Domain, DomainParams};
use quadrille::io::Inputs;
use quadrille::surface::{self, Surface, SurfaceKind, SurfaceParams};
use std::path::Path;
use std::sync::Arc;

fn build(text: &str) -> Result<Arc<dyn Surface>, String> {
    let params: SurfaceParams = toml::from_str(text).map_err(|e| e.to_string())?;
    surface::build(&params, &Inputs::read(Path::new("tests/data/surface"), params.files()))
        .map_err(|e| e.to_string())
}

const KINDS: [(&str, SurfaceKind); 8] = [
    ("kind = 'great-court'", SurfaceKind::Height),
    ("kind = 'plane'\nz_m = 3.0", SurfaceKind::Height),
    ("kind = 'height'\nexpression = 'h - x^2/400 - y^2/300'\nconstants = { h = 10.0 }", SurfaceKind::Height),
    ("kind = 'paraboloid'\nhalf_spans_m = [40, 50]\nrise_m = 10\nbase_m = 2", SurfaceKind::Height),
    ("kind = 'hypar'\nhalf_spans_m = [40, 50]\nrise_m = 10", SurfaceKind::Height),
    ("kind = 'sphere'\ncenter_m = [1, 2, -30]\nradius_m = 80", SurfaceKind::Closest),
    ("kind = 'cylinder'\ncenter_m = [0, 0, -30]\naxis_deg = 30\nradius_m = 80", SurfaceKind::Closest),
    ("kind = 'mesh'\nfile = 'hypar.obj'", SurfaceKind::Closest),
];

/// What holds for every surface: a projected point is on it, is its own projection, and the way to it is along the normal
/// (closest point) or vertical (height).
#[test]
fn projections_of_every_kind() {
    for (text, kind) in KINDS {
        let s = build(text).unwrap();
        assert_eq!(s.kind(), kind, "{text}");
        for p in [[30.0, 20.0, 5.0], [-25.0, -10.0, 40.0], [3.0, 35.0, -7.0], [-20.0, 30.0, 21.0]] {
            let q = s.project(p);
            let again = s.project(q);
            assert!((0..3).all(|k| (q[k] - again[k]).abs() < 1e-9), "{text}: {q:?} {again:?}");
            assert!((s.height(q[0], q[1]).unwrap() - q[2]).abs() < 1e-9, "{text}");
            let n = s.normal(q);
            assert!((n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0).abs() < 1e-12 && n[2] > 0.0, "{text}");
            let way = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            let direction = if kind == SurfaceKind::Height { [0.0, 0.0, 1.0] } else { n };
            let along: f64 = (0..3).map(|k| way[k] * direction[k]).sum();
            let across = (0..3).map(|k| (way[k] - along * direction[k]).abs()).fold(0.0, f64::max);
            if kind == SurfaceKind::Height || !text.contains("mesh") {
                assert!(across < 1e-9, "{text}: {way:?} {n:?}");
            }
        }
    }
}

/// Normals against finite differences of the height, a little inside the faces of the mesh.
#[test]
fn normals_of_every_kind() {
    let h = 1e-5;
    for (text, _) in KINDS {
        let s = build(text).unwrap();
        for (x, y) in [(30.123, 20.456), (-25.3, -10.2), (3.31, 35.77)] {
            let z = |x, y| s.height(x, y).unwrap();
            let (zx, zy) = ((z(x + h, y) - z(x - h, y)) / (2.0 * h), (z(x, y + h) - z(x, y - h)) / (2.0 * h));
            let n = s.normal([x, y, z(x, y)]);
            assert!(
                (-n[0] / n[2] - zx).abs() < 1e-6 && (-n[1] / n[2] - zy).abs() < 1e-6,
                "{text}: {n:?} {zx} {zy}"
            );
        }
    }
}

#[test]
fn heights_of_the_simple_ones() {
    let z = |text: &str, x, y| build(text).unwrap().height(x, y).unwrap();
    assert_eq!(z(KINDS[1].0, 7.0, 8.0), 3.0);
    assert_eq!(z("kind = 'height'\nexpression = '-x^2 + y'", 3.0, 1.0), -8.0);
    assert_eq!(
        z("kind = 'height'\nexpression = 'a * q'\nconstants = { a = 2.0 }\nlet = [['q', 'x + y']]", 3.0, 1.0),
        8.0
    );
    assert_eq!(z(KINDS[3].0, 0.0, 0.0), 12.0);
    assert!((z(KINDS[3].0, 40.0, 0.0) - 2.0).abs() < 1e-12);
    assert!((z(KINDS[4].0, 40.0, 50.0) - 10.0).abs() < 1e-12);
    assert!((z(KINDS[5].0, 1.0, 2.0) - 50.0).abs() < 1e-12);
    assert!((z(KINDS[6].0, 0.0, 0.0) - 50.0).abs() < 1e-12);
    assert!(build("kind = 'free'").unwrap().height(0.0, 0.0).is_none());
    assert_eq!(build("kind = 'free'").unwrap().project([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
}

#[test]
fn points_below_a_half_sphere_or_a_vault_go_to_its_rim() {
    let sphere = build("kind = 'sphere'\ncenter_m = [0, 0, 0]\nradius_m = 5").unwrap();
    assert_eq!(sphere.project([3.0, 0.0, -4.0]), [5.0, 0.0, 0.0]);
    assert_eq!(sphere.project([0.0, 0.0, 0.0]), [0.0, 0.0, 5.0]);
    assert!(sphere.height(5.1, 0.0).is_none());
    let vault = build("kind = 'cylinder'\ncenter_m = [0, 0, 1]\nradius_m = 5").unwrap();
    assert_eq!(vault.project([7.0, 2.0, -4.0]), [7.0, 5.0, 1.0]);
}

#[test]
fn wrong_surfaces_are_refused() {
    for (text, part) in [
        ("kind = 'paraboloid'\nhalf_spans_m = [0, 1]\nrise_m = 1", "half_spans_m must be a positive"),
        ("kind = 'sphere'\ncenter_m = [0, 0, nan]\nradius_m = 1", "center_m must be finite"),
        ("kind = 'sphere'\ncenter_m = [0, 0, 0]\nradius_m = -1", "radius_m must be a positive"),
        ("kind = 'cylinder'\ncenter_m = [0, 0, 0]\nradius_m = inf", "radius_m must be a positive"),
        ("kind = 'plane'\nz_m = nan", "z_m must be finite"),
        ("kind = 'height'\nexpression = 'x + radius'", "surface.expression, column 5: unknown name `radius`"),
        ("kind = 'mesh'\nfile = 'nowhere.obj'", "nowhere.obj"),
        ("kind = 'mesh'\nfile = 'broken.obj'", "broken.obj:4: vertex 7 does not exist"),
        ("kind = 'mesh'\nfile = 'pentagon.obj'", "pentagon.obj:7: the face has 5 vertices"),
        ("kind = 'mesh'\nfile = 'twice.obj'", "twice.obj:5: the face names vertex 1 twice"),
        ("kind = 'mesh'\nfile = 'empty.obj'", "no face"),
    ] {
        let error = build(text).err().unwrap_or_else(|| panic!("accepted: {text}"));
        assert!(error.contains(part), "{text}\n{error}\n{part}");
    }
}

#[test]
fn expressions_that_fail_inside_the_domain() {
    let params: DomainParams =
        toml::from_str("[[loop]]\nkind = 'polyline'\npoints_m = [[-4, -4], [4, -4], [4, 4], [-4, 4]]")
            .unwrap();
    for (expression, part) in [
        ("sqrt(x)", "no finite height at (-4"),
        ("ln(x^2 + y^2 - 1)", "`ln(x^2 + y^2 - 1)` gives no finite number"),
    ] {
        let s = build(&format!("kind = 'height'\nexpression = '{expression}'")).unwrap();
        let error = Domain::resolve(&params, &s, &Inputs::default()).err().unwrap().to_string();
        assert!(error.contains(part), "{error}");
    }
    let small = build("kind = 'mesh'\nfile = 'hypar.obj'").unwrap();
    let far: DomainParams =
        toml::from_str("[[loop]]\nkind = 'circle'\ncenter_m = [40, 40]\nradius_m = 30").unwrap();
    let error = Domain::resolve(&far, &small, &Inputs::default()).err().unwrap().to_string();
    assert!(
        error.contains("does not cover") && error.contains("the mesh lies within x -60 to 60"),
        "{error}"
    );
}
