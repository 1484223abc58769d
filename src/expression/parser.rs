//! From text to program: a Pratt parser that writes its steps as it reads (Pratt 1973, *Top down operator precedence*).

use super::functions::{FUNCTIONS, Function};
use super::{ExpressionError, NAMES, Op, STACK};
use std::collections::BTreeMap;

/// Deepest nesting of parentheses, signs and powers.
const DEPTH: usize = 200;

/// Binding powers: the larger binds tighter.
const COMPARISON: u8 = 1;
const SUM: u8 = 2;
const PRODUCT: u8 = 3;
const SIGN: u8 = 4;
const POWER: u8 = 5;

/// A fault: position in characters and reason.
type Fault = (usize, String);

/// What a name stands for.
#[derive(Clone, Copy)]
enum Meaning {
    Step(Op),
    Function(Function),
}

/// The steps of all intermediate names and of the expression itself.
pub(super) fn program(
    variables: &[&str],
    text: &str,
    constants: &BTreeMap<String, f64>,
    lets: &[[String; 2]],
) -> Result<Vec<Op>, ExpressionError> {
    let mut names = built_in(variables);
    for (name, &value) in constants {
        let fault = |reason| error(&format!("constants.{name}"), name, (0, reason));
        if !value.is_finite() {
            return Err(fault(format!("the constant is {value}, which is not finite")));
        }
        declare(&mut names, name, Op::Number(value)).map_err(fault)?;
    }
    if lets.len() > NAMES {
        let reason = format!("at most {NAMES} intermediate names are allowed, found {}", lets.len());
        return Err(error("let", text, (0, reason)));
    }
    let mut steps = Vec::new();
    for (i, [name, definition]) in lets.iter().enumerate() {
        let defined = read(definition, &names);
        steps.extend(defined.map_err(|fault| error(&format!("let[{i}][1]"), definition, fault))?);
        steps.push(Op::Store);
        let declared = declare(&mut names, name, Op::Load(i));
        declared.map_err(|reason| error(&format!("let[{i}][0]"), name, (0, reason)))?;
    }
    steps.extend(read(text, &names).map_err(|fault| error("expression", text, fault))?);
    Ok(steps)
}

fn error(key: &str, text: &str, (position, reason): Fault) -> ExpressionError {
    // The text is shown on one line.
    let text = text.replace(|c: char| c.is_control(), " ");
    ExpressionError { key: key.to_owned(), text, position, reason }
}

fn built_in(variables: &[&str]) -> BTreeMap<String, Meaning> {
    use std::f64::consts::{E, PI, TAU};
    let numbers = [("pi", PI), ("tau", TAU), ("e", E)].map(|(name, value)| (name, Op::Number(value)));
    let steps = variables.iter().enumerate().map(|(i, name)| (*name, Op::Variable(i))).chain(numbers);
    let functions =
        FUNCTIONS.iter().filter_map(|n| Some(((*n).to_owned(), Meaning::Function(Function::named(n)?))));
    steps.map(|(n, op)| (n.to_owned(), Meaning::Step(op))).chain(functions).collect()
}

fn declare(names: &mut BTreeMap<String, Meaning>, name: &str, op: Op) -> Result<(), String> {
    let mut letters = name.chars();
    if !letters.next().is_some_and(is_name_start) || !letters.all(is_name_part) {
        return Err(format!("`{name}` is not a name: letters, digits and `_`, a letter first"));
    }
    match names.insert(name.to_owned(), Meaning::Step(op)) {
        Some(_) => Err(format!("`{name}` is already the name of something else")),
        None => Ok(()),
    }
}

fn is_name_start(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

fn is_name_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn read(text: &str, names: &BTreeMap<String, Meaning>) -> Result<Vec<Op>, Fault> {
    let mut parser =
        Parser { letters: text.chars().collect(), at: 0, names, steps: Vec::new(), depth: 0, height: 0 };
    if parser.peek().is_none() {
        return Err((0, "the expression is empty".to_owned()));
    }
    parser.expression(0)?;
    match parser.peek() {
        None => Ok(parser.steps),
        Some(')') => Err((parser.at, "`)` without `(`".to_owned())),
        Some(c) => Err((parser.at, format!("an operator is missing before `{c}`"))),
    }
}

struct Parser<'a> {
    letters: Vec<char>,
    at: usize,
    names: &'a BTreeMap<String, Meaning>,
    steps: Vec<Op>,
    depth: usize,
    /// Height of the stack after the steps so far.
    height: usize,
}

impl Parser<'_> {
    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        while self.letters.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.letters.get(self.at).copied()
    }

    fn push(&mut self, op: Op) -> Result<(), Fault> {
        self.height = match op {
            Op::Number(_) | Op::Variable(_) | Op::Load(_) => self.height + 1,
            Op::Negate => self.height,
            Op::Call(function) => self.height + 1 - function.arguments(),
            // All others take two and give one; to store takes one.
            _ => self.height - 1,
        };
        if self.height > STACK {
            return Err((self.at, "the expression is nested too deeply".to_owned()));
        }
        self.steps.push(op);
        Ok(())
    }

    /// Reads what binds at least as tightly as `least`.
    fn expression(&mut self, least: u8) -> Result<(), Fault> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err((self.at, "the expression is nested too deeply".to_owned()));
        }
        self.prefix()?;
        while let Some(c) = self.peek() {
            let is_or_equal = matches!(c, '<' | '>') && self.letters.get(self.at + 1) == Some(&'=');
            let (op, power) = match c {
                '<' if is_or_equal => (Op::LessOrEqual, COMPARISON),
                '>' if is_or_equal => (Op::GreaterOrEqual, COMPARISON),
                '<' => (Op::Less, COMPARISON),
                '>' => (Op::Greater, COMPARISON),
                '+' => (Op::Add, SUM),
                '-' => (Op::Subtract, SUM),
                '*' => (Op::Multiply, PRODUCT),
                '/' => (Op::Divide, PRODUCT),
                '^' => (Op::Power, POWER),
                _ => break,
            };
            if power < least {
                break;
            }
            self.at += 1 + usize::from(is_or_equal);
            // Powers group to the right, and their exponent may carry a sign; the others group to the left.
            self.expression(if op == Op::Power { SIGN } else { power + 1 })?;
            self.push(op)?;
        }
        self.depth -= 1;
        Ok(())
    }

    /// A number, a name, a call, a sign or a parenthesis.
    fn prefix(&mut self) -> Result<(), Fault> {
        match self.peek() {
            None => Err((self.at, "the expression ends where a number or a name should follow".to_owned())),
            Some('-') => {
                self.at += 1;
                self.expression(SIGN)?;
                self.push(Op::Negate)
            }
            Some('+') => {
                self.at += 1;
                self.expression(SIGN)
            }
            Some('(') => {
                self.at += 1;
                self.expression(0)?;
                self.expect(')')
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if is_name_start(c) => self.name(),
            Some(c) => Err((self.at, format!("`{c}` where a number or a name should be"))),
        }
    }

    fn expect(&mut self, wanted: char) -> Result<(), Fault> {
        match self.peek() {
            Some(c) if c == wanted => {
                self.at += 1;
                Ok(())
            }
            Some(c) => Err((self.at, format!("`{wanted}` or an operator should be here, found `{c}`"))),
            None => Err((self.at, format!("`{wanted}` is missing"))),
        }
    }

    fn digits(&mut self) {
        while self.letters.get(self.at).is_some_and(char::is_ascii_digit) {
            self.at += 1;
        }
    }

    fn number(&mut self) -> Result<(), Fault> {
        let start = self.at;
        self.digits();
        if self.letters.get(self.at) == Some(&'.') {
            self.at += 1;
            self.digits();
        }
        // An exponent counts only if digits follow: `2e` is 2 and the name e.
        let sign = matches!(self.letters.get(self.at + 1), Some('+' | '-'));
        let first = self.at + 1 + usize::from(sign);
        if matches!(self.letters.get(self.at), Some('e' | 'E'))
            && self.letters.get(first).is_some_and(char::is_ascii_digit)
        {
            self.at = first;
            self.digits();
        }
        let text: String = self.letters[start..self.at].iter().collect();
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => self.push(Op::Number(value)),
            Ok(_) => Err((start, format!("`{text}` is not finite"))),
            Err(_) => Err((start, format!("`{text}` is not a number"))),
        }
    }

    fn name(&mut self) -> Result<(), Fault> {
        let start = self.at;
        while self.letters.get(self.at).is_some_and(|&c| is_name_part(c)) {
            self.at += 1;
        }
        let name: String = self.letters[start..self.at].iter().collect();
        match self.names.get(&name) {
            Some(&Meaning::Step(op)) => self.push(op),
            Some(&Meaning::Function(function)) => self.call(start, &name, function),
            None => Err((start, self.unknown(&name))),
        }
    }

    fn call(&mut self, start: usize, name: &str, function: Function) -> Result<(), Fault> {
        if self.peek() != Some('(') {
            return Err((self.at, format!("the function `{name}` needs `(` and its arguments")));
        }
        self.at += 1;
        let mut found = 0;
        if self.peek() != Some(')') {
            loop {
                self.expression(0)?;
                found += 1;
                if self.peek() != Some(',') {
                    break;
                }
                self.at += 1;
            }
        }
        self.expect(')')?;
        let wanted = function.arguments();
        if found != wanted {
            let plural = if wanted == 1 { "" } else { "s" };
            return Err((start, format!("`{name}` takes {wanted} argument{plural}, found {found}")));
        }
        self.push(Op::Call(function))
    }

    fn unknown(&self, name: &str) -> String {
        if name == "log" {
            return "`log` has two meanings: write `ln` or `log10`".to_owned();
        }
        let nearest = self
            .names
            .keys()
            .map(|known| (strsim::damerau_levenshtein(name, known), known))
            // Two letters off is near only if the word begins alike.
            .filter(|&(distance, known)| {
                let begins_alike = name.chars().next() == known.chars().next();
                distance < known.len().min(name.len()) && distance <= 1 + usize::from(begins_alike)
            })
            .min();
        match nearest {
            Some((_, known)) => format!("unknown name `{name}`; did you mean `{known}`?"),
            None => {
                let known: Vec<_> = self.names.keys().map(String::as_str).collect();
                format!("unknown name `{name}`; known are {}", known.join(", "))
            }
        }
    }
}
