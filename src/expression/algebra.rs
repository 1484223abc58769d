//! What formulas of surfaces that are written once for numbers, for numbers with derivatives and for batches need.

use crate::simd::Vector;
use pulp::Simd;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number to calculate with.
pub trait Algebra:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A constant among numbers like this.
    fn constant(self, value: f64) -> Self;

    /// 1 − self.
    #[inline(always)]
    fn complement(self) -> Self {
        -self + 1.0
    }

    /// √self; at 0 its derivative is taken as 0.
    fn sqrt(self) -> Self;

    /// 1 / (2 self), 0 at 0: the derivative of a root, by the root.
    fn half_over(self) -> Self;

    /// e^self for −700 ≤ self ≤ 700, see [`exp_bounded`].
    fn exp_bounded(self) -> Self;
}

impl Algebra for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn half_over(self) -> Self {
        if self > 0.0 { 0.5 / self } else { 0.0 }
    }

    #[inline(always)]
    fn exp_bounded(self) -> Self {
        exp_bounded(self)
    }
}

impl<S: Simd> Algebra for Vector<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Vector::constant(self, value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Vector::sqrt(self)
    }

    #[inline(always)]
    fn half_over(self) -> Self {
        let none = self.constant(0.0);
        self.where_positive(self.constant(0.5) / self.where_positive(self, self.constant(1.0)), none)
    }

    #[inline(always)]
    fn exp_bounded(self) -> Self {
        exponential(self, |shifted| shifted.map(power_of_two))
    }
}

/// e^x for −700 ≤ x ≤ 700, to one unit in the last place; beyond, anything.
#[inline(always)]
fn exp_bounded(x: f64) -> f64 {
    exponential(x, power_of_two)
}

/// x = k ln 2 + r with whole k, e^r by its series to the 13th power. Without branches, calls and tables, so that it can be done in
/// vectors, and of IEEE operations only, so that every machine gives the same bits.
#[inline(always)]
fn exponential<T: Algebra>(x: T, power_of_two: impl Fn(T) -> T) -> T {
    /// ln 2 in two parts, the first with so few bits that k times it is exact (Cody, Waite 1980).
    const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
    const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let r = (x - k * LN2_HIGH) - k * LN2_LOW;
    let mut sum = x.constant(1.0 / 6_227_020_800.0);
    for factor in INVERSE_FACTORIALS {
        sum = sum * r + factor;
    }
    // 1 + (r + r² …) keeps the last bit that 1 + r (1 + …) would round away.
    (r + r * r * sum + 1.0) * power_of_two(shifted)
}

/// Added to a number below 2⁵¹ it leaves the nearest whole number in the last bits: 1.5 · 2⁵².
const ROUND: f64 = 6_755_399_441_055_744.0;

/// 2^k of k + [`ROUND`].
#[inline(always)]
fn power_of_two(shifted: f64) -> f64 {
    f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}

/// 1/12! … 1/2!.
const INVERSE_FACTORIALS: [f64; 11] = [
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponentials_are_right_to_the_last_place() {
        for i in -70_000..=70_000 {
            let x = f64::from(i) * 0.009_999_7;
            let (found, expected) = (exp_bounded(x), libm::exp(x));
            assert!(
                (found - expected).abs() <= 1.0 * f64::EPSILON * expected,
                "e^{x}: {found:e} {expected:e}"
            );
        }
        assert_eq!(exp_bounded(0.0), 1.0);
    }
}
