//! The widest vectors of the processor at hand: for plain loops ([`wide`]), and spelled out ([`Vector`]) where the compiler does not
//! find them itself.

use pulp::{Simd, WithSimd, bytemuck};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Most numbers in a [`Vector`].
const MOST_LANES: usize = 8;

/// Runs `f` compiled for the processor's own vector instructions, chosen when the program runs. `f` must be inlined
/// (`#[inline(always)]`), with all it calls, to gain by it. Nothing is reassociated or fused: the result is the same
/// to the bit on every processor.
pub fn wide<R>(f: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(f)
}

/// The same for work that is written with [`Vector`]s.
pub fn with_vectors<K: WithSimd>(kernel: K) -> K::Output {
    pulp::Arch::new().dispatch(kernel)
}

/// As many numbers as the processor takes at once, each going through the IEEE operations that a single number would: the bits are those
/// of a loop, however many lanes there are.
#[derive(Clone, Copy)]
pub struct Vector<S: Simd> {
    simd: S,
    lanes: S::f64s,
}

impl<S: Simd> Vector<S> {
    /// Numbers in it.
    pub const LANES: usize = S::F64_LANES;

    /// The same number in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, lanes: simd.splat_f64s(value) }
    }

    /// The number of each lane.
    #[inline(always)]
    pub fn of(simd: S, lane: impl Fn(usize) -> f64) -> Self {
        let mut numbers = [0.0; MOST_LANES];
        for (l, number) in numbers[..Self::LANES].iter_mut().enumerate() {
            *number = lane(l);
        }
        Self { simd, lanes: bytemuck::pod_read_unaligned(bytemuck::cast_slice(&numbers[..Self::LANES])) }
    }

    /// A number in all lanes, like these.
    #[inline(always)]
    pub fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// The lanes.
    #[inline(always)]
    pub fn numbers(&self) -> &[f64] {
        bytemuck::cast_slice(std::slice::from_ref(&self.lanes))
    }

    /// Other numbers, as many.
    #[inline(always)]
    pub fn lane_by_lane(self, lane: impl Fn(usize) -> f64) -> Self {
        Self::of(self.simd, lane)
    }

    /// Each lane's function value.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        self.lane_by_lane(|l| f(self.numbers()[l]))
    }

    /// Square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { lanes: self.simd.sqrt_f64s(self.lanes), ..self }
    }

    /// `yes` in the lanes where this is above 0, `no` in the others.
    #[inline(always)]
    pub fn where_positive(self, yes: Self, no: Self) -> Self {
        let is_positive = self.simd.less_than_f64s(self.simd.splat_f64s(0.0), self.lanes);
        Self { lanes: self.simd.select_f64s(is_positive, yes.lanes, no.lanes), ..self }
    }
}

/// An operator that a processor has for vectors.
macro_rules! operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl<S: Simd> $operator for Vector<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self { lanes: self.simd.$instruction(self.lanes, o.lanes), ..self }
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

/// The same with one number for all lanes.
macro_rules! operator_with_number {
    ($operator:ident, $method:ident) => {
        impl<S: Simd> $operator<f64> for Vector<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: f64) -> Self {
                self.$method(self.constant(o))
            }
        }
    };
}

operator_with_number!(Add, add);
operator_with_number!(Sub, sub);
operator_with_number!(Mul, mul);

impl<S: Simd> Neg for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { lanes: self.simd.neg_f64s(self.lanes), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Formula<'a>(&'a [f64]);

    impl WithSimd for Formula<'_> {
        type Output = Vec<f64>;
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
            let mut found = Vec::new();
            for numbers in self.0.chunks(Vector::<S>::LANES) {
                let x = Vector::of(simd, |l| *numbers.get(l).unwrap_or(&1.0));
                let y = formula(x, x.constant(0.3), Vector::sqrt) + x.where_positive(x, x.constant(7.0));
                found.extend_from_slice(&y.numbers()[..numbers.len()]);
            }
            found
        }
    }

    fn formula<T>(x: T, k: T, sqrt: impl Fn(T) -> T) -> T
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Div<Output = T> + Neg<Output = T>,
    {
        sqrt(x * x + k) / (k - x) - -(x * k)
    }

    #[test]
    fn lanes_have_the_bits_of_single_numbers() {
        let numbers: Vec<f64> = (0..1003).map(|i| libm::sin(f64::from(i)) * 5.0).collect();
        for (x, y) in numbers.iter().zip(with_vectors(Formula(&numbers))) {
            let one = formula(*x, 0.3, f64::sqrt) + if *x > 0.0 { *x } else { 7.0 };
            assert_eq!(y.to_bits(), one.to_bits(), "{x}");
        }
    }
}
