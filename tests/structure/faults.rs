//! Sound models that were refused, and factors that were lost: each stands for its kind.

use crate::support::columns;
use nalgebra::{Matrix2, Vector2, Vector3};
use quadrille::random::{self, Rng};
use quadrille::structure::model::{
    FrameParts, LoadCase, Material, Member, MemberKind, NodalLoad, Support, UniformLoad,
};
use quadrille::structure::section::Section;
use quadrille::structure::{FrameAnalysis, FrameError, FrameModel, FrameResult, Order, file, frame};
use std::f64::consts::{PI, TAU};

const E: f64 = 210e9;

fn analyse(parts: FrameParts, order: Order, buckling_modes: usize) -> Result<FrameResult, FrameError> {
    frame(&FrameModel::new(parts).unwrap(), &FrameAnalysis { order, buckling_modes })
}

fn factors(parts: FrameParts, modes: usize) -> Vec<f64> {
    analyse(parts, Order::First, modes).unwrap().buckling_factors
}

/// What `columns` must give: those of one column, twice for its two equal axes, over the load of each.
fn factors_of_columns(count: u32, elements: u32, epsilon: f64, modes: usize) -> Vec<f64> {
    let one = factors(columns(1, elements, 0.0), 4 * elements as usize);
    let each = (0..count).flat_map(|c| one.iter().map(move |f| f / (1.0 + epsilon * f64::from(c))));
    let mut all: Vec<f64> = each.collect();
    all.sort_by(f64::total_cmp);
    all.truncate(modes);
    all
}

fn assert_columns(count: u32, elements: u32, epsilon: f64, modes: usize) {
    let found = factors(columns(count, elements, epsilon), modes);
    let expected = factors_of_columns(count, elements, epsilon, modes);
    assert_eq!(found.len(), expected.len(), "{count} columns");
    for (k, (f, e)) in found.iter().zip(&expected).enumerate() {
        assert!((f / e - 1.0).abs() < 2e-9, "{count} columns, {elements}, {epsilon:e}: {k}: {f} for {e}");
    }
}

#[test]
fn every_factor_comes_as_often_as_it_is_repeated() {
    for (count, elements, modes) in [(26, 1, 8), (26, 1, 13), (7, 4, 20), (26, 1, 60), (5, 6, 3), (40, 3, 50)]
    {
        assert_columns(count, elements, 0.0, modes);
    }
}

#[test]
fn nearly_equal_factors_are_told_apart_and_none_lies_below_the_heaviest_columns() {
    for (count, elements, epsilon, modes) in [
        (10, 4, 1e-7, 1),
        (12, 4, 1e-5, 1),
        (10, 4, 1e-7, 25),
        (12, 4, 1e-5, 30),
        (60, 4, 1e-8, 3),
        (30, 5, 1e-3, 7),
    ] {
        assert_columns(count, elements, epsilon, modes);
    }
}

#[test]
fn factors_of_other_signs_are_not_counted() {
    // Half of the columns are pulled, and harder: their factors are negative, and larger in 1/λ.
    let mut parts = columns(20, 4, 0.0);
    for load in parts.load_cases[0].nodal.iter_mut().skip(10) {
        load.load[2] = 3e7;
    }
    let found = factors(parts, 22);
    let expected = factors_of_columns(10, 4, 0.0, 22);
    assert!(found.iter().zip(&expected).all(|(f, e)| (f / e - 1.0).abs() < 1e-8), "{found:?}");
    let mut parts = columns(20, 4, 0.0);
    parts.load_cases[0].nodal.iter_mut().for_each(|load| load.load[2] = 1e5);
    assert_eq!(factors(parts, 5), Vec::<f64>::new());
}

#[test]
fn the_two_skew_cantilevers_have_their_answers() {
    let run = |text: &str| {
        let (model, analysis) = file::read(text).unwrap();
        frame(&model, &analysis).unwrap()
    };
    let moment = run(include_str!("../data/frame_faults/skew_cantilever_moment.json"));
    let u = moment.displacements[1];
    for (got, want) in u.iter().zip([-0.022686, 0.034029, 0.0]) {
        assert!((got - want).abs() < 1e-6, "{u:?}");
    }
    assert_eq!(moment.buckling_factors, Vec::<f64>::new());
    assert_eq!(moment.remarks().len(), 1);
    let gravity = run(include_str!("../data/frame_faults/skew_cantilever_gravity.json"));
    assert!((gravity.displacements[1][2] + 0.347800).abs() < 1e-6, "{:?}", gravity.displacements[1]);
    assert!(gravity.remarks().is_empty());
}

/// A cantilever of one element in any direction, its loads at the tip in local axes, and its bending by hand: N is
/// known from statics, so that second order is two equations a plane.
struct Skew {
    parts: FrameParts,
    axes: [Vector3<f64>; 3],
    length: f64,
    stiffness: f64,
    /// Forces and moments at the tip, those of the member load included, local.
    tip: [f64; 6],
}

fn direction(rng: &mut Rng) -> Vector3<f64> {
    let (z, angle) = (2.0 * random::unit(rng) - 1.0, TAU * random::unit(rng));
    let r = (1.0 - z * z).sqrt();
    Vector3::new(r * angle.cos(), r * angle.sin(), z)
}

impl Skew {
    fn random(seed: u32, scale: f64) -> Self {
        let rng = &mut random::stream(15, 5, seed);
        let x = if seed.is_multiple_of(10) { Vector3::x() } else { direction(rng) };
        let y = direction(rng).cross(&x).normalize();
        let z = x.cross(&y);
        let length = 10f64.powf(2.0 * random::unit(rng) - 0.5);
        let diameter = length / 10f64.powf(1.0 + 2.0 * random::unit(rng));
        let section = Section::round(diameter).unwrap();
        let critical = PI * PI * E * section.iy / (4.0 * length * length);
        let mut force = Vector3::zeros();
        let mut moment = Vector3::zeros();
        let mut load = Vector3::zeros();
        match seed % 5 {
            0 => moment = direction(rng) * (0.1 * critical * length),
            1 => force = direction(rng) * (0.3 * critical),
            2 => load = direction(rng) * (0.5 * critical / length),
            3 => {
                let any = direction(rng);
                force = (any - x * x.dot(&any)) * (0.3 * critical);
            }
            _ => {
                force = direction(rng) * (0.15 * critical);
                moment = direction(rng) * (0.1 * critical * length);
                load = direction(rng) * (0.2 * critical / length);
            }
        }
        let (force, moment, load) = (force * scale, moment * scale, load * scale);
        let nodal = NodalLoad { node: 1, load: [force.x, force.y, force.z, moment.x, moment.y, moment.z] };
        let uniform = UniformLoad { member: 0, force_per_length: load.into() };
        let material = Material {
            youngs_modulus: E,
            shear_modulus: 80e9,
            density: 0.0,
            strength: 235e6,
            thermal_expansion: 1.2e-5,
        };
        let parts = FrameParts {
            nodes: vec![[0.0; 3], (x * length).into()],
            members: vec![Member { start: 0, end: 1, up: z.into(), section: 0, kind: MemberKind::RIGID }],
            sections: vec![section],
            material,
            shear_deformation: false,
            supports: vec![Support::fixed(0, [true; 6])],
            load_cases: vec![LoadCase { nodal: vec![nodal], uniform: vec![uniform], ..LoadCase::default() }],
        };
        let local = |v: &Vector3<f64>| [x.dot(v), y.dot(v), z.dot(v)];
        let ([fx, fy, fz], [mx, my, mz], [qx, qy, qz]) = (local(&force), local(&moment), local(&load));
        let (half, twelfth) = (0.5 * length, length * length / 12.0);
        let tip = [fx + qx * half, fy + qy * half, fz + qz * half, mx, my + qz * twelfth, mz - qy * twelfth];
        Self { parts, axes: [x, y, z], length, stiffness: E * section.iy, tip }
    }

    /// K + s N Kg of one plane, for deflection and slope at the tip.
    fn matrix(&self, s: f64) -> Matrix2<f64> {
        let (l, b) = (self.length, self.stiffness / self.length.powi(3));
        let n = s * self.tip[0];
        Matrix2::new(
            12.0 * b + 1.2 * n / l,
            -6.0 * b * l - 0.1 * n,
            -6.0 * b * l - 0.1 * n,
            4.0 * b * l * l + 2.0 * n * l / 15.0,
        )
    }

    /// The first buckling factor; infinite under tension. EI times 2.4860 / L² is that of one element.
    fn factor(&self) -> f64 {
        if self.tip[0] >= 0.0 {
            return f64::INFINITY;
        }
        // det(K + s N Kg) = 0, a quadratic in p = −s N L² / EI: (12 − 1.2 p)(4 − 2p/15) = (6 − 0.1 p)².
        let (a, b, c): (f64, f64, f64) = (0.16 - 0.01, -(1.6 + 4.8) + 1.2, 48.0 - 36.0);
        let p = (-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
        p * self.stiffness / (self.length.powi(2) * -self.tip[0])
    }

    /// Displacement of the tip across, local y and z.
    fn across(&self) -> [f64; 2] {
        let inverse = self.matrix(1.0).try_inverse().unwrap();
        let [_, fy, fz, _, my, mz] = self.tip;
        [(inverse * Vector2::new(fy, mz)).x, (inverse * Vector2::new(fz, -my)).x]
    }
}

#[test]
fn a_cantilever_in_any_direction_is_answered_below_its_critical_load_and_refused_beyond() {
    let mut refused = 0;
    for seed in 0..160 {
        let whole = Skew::random(seed, 1.0);
        let factor = whole.factor();
        let scale = if factor.is_finite() { (0.3 * factor).min(1.0) } else { 1.0 };
        let skew = Skew::random(seed, scale);
        let result = analyse(skew.parts.clone(), Order::Second, 1)
            .unwrap_or_else(|error| panic!("seed {seed}: {error} (factor {})", skew.factor()));
        let u = Vector3::from_column_slice(&result.displacements[1][..3]);
        let want = skew.across();
        let size = want[0].hypot(want[1]) + 1e-9 * skew.length;
        for (axis, want) in skew.axes[1..].iter().zip(want) {
            assert!((u.dot(axis) - want).abs() < 1e-8 * size, "seed {seed}: {} for {want}", u.dot(axis));
        }
        if let Some(found) = result.buckling_factors.first().filter(|_| skew.factor() < 1e6) {
            assert!((found / skew.factor() - 1.0).abs() < 1e-7, "seed {seed}: {found} for {}", skew.factor());
        }
        if factor < 1e4 {
            for beyond in [1.005, 1.5, 40.0] {
                let parts = Skew::random(seed, beyond * factor).parts;
                let answer = analyse(parts, Order::Second, 0);
                assert!(matches!(answer, Err(FrameError::Unstable(_))), "seed {seed}, {beyond}: {answer:?}");
            }
            let near = analyse(Skew::random(seed, 0.995 * factor).parts, Order::Second, 0);
            assert!(near.is_ok(), "seed {seed}, just below: {near:?}");
            refused += 1;
        }
    }
    assert!(refused > 30, "{refused} of them can buckle");
}

/// A beam of 10 m along x in `count` elements.
fn chain(count: u32, supports: Vec<Support>, loaded: u32) -> FrameParts {
    let step = 10.0 / f64::from(count);
    let load = NodalLoad { node: loaded, load: [0.0, 0.0, -1e3, 0.0, 0.0, 0.0] };
    FrameParts {
        nodes: (0..=count).map(|i| [step * f64::from(i), 0.0, 0.0]).collect(),
        members: (0..count)
            .map(|i| Member {
                start: i,
                end: i + 1,
                up: [0.0, 0.0, 1.0],
                section: 0,
                kind: MemberKind::RIGID,
            })
            .collect(),
        sections: vec![Section::rectangular_hollow(0.1, 0.18, 0.006).unwrap()],
        material: Material {
            youngs_modulus: E,
            shear_modulus: 80e9,
            density: 0.0,
            strength: 235e6,
            thermal_expansion: 1.2e-5,
        },
        shear_deformation: false,
        supports,
        load_cases: vec![LoadCase { nodal: vec![load], ..LoadCase::default() }],
    }
}

#[test]
fn a_chain_of_twenty_thousand_elements_is_no_mechanism() {
    for (count, tolerance) in [(2_000u32, 1e-6), (20_000, 1e-4)] {
        let clamped = chain(count, vec![Support::fixed(0, [true; 6])], count);
        let bent = 1e3 * 1e3 / (E * clamped.sections[0].iy);
        let ends = vec![
            Support::fixed(0, [true, true, true, true, false, false]),
            Support::fixed(count, [false, true, true, false, false, false]),
        ];
        for (parts, at, share) in [(clamped, count, 3.0), (chain(count, ends, count / 2), count / 2, 48.0)] {
            let sinks = -analyse(parts, Order::First, 0).unwrap().displacements[at as usize][2];
            assert!((sinks * share / bent - 1.0).abs() < tolerance, "{count}: {sinks} for {}", bent / share);
        }
    }
}

#[test]
fn a_part_that_no_support_holds_is_a_mechanism_however_long() {
    let chain = |fixed: [bool; 6]| {
        let mut parts = columns(1, 5_000, 0.0);
        parts.supports = vec![Support::fixed(0, fixed), Support::fixed(5_000, fixed)];
        analyse(parts, Order::First, 0)
    };
    let pinned = [true, true, true, false, false, false];
    // Pinned at both ends it still turns about itself.
    assert!(matches!(chain(pinned), Err(FrameError::Singular(_))));
    let Err(FrameError::Singular(motion)) = chain([true, false, true, true, true, true]) else {
        panic!("must be a mechanism")
    };
    assert_eq!(motion.direction.name(), "uy");
}
