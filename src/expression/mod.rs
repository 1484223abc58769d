//! Expressions of `x`, `y` and other variables: read once, then run as a short program that also gives the exact slopes.
//!
//! `+ - * / ^`, `< > <= >=` (1 where it holds, else 0; they bind loosest), parentheses, numbers, variables, `pi`, `tau`, `e`, named constants, names by `let`, and the functions of
//! [`FUNCTIONS`]. As in mathematics −x^2 is −(x²) and 2^3^2 is 2^(3^2) = 512; there is no multiplication without a sign.

pub(crate) mod algebra;
pub(crate) mod dual;
mod functions;
mod parser;

pub use functions::FUNCTIONS;

use dual::Real;
use functions::Function;
use std::collections::BTreeMap;

/// What cannot be understood, and where.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[error("{key}, column {}: {reason}\n  {text}\n  {}^", position + 1, " ".repeat(*position))]
pub struct ExpressionError {
    /// Which text of the config: `expression`, `constants.h`, or `let[0][1]`, the definition of the first name.
    pub key: String,
    /// The text.
    pub text: String,
    /// Position of the fault in characters, from 0.
    pub position: usize,
    /// What is wrong.
    pub reason: String,
}

/// A function given as text.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    program: Vec<Op>,
}

/// One step on a stack of numbers.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Op {
    Number(f64),
    /// The variable of this number.
    Variable(usize),
    /// A named intermediate value.
    Load(usize),
    /// Takes the top of the stack as the next intermediate value.
    Store,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Negate,
    Call(Function),
}

/// Deepest stack of a program.
const STACK: usize = 48;
/// Most intermediate names.
const NAMES: usize = 32;

impl Expression {
    /// Reads an expression of x and y with its constants and intermediate names `[name, expression]`, each of which may use those before.
    ///
    /// # Errors
    /// The first fault with its position: unknown names and functions, missing operators, wrong numbers of arguments, names given
    /// twice or already taken, constants that are not finite.
    pub fn parse(
        text: &str,
        constants: &BTreeMap<String, f64>,
        lets: &[[String; 2]],
    ) -> Result<Self, ExpressionError> {
        Self::parse_of(&["x", "y"], text, constants, lets)
    }

    /// The same of other variables.
    ///
    /// # Errors
    /// As of [`Expression::parse`].
    pub fn parse_of(
        variables: &[&str],
        text: &str,
        constants: &BTreeMap<String, f64>,
        lets: &[[String; 2]],
    ) -> Result<Self, ExpressionError> {
        Ok(Self { text: text.to_owned(), program: parser::program(variables, text, constants, lets)? })
    }

    /// The text it was read from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The value; `variables` in the order they were given when it was read.
    pub fn value(&self, variables: &[f64]) -> f64 {
        self.run(variables)
    }

    /// The value for any kind of number.
    pub(crate) fn run<T: Real>(&self, variables: &[T]) -> T {
        let zero = T::from(0.0);
        let (mut stack, mut top) = ([zero; STACK], 0);
        let (mut names, mut named) = ([zero; NAMES], 0);
        for op in &self.program {
            let value = match *op {
                Op::Number(value) => T::from(value),
                Op::Variable(i) => variables[i],
                Op::Load(i) => names[i],
                Op::Store => {
                    top -= 1;
                    names[named] = stack[top];
                    named += 1;
                    continue;
                }
                Op::Negate => {
                    top -= 1;
                    -stack[top]
                }
                Op::Add
                | Op::Subtract
                | Op::Multiply
                | Op::Divide
                | Op::Power
                | Op::Less
                | Op::LessOrEqual
                | Op::Greater
                | Op::GreaterOrEqual => {
                    top -= 2;
                    binary(*op, stack[top], stack[top + 1])
                }
                Op::Call(function) => {
                    top -= function.arguments();
                    function.apply(stack[top], stack[top + function.arguments() - 1])
                }
            };
            stack[top] = value;
            top += 1;
        }
        stack[0]
    }
}

fn binary<T: Real>(op: Op, a: T, b: T) -> T {
    match op {
        Op::Add => a + b,
        Op::Subtract => a - b,
        Op::Multiply => a * b,
        Op::Divide => a / b,
        Op::Less => holds(a.value() < b.value()),
        Op::LessOrEqual => holds(a.value() <= b.value()),
        Op::Greater => holds(a.value() > b.value()),
        Op::GreaterOrEqual => holds(a.value() >= b.value()),
        _ => functions::power(a, b),
    }
}

/// 1 where something holds, else 0; flat everywhere.
fn holds<T: Real>(it_does: bool) -> T {
    T::from(if it_does { 1.0 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str, x: f64, y: f64) -> f64 {
        Expression::parse(text, &BTreeMap::new(), &[]).unwrap().value(&[x, y])
    }

    fn slope(f: &Expression, x: f64, y: f64) -> [f64; 2] {
        f.run(&dual::Dual::variables(x, y)).slope
    }

    #[test]
    fn comparisons_are_one_or_zero() {
        for (text, expected) in [
            ("x > 0", 1.0),
            ("x < 0", 0.0),
            ("x >= 2", 1.0),
            ("x <= 2", 1.0),
            ("x + 1 > y", 0.0),
            ("2 * (x > 0) * (y < 5)", 2.0),
            ("3 > 2 > 1", 0.0),
        ] {
            assert_eq!(value(text, 2.0, 3.0), expected, "{text}");
        }
        let half = Expression::parse("y * (x > 0)", &BTreeMap::new(), &[]).unwrap();
        assert_eq!(slope(&half, 1.0, 5.0), [0.0, 1.0]);
    }

    #[test]
    fn other_variables() {
        let zone =
            Expression::parse_of(&["x", "y", "z", "nx"], "z * (nx > 0.5)", &BTreeMap::new(), &[]).unwrap();
        assert_eq!(zone.value(&[0.0, 0.0, 7.0, 0.6]), 7.0);
        let error = Expression::parse("z", &BTreeMap::new(), &[]).unwrap_err();
        assert!(error.reason.contains("unknown name `z`"), "{error}");
    }

    #[test]
    fn signs_and_powers_as_in_mathematics() {
        for (text, expected) in [
            ("-3^2", -9.0),
            ("2^3^2", 512.0),
            ("-x^2", -4.0),
            ("(-x)^2", 4.0),
            ("2^-1", 0.5),
            ("2^-x^2", 0.0625),
            ("1 - 2 - 3", -4.0),
            ("8 / 2 / 2", 2.0),
            ("1 + 2 * 3 ^ x", 19.0),
            ("-x * -y", 6.0),
            ("--x", 2.0),
            ("+x - +y", -1.0),
            ("1.5e1 + .5 + 2.", 17.5),
            ("2e-1*e", 0.2 * std::f64::consts::E),
            ("max(x, y) - min(x, y)", 1.0),
            ("atan2(0, -1) - pi", 0.0),
            ("hypot(3, 4)", 5.0),
            ("abs(-x) + sign(-y)", 1.0),
            ("((((x))))", 2.0),
            ("x\n  * y", 6.0),
        ] {
            assert!((value(text, 2.0, 3.0) - expected).abs() < 1e-15, "{text} = {}", value(text, 2.0, 3.0));
        }
    }

    #[test]
    fn names_build_on_each_other() {
        let constants = BTreeMap::from([("a".to_owned(), 3.0)]);
        let lets = [["r".to_owned(), "sqrt(x^2 + y^2)".to_owned()], ["q".to_owned(), "r / a".to_owned()]];
        let dome = Expression::parse("q * r + a", &constants, &lets).unwrap();
        assert!((dome.value(&[3.0, 4.0]) - (25.0 / 3.0 + 3.0)).abs() < 1e-14);
    }

    #[test]
    fn gradients_of_every_function() {
        let texts = [
            "sin(x*y)",
            "cos(x)-y",
            "tan(x/3)",
            "asin(x/9)",
            "acos(y/9)",
            "atan(x*y)",
            "atan2(y, x)",
            "sinh(x)",
            "cosh(y)",
            "tanh(x-y)",
            "exp(-x*y)",
            "ln(x+y)",
            "log10(x*y)",
            "sqrt(x+y)",
            "cbrt(x*y)",
            "abs(x-y)",
            "hypot(x, y)",
            "min(x*y, x)",
            "max(x*y, x)",
            "x^y",
            "x^2.5",
            "(x-y)^3",
            "2^x",
            "x^-2",
            "pow(x, y)",
            "sign(x)",
            "floor(x)",
            "ceil(y)",
        ];
        for name in FUNCTIONS {
            assert!(texts.iter().any(|t| t.contains(name)), "{name} is not tested");
        }
        let (x, y, h) = (1.3, 2.2, 1e-6);
        for text in texts {
            let f = Expression::parse(text, &BTreeMap::new(), &[]).unwrap();
            let g = slope(&f, x, y);
            let dx = (f.value(&[x + h, y]) - f.value(&[x - h, y])) / (2.0 * h);
            let dy = (f.value(&[x, y + h]) - f.value(&[x, y - h])) / (2.0 * h);
            assert!((g[0] - dx).abs() < 1e-7 && (g[1] - dy).abs() < 1e-7, "{text}: {g:?} {dx} {dy}");
        }
    }

    #[test]
    fn the_gradient_at_a_dome_top_is_finite() {
        let f = Expression::parse("10 - sqrt(x^2 + y^2)", &BTreeMap::new(), &[]).unwrap();
        assert_eq!(slope(&f, 0.0, 0.0), [0.0, 0.0]);
        let f = Expression::parse("-x^2/40 - y^2/30", &BTreeMap::new(), &[]).unwrap();
        assert_eq!(slope(&f, 0.0, 0.0), [0.0, 0.0]);
    }

    #[test]
    fn faults_have_a_position() {
        for (text, position, part) in [
            ("", 0, "empty"),
            ("x +", 3, "ends"),
            ("x + * y", 4, "`*`"),
            ("2x", 1, "operator"),
            ("2 x", 2, "operator"),
            ("(x + y", 6, "`)`"),
            ("x + y)", 5, "`)`"),
            ("sin x", 4, "`(`"),
            ("sin(x, y)", 0, "1 argument"),
            ("atan2(x)", 0, "2 arguments"),
            ("sine(x)", 0, "did you mean `sin`"),
            ("log(x)", 0, "`ln`"),
            ("x + radius", 4, "unknown name `radius`"),
            ("x ** 2", 3, "`*`"),
            ("x # y", 2, "`#`"),
            ("1.2.3", 3, "operator"),
            ("1e", 1, "operator"),
            ("1e999", 0, "not finite"),
            ("é + x", 0, "`é`"),
            ("x(2)", 1, "operator"),
            ("()", 1, "`)`"),
        ] {
            let error = Expression::parse(text, &BTreeMap::new(), &[]).unwrap_err();
            assert_eq!(error.position, position, "{text}: {error}");
            assert!(error.reason.contains(part), "{text}: {error}");
        }
    }

    #[test]
    fn names_that_cannot_be_given() {
        let fails = |constants: &[(&str, f64)], lets: &[[&str; 2]]| {
            let constants = constants.iter().map(|&(n, v)| (n.to_owned(), v)).collect();
            let lets: Vec<_> = lets.iter().map(|l| l.map(str::to_owned)).collect();
            Expression::parse("x", &constants, &lets).unwrap_err().to_string()
        };
        assert!(fails(&[("x", 1.0)], &[]).contains("`x` is already"));
        assert!(fails(&[("sin", 1.0)], &[]).contains("`sin` is already"));
        assert!(fails(&[("a", f64::NAN)], &[]).contains("not finite"));
        assert!(fails(&[("a b", 1.0)], &[]).contains("not a name"));
        assert!(fails(&[("a", 1.0)], &[["a", "x"]]).contains("`a` is already"));
        assert!(fails(&[], &[["r", "q"], ["q", "x"]]).contains("unknown name `q`"));
        assert!(fails(&[], &[["r", "x +"]]).contains("let[0][1]"));
    }

    #[test]
    fn depth_is_bounded() {
        let deep = format!("{}x{}", "(".repeat(5000), ")".repeat(5000));
        assert!(Expression::parse(&deep, &BTreeMap::new(), &[]).unwrap_err().reason.contains("deep"));
        let minus = format!("{}x", "-".repeat(100_000));
        assert!(Expression::parse(&minus, &BTreeMap::new(), &[]).unwrap_err().reason.contains("deep"));
        let right = format!("{}x", "x^(x+".repeat(40)) + &")".repeat(40);
        assert!(Expression::parse(&right, &BTreeMap::new(), &[]).unwrap_err().reason.contains("deep"));
        assert_eq!(value(&format!("{}x", "x+".repeat(9999)), 1.0, 0.0), 10_000.0);
    }
}
