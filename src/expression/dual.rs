//! Forward differentiation: one formula, written once, gives height and gradient.

use super::algebra::Algebra;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that functions of one and two arguments can be applied to by the chain rule.
pub trait Real: Algebra + From<f64> {
    /// The number without its derivatives.
    fn value(self) -> f64;

    /// f(self), given the value of f and of its derivative at `self.value()`.
    fn chain(self, f: f64, derivative: f64) -> Self;

    /// f(a, b), given the value of f and its two partial derivatives; one whose argument is constant may be anything.
    fn combine(a: Self, b: Self, f: f64, partials: [f64; 2]) -> Self;

    /// e^self.
    fn exp(self) -> Self {
        let e = libm::exp(self.value());
        self.chain(e, e)
    }
}

impl Real for f64 {
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn chain(self, f: f64, _derivative: f64) -> Self {
        f
    }

    #[inline]
    fn combine(_a: Self, _b: Self, f: f64, _partials: [f64; 2]) -> Self {
        f
    }
}

/// A number, or a batch of them, with the derivatives by x and y.
#[derive(Clone, Copy, Debug)]
pub struct Dual<T = f64> {
    /// The value.
    pub value: T,
    /// ∂/∂x and ∂/∂y.
    pub slope: [T; 2],
}

impl<T: Algebra> Dual<T> {
    /// The variables x and y themselves.
    #[inline(always)]
    pub fn variables(x: T, y: T) -> [Self; 2] {
        let (zero, one) = (x.constant(0.0), x.constant(1.0));
        [Self { value: x, slope: [one, zero] }, Self { value: y, slope: [zero, one] }]
    }

    /// f(self), given the value of f and of its derivative.
    #[inline(always)]
    fn mapped(self, value: T, derivative: T) -> Self {
        Self { value, slope: self.slope.map(|s| derivative * s) }
    }
}

impl From<f64> for Dual {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, slope: [0.0; 2] }
    }
}

impl<T: Algebra> Add for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, slope: [self.slope[0] + o.slope[0], self.slope[1] + o.slope[1]] }
    }
}

impl<T: Algebra> Sub for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, slope: [self.slope[0] - o.slope[0], self.slope[1] - o.slope[1]] }
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule")]
impl<T: Algebra> Mul for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let by = |i: usize| self.slope[i] * o.value + self.value * o.slope[i];
        Self { value: self.value * o.value, slope: [by(0), by(1)] }
    }
}

impl<T: Algebra> Div for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        let inverse = o.value.constant(1.0) / o.value;
        let by = |i: usize| (self.slope[i] - value * o.slope[i]) * inverse;
        Self { value, slope: [by(0), by(1)] }
    }
}

impl<T: Algebra> Add<f64> for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: f64) -> Self {
        Self { value: self.value + o, ..self }
    }
}

impl<T: Algebra> Sub<f64> for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: f64) -> Self {
        Self { value: self.value - o, ..self }
    }
}

impl<T: Algebra> Mul<f64> for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        Self { value: self.value * o, slope: self.slope.map(|s| s * o) }
    }
}

impl<T: Algebra> Neg for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, slope: [-self.slope[0], -self.slope[1]] }
    }
}

impl<T: Algebra> Algebra for Dual<T> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        let zero = self.value.constant(0.0);
        Self { value: self.value.constant(value), slope: [zero, zero] }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.mapped(root, root.half_over())
    }

    #[inline(always)]
    fn half_over(self) -> Self {
        let half = self.value.half_over();
        self.mapped(half, -(half * half + half * half))
    }

    #[inline(always)]
    fn exp_bounded(self) -> Self {
        let e = self.value.exp_bounded();
        self.mapped(e, e)
    }
}

impl Real for Dual {
    fn value(self) -> f64 {
        self.value
    }

    #[inline]
    fn chain(self, f: f64, derivative: f64) -> Self {
        self.mapped(f, derivative)
    }

    fn combine(a: Self, b: Self, f: f64, [by_a, by_b]: [f64; 2]) -> Self {
        let part = |slope: f64, by: f64| if slope == 0.0 { 0.0 } else { slope * by };
        let slope = [0, 1].map(|i| part(a.slope[i], by_a) + part(b.slope[i], by_b));
        Self { value: f, slope }
    }
}
