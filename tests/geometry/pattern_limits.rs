//! Limits of a pattern that can be built (docs/reference/geometry.md §2.6): edges, every corner of every panel, valences, vertices at one
//! place.

use quadrille::config::ResolvedConfig;
use quadrille::domain::{Domain, DomainParams};
use quadrille::geometry::check::check;
use quadrille::geometry::dense::Edges;
use quadrille::geometry::limits::{Extremes, LimitExcess, Limits, excesses};
use quadrille::geometry::metrics::{panel_skewness, smallest_angle};
use quadrille::geometry::params::LimitParams;
use quadrille::geometry::{Panel, Pattern, PatternParams, Rejection};
use quadrille::io::Inputs;
use quadrille::study::{Design, Effort, Study};
use quadrille::surface::{self, Surface, SurfaceParams};
use std::path::Path;
use std::sync::Arc;

fn square(side: f64) -> (Domain, Arc<dyn Surface>) {
    let surface = surface::build(&SurfaceParams::Plane { z_m: 0.0 }, &Inputs::default()).unwrap();
    let text = format!(
        "[[loop]]\nkind = 'polyline'\npoints_m = [[0, 0], [{side}, 0], [{side}, {side}], [0, {side}]]"
    );
    let params: DomainParams = toml::from_str(&text).unwrap();
    (Domain::resolve(&params, &surface, &Inputs::default()).unwrap(), surface)
}

/// A pattern of one loop with t = 1 m.
fn pattern(positions: Vec<[f64; 3]>, quads: &[[u32; 4]], outline: Vec<u32>) -> Pattern {
    let panels: Vec<Panel> = quads.iter().map(|&quad| Panel::quad(quad)).collect();
    Pattern {
        edges: Edges::of(positions.len(), &panels).list,
        coarse: (0..positions.len() as u32).collect(),
        coarse_face: vec![0; panels.len()],
        positions,
        panels,
        loops: vec![outline],
        along: Vec::new(),
        corners: Vec::new(),
        loop_corners: std::iter::once(0..0).collect(),
        target_length: 1.0,
    }
}

/// Two panels of a square of 2 m about the inner vertex 4, which has two edges.
fn two_about_a_vertex(middle: [f64; 3]) -> Pattern {
    let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    let positions = corners.into_iter().chain([middle]).collect();
    pattern(positions, &[[0, 1, 2, 4], [2, 3, 0, 4]], vec![0, 1, 2, 3])
}

fn row<'a>(rows: &'a [LimitExcess], name: &str) -> Option<&'a LimitExcess> {
    rows.iter().find(|row| row.name == name)
}

#[test]
fn defaults_follow_the_target_length() {
    let limits = Limits::of(&LimitParams::default(), 2.0);
    assert_eq!((limits.min_edge, limits.max_edge, limits.max_gap), (0.5, 4.0, 0.5));
    assert_eq!((limits.max_valence, limits.min_valence, limits.max_panel_area), (8, 2, None));
    assert!((limits.min_angle.to_degrees() - 20.0).abs() < 1e-12);
    let given = LimitParams { min_edge_m: Some(0.3), max_boundary_gap_m: Some(0.1), ..Default::default() };
    let limits = Limits::of(&given, 2.0);
    assert_eq!((limits.min_edge, limits.max_gap), (0.3, 0.1));
    let (domain, _) = square(6.0);
    assert_eq!(PatternParams { panels: 9, ..Default::default() }.target_length(&domain), 2.0);
}

/// An arm without length makes an angle of 0, whatever the signs of the other: its products with −0 once made 180° of it.
#[test]
fn a_corner_with_an_arm_of_no_length_has_no_angle() {
    for [x, y] in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]] {
        // Vertices 2 and 3 are at one place.
        let corners = [[0.0; 3], [x, 0.0, -0.5], [x, y, -0.5], [x, y, -0.5]];
        let quad = if x * y > 0.0 { [0, 1, 2, 3] } else { [3, 2, 1, 0] };
        let folded = pattern(corners.to_vec(), &[quad], vec![0, 1, 2, 3]);
        assert_eq!(smallest_angle(&folded), 0.0, "{x} {y}");
        assert_eq!(panel_skewness(&corners), 1.0);
        let (domain, _) = square(2.0);
        let rows = excesses(&Extremes::of(&folded, &domain), &Limits::of(&LimitParams::default(), 1.0));
        assert_eq!(row(&rows, "min_angle_deg").unwrap().excess, 1.0);
        assert_eq!(row(&rows, "min_edge_m").unwrap().excess, 1.0);
    }
}

#[test]
fn nodes_with_two_members_are_refused_where_asked_for() {
    let (domain, _) = square(2.0);
    let found = Extremes::of(&two_about_a_vertex([1.0, 1.0, 0.0]), &domain);
    assert_eq!(found.valence_min, Some(2));
    let of = |min_valence| {
        let limits = Limits::of(&LimitParams { min_valence, ..Default::default() }, 1.0);
        excesses(&found, &limits)
    };
    assert_eq!(row(&of(2), "min_valence"), None);
    let three = of(3);
    let broken = row(&three, "min_valence").unwrap();
    assert_eq!((broken.value, broken.limit), (2.0, 3.0));
    assert!((broken.excess - 1.0 / 3.0).abs() < 1e-15);
    // Boundary vertices may have two.
    let one =
        pattern(two_about_a_vertex([1.0; 3]).positions[..4].to_vec(), &[[0, 1, 2, 3]], vec![0, 1, 2, 3]);
    assert_eq!(Extremes::of(&one, &domain).valence_min, None);
}

#[test]
fn an_edge_without_length_is_refused_with_its_place() {
    let (domain, surface) = square(2.0);
    let near = two_about_a_vertex([2.0 - 4e-7, 2.0 - 3e-7, 0.0]);
    let error = check(&near, &domain, surface.as_ref()).unwrap_err();
    let Rejection::Coincident { vertices, is_edge, place, distance, pairs, .. } = error.clone() else {
        panic!("{error:?}")
    };
    assert_eq!((vertices, is_edge, pairs), ([2, 4], true, 1));
    assert!((distance - 5e-7).abs() < 1e-12 && (place[0] - 2.0).abs() < 1e-6, "{distance} {place:?}");
    assert_eq!(error.stage(), 3);
    assert_eq!(
        error.to_string(),
        "vertices 2 and 4, joined by a member, stand on one place near (2.000, 2.000, 0.000), 5.0e-7 m apart"
    );
    assert!(check(&two_about_a_vertex([2.0 - 4e-6, 2.0 - 3e-6, 0.0]), &domain, surface.as_ref()).is_ok());
}

/// A notch whose two ends touch: no edge is short.
#[test]
fn two_boundary_vertices_at_one_place_are_refused() {
    let (domain, surface) = square(2.0);
    let notch = |open: f64| {
        let positions = vec![
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 2.0, 0.0],
            [1.0 + open, 2.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 2.0, 0.0],
            [0.0, 2.0, 0.0],
        ];
        // Vertex 4 ends the notch; 0 and 4 part the L-shaped halves.
        pattern(positions, &[[0, 1, 2, 4], [4, 2, 3, 4], [0, 4, 5, 6]], vec![0, 1, 2, 3, 4, 5, 6])
    };
    let mut touching = notch(0.0);
    touching.panels[1] = Panel::triangle([4, 2, 3]);
    touching.edges = Edges::of(7, &touching.panels).list;
    let Err(Rejection::Coincident { vertices, is_edge, .. }) = check(&touching, &domain, surface.as_ref())
    else {
        panic!("accepted")
    };
    assert_eq!((vertices, is_edge), ([3, 5], false));
}

fn study(name: &str, sets: &[&str]) -> Study {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/patterns/{name}.toml"));
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let config = ResolvedConfig::open(&file, &sets).unwrap();
    Study::of(&config).unwrap()
}

fn initial(study: &Study) -> Design {
    study.develop(study.topology(&"".parse().unwrap()), Effort::Pattern).unwrap()
}

/// Re-entrant corners: smoothing lets boundary vertices slide to them, members of a tenth of a millimetre come of it, and were
/// called feasible.
#[test]
fn short_members_are_no_longer_feasible() {
    let design = initial(&study("ell", &["pattern.relax.kind=\"area\""]));
    let broken = row(&design.limits, "min_edge_m").unwrap();
    assert!(broken.value < 0.001 && broken.excess > 0.9, "{broken:?}");
    assert!((broken.limit - 0.25 * (256f64 / 300.0).sqrt()).abs() < 1e-12);
    for name in ["ell", "tee"] {
        let design = initial(&study(name, &[]));
        let broken: Vec<_> = design.limits.iter().filter(|row| row.excess > 0.0).collect();
        assert!(broken.is_empty(), "{name}: {broken:?}");
        let (gap, covered) = (design.fabrication.boundary_gap, design.fabrication.area_covered);
        assert!(gap == 0.0 && (covered - 1.0).abs() < 1e-12, "{name}: {gap} {covered}");
    }
}

/// Smoothed, one edge cuts off the tip of a slender ellipse.
#[test]
fn a_cut_off_tip_breaks_a_limit() {
    let smoothed = study("ellipse", &["pattern.relax.kind=\"area\""]);
    let design = initial(&smoothed);
    let gap = row(&design.limits, "max_boundary_gap_m").unwrap();
    assert!(gap.value > 1.0 && gap.excess > 1.0, "{gap:?}");
    assert!(design.fabrication.area_covered < 0.9, "{}", design.fabrication.area_covered);
    for design in [design, initial(&study("ellipse", &[]))] {
        let (pattern, curve) = (&design.pattern, &smoothed.domain.loops[0]);
        let outline = &pattern.loops[0];
        let place = |i: usize| pattern.positions[outline[i % outline.len()] as usize];
        let from_chord = |p: [f64; 3], i: usize| {
            let (a, b) = (place(i), place(i + 1));
            let d = [b[0] - a[0], b[1] - a[1]];
            let share = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
            let share = share.clamp(0.0, 1.0);
            (a[0] + share * d[0] - p[0]).hypot(a[1] + share * d[1] - p[1])
        };
        let farthest = (0..20_000)
            .map(|k| curve.point(curve.length() * f64::from(k) / 20_000.0))
            .map(|p| (0..outline.len()).map(|i| from_chord(p, i)).fold(f64::INFINITY, f64::min))
            .fold(0.0, f64::max);
        let found = design.fabrication.boundary_gap;
        assert!((found - farthest).abs() < 1e-3 * farthest, "{found} {farthest}");
        let plan: f64 = pattern
            .panels
            .iter()
            .map(|panel| quadrille::geometry::check::vector_area(&pattern.positions, panel)[2])
            .sum();
        assert!((design.fabrication.area_covered - plan / smoothed.domain.area()).abs() < 1e-12);
    }
}
