//! Forward differentiation: one formula, written once, gives height and gradient.

use super::algebra::{Algebra, exp_bounded};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that functions of one and two arguments can be applied to by the chain rule.
pub(super) trait Real: Algebra {
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

/// A number with its derivatives by x and y.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    /// The value.
    pub(super) value: f64,
    /// ∂/∂x and ∂/∂y.
    pub(super) slope: [f64; 2],
}

impl Dual {
    /// The variables x and y themselves.
    pub(super) fn variables(x: f64, y: f64) -> [Self; 2] {
        [Self { value: x, slope: [1.0, 0.0] }, Self { value: y, slope: [0.0, 1.0] }]
    }
}

impl From<f64> for Dual {
    fn from(value: f64) -> Self {
        Self { value, slope: [0.0, 0.0] }
    }
}

impl Add for Dual {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, slope: [self.slope[0] + o.slope[0], self.slope[1] + o.slope[1]] }
    }
}

impl Sub for Dual {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, slope: [self.slope[0] - o.slope[0], self.slope[1] - o.slope[1]] }
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule")]
impl Mul for Dual {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        let by = |i: usize| self.slope[i] * o.value + self.value * o.slope[i];
        Self { value: self.value * o.value, slope: [by(0), by(1)] }
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the quotient rule")]
impl Div for Dual {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        let by = |i: usize| (self.slope[i] - value * o.slope[i]) / o.value;
        Self { value, slope: [by(0), by(1)] }
    }
}

impl Neg for Dual {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, slope: [-self.slope[0], -self.slope[1]] }
    }
}

impl Algebra for Dual {
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }

    #[inline]
    fn exp_bounded(self) -> Self {
        let e = exp_bounded(self.value);
        self.chain(e, e)
    }
}

impl Real for Dual {
    fn value(self) -> f64 {
        self.value
    }

    #[inline]
    fn chain(self, f: f64, derivative: f64) -> Self {
        Self { value: f, slope: [derivative * self.slope[0], derivative * self.slope[1]] }
    }

    fn combine(a: Self, b: Self, f: f64, [by_a, by_b]: [f64; 2]) -> Self {
        let part = |slope: f64, by: f64| if slope == 0.0 { 0.0 } else { slope * by };
        let slope = [0, 1].map(|i| part(a.slope[i], by_a) + part(b.slope[i], by_b));
        Self { value: f, slope }
    }
}
