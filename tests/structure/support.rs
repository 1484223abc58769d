//! Patterns and models for the tests of the frame solver.
#![allow(dead_code, clippy::unwrap_used, reason = "each test file uses some of these")]

use nalgebra::{Rotation3, Vector3};
use quadrille::geometry::{Panel, Pattern};
use quadrille::random;
use quadrille::structure::model::{
    FrameParts, LoadCase, Material, Member, MemberKind, NodalLoad, Support, UniformLoad,
};
use quadrille::structure::section::Section;

/// A grid of `m` × `n` panels over a plan of `width` × `depth` m, at heights `z(x, y)`, x and y from −1 to 1.
pub fn grid_shell([m, n]: [u32; 2], [width, depth]: [f64; 2], z: impl Fn(f64, f64) -> f64) -> Pattern {
    let vertex = |i: u32, j: u32| j * (m + 1) + i;
    let mut positions = Vec::new();
    for j in 0..=n {
        for i in 0..=m {
            let (x, y) = (2.0 * f64::from(i) / f64::from(m) - 1.0, 2.0 * f64::from(j) / f64::from(n) - 1.0);
            positions.push([0.5 * width * x, 0.5 * depth * y, z(x, y)]);
        }
    }
    let mut panels = Vec::new();
    let mut edges = Vec::new();
    for j in 0..=n {
        for i in 0..=m {
            if i < m && j < n {
                panels.push(Panel::quad([
                    vertex(i, j),
                    vertex(i + 1, j),
                    vertex(i + 1, j + 1),
                    vertex(i, j + 1),
                ]));
            }
            if i < m {
                edges.push([vertex(i, j), vertex(i + 1, j)]);
            }
            if j < n {
                edges.push([vertex(i, j), vertex(i, j + 1)]);
            }
        }
    }
    edges.sort_unstable();
    let outer: Vec<u32> = (0..m)
        .map(|i| vertex(i, 0))
        .chain((0..n).map(|j| vertex(m, j)))
        .chain((1..=m).rev().map(|i| vertex(i, n)))
        .chain((1..=n).rev().map(|j| vertex(0, j)))
        .collect();
    let corners = vec![vertex(0, 0), vertex(m, 0), vertex(m, n), vertex(0, n)];
    Pattern {
        coarse: corners.clone(),
        coarse_face: vec![0; panels.len()],
        target_length: width / f64::from(m),
        positions,
        panels,
        edges,
        loops: vec![outer],
        along: Vec::new(),
        loop_corners: std::iter::once(0..4).collect(),
        corners,
    }
}

/// A shallow dome on a square plan, supported as in the paper.
pub fn dome(cells: u32, side: f64, rise: f64) -> Pattern {
    grid_shell([cells, cells], [side, side], |x, y| rise * (1.0 - x * x) * (1.0 - y * y))
}

/// A court roof: `around` × `across` panels between a circle of radius 22.245 m and a rectangle of the size of the
/// Great Court's, rising 7 m between the two.
pub fn court(around: u32, across: u32) -> Pattern {
    let vertex = |i: u32, j: u32| (i % around) * (across + 1) + j;
    let corner_angles = [
        (-51.125f64).atan2(-36.625),
        (-51.125f64).atan2(36.625),
        46.025f64.atan2(36.625),
        46.025f64.atan2(-36.625),
    ];
    // Equal steps between corners, so that every corner is a vertex.
    let quarter = around / 4;
    let angle = |i: u32| {
        let (k, t) = ((i / quarter) as usize, f64::from(i % quarter) / f64::from(quarter));
        let (a, b) = (corner_angles[k], corner_angles[(k + 1) % 4]);
        let b = if b < a { b + std::f64::consts::TAU } else { b };
        a + (b - a) * t
    };
    let wall = |angle: f64| {
        let (s, c) = angle.sin_cos();
        let across_x = 36.625 / c.abs();
        let across_y = if s > 0.0 { 46.025 / s } else { 51.125 / -s };
        across_x.min(across_y)
    };
    let mut positions = Vec::new();
    for i in 0..around {
        let a = angle(i);
        for j in 0..=across {
            let t = f64::from(j) / f64::from(across);
            let r = 22.245 + (wall(a) - 22.245) * t;
            positions.push([
                r * a.cos(),
                r * a.sin(),
                20.0 + 7.0 * 4.0 * t * (1.0 - t) * 0.5 + 0.5 * (1.0 - t),
            ]);
        }
    }
    let mut panels = Vec::new();
    let mut edges = Vec::new();
    for i in 0..around {
        for j in 0..=across {
            let (a, b) = (vertex(i, j), vertex(i + 1, j));
            edges.push([a.min(b), a.max(b)]);
            if j < across {
                edges.push([a, a + 1]);
                panels.push(Panel::quad([a, a + 1, b + 1, b]));
            }
        }
    }
    edges.sort_unstable();
    let corners: Vec<u32> = (0..4).map(|k| vertex(k * quarter, across)).collect();
    Pattern {
        coarse: corners.clone(),
        coarse_face: vec![0; panels.len()],
        target_length: 2.0,
        positions,
        panels,
        edges,
        loops: vec![
            (0..around).map(|i| vertex(i, across)).collect(),
            (0..around).map(|i| vertex(i, 0)).collect(),
        ],
        along: Vec::new(),
        loop_corners: vec![0..4, 4..4],
        corners,
    }
}

/// A braced tower of three to six storeys with random nodes, loads and sections; feet clamped.
pub fn random_tower(seed: u32) -> FrameParts {
    let rng = &mut random::stream(4, 4, seed);
    let storeys = 3 + random::below(rng, 4) as u32;
    let mut jitter = || 0.3 * (random::unit(rng) - 0.5);
    let mut nodes = Vec::new();
    for storey in 0..=storeys {
        for (x, y) in [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)] {
            nodes.push([x + jitter(), y + jitter(), 3.0 * f64::from(storey) + jitter()]);
        }
    }
    let mut members = Vec::new();
    let mut join = |a: u32, b: u32, section: u32| {
        members.push(Member { start: a, end: b, up: [0.3, 0.2, 1.0], section, kind: MemberKind::RIGID });
    };
    for storey in 0..storeys {
        let (below, above) = (4 * storey, 4 * (storey + 1));
        for k in 0..4 {
            join(below + k, above + k, 0);
            join(above + k, above + (k + 1) % 4, 1);
        }
        join(below, above + 1, 1);
    }
    let nodal = (4..nodes.len() as u32)
        .map(|node| {
            let mut load: [f64; 6] = std::array::from_fn(|_| 4e3 * (random::unit(rng) - 0.5));
            load[2] -= 2e4;
            NodalLoad { node, load }
        })
        .collect();
    FrameParts {
        nodes,
        members,
        sections: vec![
            Section::rectangular_hollow(0.1, 0.16, 0.006).unwrap(),
            Section::rectangular_hollow(0.08, 0.12, 0.005).unwrap(),
        ],
        material: steel(),
        shear_deformation: seed % 2 == 1,
        supports: (0..4).map(|node| Support::fixed(node, [true; 6])).collect(),
        load_cases: vec![LoadCase { nodal, ..LoadCase::default() }],
    }
}

fn steel() -> Material {
    Material {
        youngs_modulus: 210e9,
        shear_modulus: 80.77e9,
        density: 7850.0,
        strength: 355e6,
        thermal_expansion: 1.2e-5,
    }
}

/// The same model turned about the origin, supports clamped so that they need no turning; with the turn.
pub fn rotated(parts: &FrameParts, seed: u32) -> (FrameParts, Rotation3<f64>) {
    let turn = Rotation3::from_euler_angles(0.3 + f64::from(seed), 0.7, -1.1 * f64::from(seed));
    let turned = |v: [f64; 3]| -> [f64; 3] { (turn * Vector3::from(v)).into() };
    let mut parts = parts.clone();
    parts.nodes.iter_mut().for_each(|n| *n = turned(*n));
    parts.members.iter_mut().for_each(|m| m.up = turned(m.up));
    for load in &mut parts.load_cases[0].nodal {
        let [fx, fy, fz, mx, my, mz] = load.load;
        let (force, moment) = (turned([fx, fy, fz]), turned([mx, my, mz]));
        load.load = [force[0], force[1], force[2], moment[0], moment[1], moment[2]];
    }
    (parts, turn)
}

/// The same model with nodes and members in another order and members turned round; and where each node went.
pub fn renumbered(parts: &FrameParts, seed: u32) -> (FrameParts, Vec<usize>) {
    let rng = &mut random::stream(5, 5, seed);
    let count = parts.nodes.len();
    let mut place: Vec<usize> = (0..count).collect();
    for i in (1..count).rev() {
        place.swap(i, random::below(rng, i + 1));
    }
    let mut other = parts.clone();
    for (n, &to) in place.iter().enumerate() {
        other.nodes[to] = parts.nodes[n];
    }
    let moved = |n: u32| place[n as usize] as u32;
    for member in &mut other.members {
        (member.start, member.end) = (moved(member.end), moved(member.start));
        if let MemberKind::Beam([start, end]) = member.kind {
            member.kind = MemberKind::Beam([end, start]);
        }
    }
    other.members.reverse();
    other.supports.iter_mut().for_each(|s| s.node = moved(s.node));
    other.load_cases[0].nodal.iter_mut().for_each(|l| l.node = moved(l.node));
    (other, place)
}

/// Columns 3 m high, 2 m apart, fixed at their feet; the c-th carries 1e5 (1 + `epsilon` c) N. With `epsilon` 0 every
/// buckling factor comes 2 × `count` times.
pub fn columns(count: u32, elements: u32, epsilon: f64) -> FrameParts {
    let mut parts = FrameParts {
        nodes: Vec::new(),
        members: Vec::new(),
        sections: vec![Section {
            area: 1e-2,
            iy: 8e-6,
            iz: 8e-6,
            j: 1.4e-5,
            wy: 1e-4,
            wz: 1e-4,
            asy: 0.0,
            asz: 0.0,
            shear: None,
            shape: None,
        }],
        material: steel(),
        shear_deformation: false,
        supports: Vec::new(),
        load_cases: vec![LoadCase::default()],
    };
    for c in 0..count {
        let base = parts.nodes.len() as u32;
        let height = |k: u32| 3.0 * f64::from(k) / f64::from(elements);
        parts.nodes.extend((0..=elements).map(|k| [2.0 * f64::from(c), 0.0, height(k)]));
        parts.members.extend((0..elements).map(|k| Member {
            start: base + k,
            end: base + k + 1,
            up: [1.0, 0.0, 0.0],
            section: 0,
            kind: MemberKind::RIGID,
        }));
        parts.supports.push(Support::fixed(base, [true; 6]));
        let load = [0.0, 0.0, -1e5 * (1.0 + epsilon * f64::from(c)), 0.0, 0.0, 0.0];
        parts.load_cases[0].nodal.push(NodalLoad { node: base + elements, load });
    }
    parts
}

/// A straight member of 5 m, box 100 × 180 × 6 mm, in several elements.
pub struct Bend {
    /// Number of elements.
    pub elements: u32,
}

impl Bend {
    fn along(&self, direction: [f64; 3], up: [f64; 3], supports: Vec<Support>, case: LoadCase) -> FrameParts {
        let step = 5.0 / f64::from(self.elements);
        FrameParts {
            nodes: (0..=self.elements).map(|i| direction.map(|d| d * step * f64::from(i))).collect(),
            members: (0..self.elements)
                .map(|i| Member { start: i, end: i + 1, up, section: 0, kind: MemberKind::RIGID })
                .collect(),
            sections: vec![Section::rectangular_hollow(0.1, 0.18, 0.006).unwrap()],
            material: steel(),
            shear_deformation: false,
            supports,
            load_cases: vec![case],
        }
    }

    /// Along x, clamped at 0, uniform load `q` N/m downwards, up = z.
    pub fn cantilever(&self, q: f64) -> FrameParts {
        let uniform = (0..self.elements)
            .map(|member| UniformLoad { member, force_per_length: [0.0, 0.0, -q] })
            .collect();
        let case = LoadCase { uniform, ..LoadCase::default() };
        self.along([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], vec![Support::fixed(0, [true; 6])], case)
    }

    /// Upright, pinned at both ends, 100 kN on top; it buckles about its weak axis.
    pub fn pinned_column(&self) -> FrameParts {
        let load = NodalLoad { node: self.elements, load: [0.0, 0.0, -1e5, 0.0, 0.0, 0.0] };
        let supports = vec![
            Support::fixed(0, [true, true, true, false, false, true]),
            Support::fixed(self.elements, [true, true, false, false, false, false]),
        ];
        let case = LoadCase { nodal: vec![load], ..LoadCase::default() };
        self.along([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], supports, case)
    }

    /// Upright, clamped at the foot, `p` N down and `h` N along y on top.
    pub fn column_with_tip_load(&self, p: f64, h: f64) -> FrameParts {
        let load = NodalLoad { node: self.elements, load: [0.0, h, -p, 0.0, 0.0, 0.0] };
        let case = LoadCase { nodal: vec![load], ..LoadCase::default() };
        let foot = vec![Support::fixed(0, [true; 6])];
        self.along([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], foot, case)
    }
}
