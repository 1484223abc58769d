//! Random domains of the kinds that people draw, in any position: for tests of what must hold on all of them.

use quadrille::domain::params::{CornerRule, Corners};
use quadrille::domain::{Domain, DomainParams, LoopParams};
use quadrille::io::Inputs;
use quadrille::random::{self, Rng};
use quadrille::surface::{self, SurfaceParams};
use std::f64::consts::{PI, TAU};

/// The kinds of [`outline`].
pub const KINDS: [&str; 15] = [
    "l",
    "t",
    "plus",
    "u",
    "h",
    "disc",
    "ring",
    "ellipse",
    "trefoil",
    "lobes",
    "bean",
    "star",
    "fillet",
    "rounded",
    "eccentric",
];

/// Turned about the origin, mirrored in x first, scaled, then moved.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    pub turn_deg: f64,
    pub mirrored: bool,
    pub scale: f64,
    pub shift: [f64; 2],
}

/// As drawn.
pub const AS_DRAWN: Pose = Pose { turn_deg: 0.0, mirrored: false, scale: 1.0, shift: [0.0, 0.0] };

impl Pose {
    fn apply(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let x = if self.mirrored { -x } else { x };
        // Quarter turns are exact.
        let quarters = (self.turn_deg / 90.0).round();
        let rest = (self.turn_deg - 90.0 * quarters).to_radians();
        let (mut p, (sin, cos)) = ([x, y], rest.sin_cos());
        if rest != 0.0 {
            p = [cos * x - sin * y, sin * x + cos * y];
        }
        for _ in 0..quarters.rem_euclid(4.0) as usize {
            p = [-p[1], p[0]];
        }
        [self.scale * p[0] + self.shift[0], self.scale * p[1] + self.shift[1]]
    }

    fn of(&self, given: &LoopParams) -> LoopParams {
        let moved = |p: &[f64]| self.apply([p[0], p[1]]).to_vec();
        match given {
            LoopParams::Polyline { points_m, corners, corner_angle_deg } => LoopParams::Polyline {
                points_m: points_m.iter().map(|p| moved(p)).collect(),
                corners: corners.clone(),
                corner_angle_deg: *corner_angle_deg,
            },
            LoopParams::Circle { center_m, radius_m } => {
                LoopParams::Circle { center_m: moved(center_m), radius_m: self.scale * radius_m }
            }
            LoopParams::Ellipse { center_m, semi_axes_m, rotation_deg } => LoopParams::Ellipse {
                center_m: moved(center_m),
                semi_axes_m: semi_axes_m.map(|a| self.scale * a),
                rotation_deg: self.turn_deg + if self.mirrored { -rotation_deg } else { *rotation_deg },
            },
            LoopParams::Obj { .. } => given.clone(),
        }
    }
}

/// A domain on the plane, in a pose; its mark is carried along.
pub fn posed(loops: &[LoopParams], pose: Pose) -> Option<Domain> {
    let resolve = |loops: Vec<LoopParams>, mark_m| {
        let plane = surface::build(&SurfaceParams::Plane { z_m: 0.0 }, &Inputs::default()).ok()?;
        let params = DomainParams { symmetries: Vec::new(), mark_m, loops };
        Domain::resolve(&params, &plane, &Inputs::default()).ok()
    };
    let drawn = resolve(loops.to_vec(), None)?;
    let mark = drawn.mark().map(|s| {
        let [x, y, _] = drawn.loops[0].point(s);
        pose.apply([x, y])
    });
    resolve(loops.iter().map(|l| pose.of(l)).collect(), mark)
}

fn polyline(points: &[[f64; 2]]) -> LoopParams {
    LoopParams::Polyline {
        points_m: points.iter().map(|p| p.to_vec()).collect(),
        corners: Corners::Rule(CornerRule::All),
        corner_angle_deg: 30.0,
    }
}

/// A smooth outline r(t) drawn with 200 points.
fn smooth(radius: impl Fn(f64) -> f64) -> LoopParams {
    let point = |k: i32| {
        let t = TAU * f64::from(k) / 200.0;
        vec![radius(t) * t.cos(), radius(t) * t.sin()]
    };
    LoopParams::Polyline {
        points_m: (0..200).map(point).collect(),
        corners: Corners::Indices(Vec::new()),
        corner_angle_deg: 30.0,
    }
}

/// A circle, an ellipse or a rectangle, turned, that fits in a disc.
fn opening(rng: &mut Rng, [x, y]: [f64; 2], radius: f64) -> LoopParams {
    let turn = 180.0 * random::unit(rng);
    let slim = 0.5 + 0.5 * random::unit(rng);
    match random::below(rng, 3) {
        0 => LoopParams::Circle { center_m: vec![x, y], radius_m: radius },
        1 => LoopParams::Ellipse {
            center_m: vec![x, y],
            semi_axes_m: [radius, slim * radius],
            rotation_deg: turn,
        },
        _ => {
            let turn = if turn < 90.0 { 0.0 } else { turn.to_radians() };
            let (a, b) = (0.8 * radius, 0.6 * slim * radius);
            let at =
                |[u, v]: [f64; 2]| [x + u * turn.cos() - v * turn.sin(), y + u * turn.sin() + v * turn.cos()];
            polyline(&[[-a, -b], [a, -b], [a, b], [-a, b]].map(at))
        }
    }
}

/// A polygon whose corners are rounded with the given radius by so many points each.
fn rounded(points: &[[f64; 2]], radius: f64, steps: usize, corners: Corners) -> LoopParams {
    let n = points.len();
    let mut out = Vec::new();
    for i in 0..n {
        let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
        let unit = |p: [f64; 2], q: [f64; 2]| {
            let l = (q[0] - p[0]).hypot(q[1] - p[1]);
            [(q[0] - p[0]) / l, (q[1] - p[1]) / l]
        };
        let (u, v) = (unit(b, a), unit(b, c));
        // Right angles only: the arc's centre lies on both legs' normals.
        let center = [b[0] + radius * (u[0] + v[0]), b[1] + radius * (u[1] + v[1])];
        for k in 0..=steps {
            let t = 0.5 * PI * k as f64 / steps as f64;
            out.push(vec![
                center[0] - radius * (v[0] * t.cos() + u[0] * t.sin()),
                center[1] - radius * (v[1] * t.cos() + u[1] * t.sin()),
            ]);
        }
    }
    LoopParams::Polyline { points_m: out, corners, corner_angle_deg: 30.0 }
}

/// Loops of a domain of a kind: sizes and openings by chance.
pub fn drawn(kind: &str, rng: &mut Rng) -> Vec<LoopParams> {
    let [a, b, c, d]: [f64; 4] = std::array::from_fn(|_| random::unit(rng));
    let (w, v) = (8.0 + 10.0 * a, 8.0 + 10.0 * b);
    let (l, m) = (10.0 + 10.0 * c, 10.0 + 10.0 * d);
    let none = || Corners::Indices(Vec::new());
    // Outline and the places where an opening has room, with how much.
    let (outline, rooms): (LoopParams, Vec<([f64; 2], f64)>) = match kind {
        "l" => (
            polyline(&[[0., 0.], [w + l, 0.], [w + l, v], [w, v], [w, v + m], [0., v + m]]),
            vec![
                ([w + 0.5 * l, 0.5 * v], v.min(l)),
                ([0.5 * w, v + 0.5 * m], w.min(m)),
                ([0.5 * w, 0.5 * v], w.min(v)),
            ],
        ),
        "t" => (
            polyline(&[[-l, 0.], [w + m, 0.], [w + m, v], [w, v], [w, v + l], [0., v + l], [0., v], [-l, v]]),
            vec![
                ([-0.5 * l, 0.5 * v], v.min(l)),
                ([w + 0.5 * m, 0.5 * v], v.min(m)),
                ([0.5 * w, v + 0.5 * l], w.min(l)),
            ],
        ),
        "plus" => (
            polyline(&[
                [0., -l],
                [w, -l],
                [w, 0.],
                [w + m, 0.],
                [w + m, v],
                [w, v],
                [w, v + m],
                [0., v + m],
                [0., v],
                [-l, v],
                [-l, 0.],
                [0., 0.],
            ]),
            vec![
                ([0.5 * w, -0.5 * l], w.min(l)),
                ([0.5 * w, 0.5 * v], w.min(v)),
                ([-0.5 * l, 0.5 * v], v.min(l)),
            ],
        ),
        "u" => (
            polyline(&[
                [0., 0.],
                [2. * w + l, 0.],
                [2. * w + l, v + m],
                [w + l, v + m],
                [w + l, v],
                [w, v],
                [w, v + m],
                [0., v + m],
            ]),
            vec![
                ([0.5 * w, v + 0.5 * m], w.min(m)),
                ([w + 0.5 * l, 0.5 * v], v.min(l)),
                ([1.5 * w + l, 0.5 * v], v.min(w)),
            ],
        ),
        "h" => (
            polyline(&[
                [0., 0.],
                [w, 0.],
                [w, m],
                [w + l, m],
                [w + l, 0.],
                [2. * w + l, 0.],
                [2. * w + l, 2. * m + v],
                [w + l, 2. * m + v],
                [w + l, m + v],
                [w, m + v],
                [w, 2. * m + v],
                [0., 2. * m + v],
            ]),
            vec![
                ([0.5 * w, 0.5 * m], w.min(m)),
                ([w + 0.5 * l, m + 0.5 * v], v.min(l)),
                ([1.5 * w + l, m + 0.5 * v], v.min(w)),
            ],
        ),
        "disc" => (
            LoopParams::Circle { center_m: vec![0.0, 0.0], radius_m: 12.0 },
            vec![([-5.0, 1.0], 7.0), ([4.0, 5.0], 7.0), ([4.0, -5.0], 7.0)],
        ),
        "ring" => {
            let hole = opening(rng, [0.0, 0.0], 3.0 + 5.0 * b);
            return vec![LoopParams::Circle { center_m: vec![0.0, 0.0], radius_m: 10.0 + 5.0 * a }, hole];
        }
        "eccentric" => {
            let hole = opening(rng, [3.0 * c, 2.0 * d], 3.0 + 3.0 * b);
            return vec![polyline(&[[-w, -v], [w, -v], [w, v], [-w, v]]), hole];
        }
        "ellipse" => (
            LoopParams::Ellipse {
                center_m: vec![0.0, 0.0],
                semi_axes_m: [20.0, 5.0 + 8.0 * a],
                rotation_deg: 0.0,
            },
            vec![([-9.0, 0.0], 5.0), ([9.0, 0.0], 5.0)],
        ),
        "trefoil" => (smooth(|t| 7.0 + (2.0 + 2.5 * a) * (3.0 * t).cos()), vec![([0.0, 0.0], 2.0)]),
        "lobes" => {
            let n = 4.0 + random::below(rng, 2) as f64;
            (smooth(|t| 9.0 + (2.0 + 3.0 * a) * (n * t).cos()), vec![([0.0, 0.0], 3.0)])
        }
        "bean" => (
            smooth(|t| 8.0 + (1.0 + 2.0 * a) * t.cos() + (1.0 + 2.0 * b) * (2.0 * t).cos()),
            vec![([0.0, 0.0], 3.0)],
        ),
        "star" => {
            let n = 4 + random::below(rng, 5);
            let inner = 0.35 + 0.4 * a;
            let point = |k: usize| {
                let (t, r) =
                    (PI * k as f64 / n as f64, if k.is_multiple_of(2) { 15.0 } else { 15.0 * inner });
                [r * t.cos(), r * t.sin()]
            };
            (polyline(&(0..2 * n).map(point).collect::<Vec<_>>()), vec![([0.0, 0.0], 4.0)])
        }
        "fillet" => (
            rounded(
                &[[0., 0.], [w + l, 0.], [w + l, v], [w, v], [w, v + m], [0., v + m]],
                0.001,
                4,
                Corners::Indices((0..6).map(|i| 5 * i + 2).collect()),
            ),
            vec![([w + 0.5 * l, 0.5 * v], v.min(l)), ([0.5 * w, v + 0.5 * m], w.min(m))],
        ),
        _ => (
            rounded(&[[0., 0.], [2. * w, 0.], [2. * w, v], [0., v]], 0.3 * v.min(w), 16, none()),
            vec![([0.5 * w, 0.5 * v], v.min(w)), ([1.5 * w, 0.5 * v], v.min(w))],
        ),
    };
    let holes = random::below(rng, rooms.len() + 1);
    let openings = rooms[..holes].iter().map(|&(at, room)| {
        let share = 0.2 + 0.2 * random::unit(rng);
        opening(rng, at, share * room)
    });
    std::iter::once(outline).chain(openings).collect()
}
