//! The functions that expressions know, each with its derivative; values by `libm`, the same on every platform.

use super::dual::Real;

macro_rules! functions {
    ($($name:literal $variant:ident $arguments:literal),* $(,)?) => {
        /// The names of the functions.
        pub const FUNCTIONS: &[&str] = &[$($name),*];

        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub(super) enum Function { $($variant),* }

        impl Function {
            /// The function of this name.
            pub(super) fn named(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$variant),)*
                    _ => None,
                }
            }

            /// How many arguments it takes: 1 or 2.
            pub(super) fn arguments(self) -> usize {
                match self { $(Self::$variant => $arguments),* }
            }
        }
    };
}

functions! {
    "sin" Sin 1, "cos" Cos 1, "tan" Tan 1, "asin" Asin 1, "acos" Acos 1, "atan" Atan 1, "atan2" Atan2 2,
    "sinh" Sinh 1, "cosh" Cosh 1, "tanh" Tanh 1, "exp" Exp 1, "ln" Ln 1, "log10" Log10 1, "sqrt" Sqrt 1, "cbrt" Cbrt 1,
    "abs" Abs 1, "sign" Sign 1, "floor" Floor 1, "ceil" Ceil 1, "hypot" Hypot 2, "min" Min 2, "max" Max 2, "pow" Pow 2,
}

impl Function {
    /// f(a), or f(a, b) for two arguments.
    pub(super) fn apply<T: Real>(self, a: T, b: T) -> T {
        let v = a.value();
        match self {
            Self::Sin => a.chain(libm::sin(v), libm::cos(v)),
            Self::Cos => a.chain(libm::cos(v), -libm::sin(v)),
            Self::Tan => {
                let tan = libm::tan(v);
                a.chain(tan, 1.0 + tan * tan)
            }
            Self::Asin => a.chain(libm::asin(v), 1.0 / (1.0 - v * v).sqrt()),
            Self::Acos => a.chain(libm::acos(v), -1.0 / (1.0 - v * v).sqrt()),
            Self::Atan => a.chain(libm::atan(v), 1.0 / (1.0 + v * v)),
            Self::Atan2 => {
                let w = b.value();
                let r2 = v * v + w * w;
                T::combine(a, b, libm::atan2(v, w), [w / r2, -v / r2])
            }
            Self::Sinh => a.chain(libm::sinh(v), libm::cosh(v)),
            Self::Cosh => a.chain(libm::cosh(v), libm::sinh(v)),
            Self::Tanh => {
                let tanh = libm::tanh(v);
                a.chain(tanh, 1.0 - tanh * tanh)
            }
            Self::Exp => a.exp(),
            Self::Ln => a.chain(libm::log(v), 1.0 / v),
            Self::Log10 => a.chain(libm::log10(v), std::f64::consts::LOG10_E / v),
            Self::Sqrt => a.sqrt(),
            Self::Cbrt => {
                let root = libm::cbrt(v);
                a.chain(root, if root == 0.0 { 0.0 } else { 1.0 / (3.0 * root * root) })
            }
            Self::Abs => a.chain(v.abs(), sign(v)),
            Self::Sign => a.chain(sign(v), 0.0),
            Self::Floor => a.chain(libm::floor(v), 0.0),
            Self::Ceil => a.chain(libm::ceil(v), 0.0),
            Self::Hypot => (a * a + b * b).sqrt(),
            // Not f64::min, which drops a NaN.
            Self::Min => {
                if b.value() < v || b.value().is_nan() {
                    b
                } else {
                    a
                }
            }
            Self::Max => {
                if b.value() > v || b.value().is_nan() {
                    b
                } else {
                    a
                }
            }
            Self::Pow => power(a, b),
        }
    }
}

/// −1, 0 or 1; NaN for NaN.
fn sign(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v / v.abs() }
}

/// a^b; small whole exponents by multiplication.
pub(super) fn power<T: Real>(a: T, b: T) -> T {
    let (v, w) = (a.value(), b.value());
    let value = real_power(v, w);
    let by_base = if w == 0.0 { 0.0 } else { w * real_power(v, w - 1.0) };
    // Only a base that is positive allows the exponent to vary; `combine` leaves a constant exponent out.
    T::combine(a, b, value, [by_base, value * libm::log(v)])
}

fn real_power(base: f64, exponent: f64) -> f64 {
    if libm::trunc(exponent) != exponent || exponent.abs() > 16.0 {
        return libm::pow(base, exponent);
    }
    let product = (0..exponent.abs() as u32).fold(1.0, |p, _| p * base);
    if exponent < 0.0 { 1.0 / product } else { product }
}
