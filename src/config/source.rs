//! The text of a config with the arguments on top: its values, and where each was written.

use super::error::{ConfigError, Located, Place, Problem};
use super::path::{KeyPath, Segment};
use crate::io::text;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

/// A parsed config file and the `--set` arguments laid over it.
#[derive(Debug)]
pub struct Source {
    file: PathBuf,
    text: String,
    values: Table,
    sets: Vec<(KeyPath, String)>,
}

impl Source {
    /// Reads a file, or stdin where it is called `-`, and lays `key=value` arguments over it.
    ///
    /// # Errors
    /// If the file cannot be read or is not TOML, or an argument is not `key=value` with a key that can be set.
    pub fn read(file: &Path, sets: &[String]) -> Result<Self, ConfigError> {
        let text =
            text::read(file).map_err(|source| ConfigError::Read { file: file.to_path_buf(), source })?;
        Self::parse(file, text, sets)
    }

    /// As [`Source::read`], from text; `file` is for messages only.
    ///
    /// # Errors
    /// As [`Source::read`].
    pub fn parse(file: &Path, text: String, sets: &[String]) -> Result<Self, ConfigError> {
        let values = text.parse::<Table>().map_err(|error| ConfigError::Syntax {
            file: file.to_path_buf(),
            line: error.span().map_or(1, |span| line_of(&text, span.start)),
            message: syntax(error.message()),
        })?;
        let mut source = Self { file: file.to_path_buf(), text, values, sets: Vec::new() };
        for argument in sets {
            source.set(argument).map_err(|problem| {
                ConfigError::Invalid(vec![Located { place: Place::Argument(argument.clone()), problem }])
            })?;
        }
        Ok(source)
    }

    /// Values without a text; `file` is for messages only.
    pub fn of(values: Table, file: &Path) -> Self {
        Self { file: file.to_path_buf(), text: String::new(), values, sets: Vec::new() }
    }

    /// The values, arguments included.
    pub fn values(&self) -> &Table {
        &self.values
    }

    fn set(&mut self, argument: &str) -> Result<(), Problem> {
        let (key, text) = argument.split_once('=').ok_or_else(|| {
            Problem::new(
                KeyPath::of(argument),
                "found no `=`; allowed: `key=value`, as in search.population=24",
            )
        })?;
        let path = KeyPath::of(key.trim());
        let value = value_of(text.trim());
        place_value(&mut self.values, &path.0, value)
            .map_err(|message| Problem::new(path.clone(), message))?;
        self.sets.push((path, argument.to_owned()));
        Ok(())
    }

    /// Where a key was written; where it is missing, where the table that would hold it begins.
    pub fn place(&self, key: &KeyPath) -> Place {
        let set = self.sets.iter().rev().find(|(path, _)| path.holds(key) || key.holds(path));
        if let Some((_, argument)) = set {
            return Place::Argument(argument.clone());
        }
        // The text parsed once already; a second parse keeps the spans, which borrow from it.
        match DeTable::parse(&self.text).ok().and_then(|root| offset_of(root.get_ref(), &key.0)) {
            Some(offset) => Place::Line(self.file.clone(), line_of(&self.text, offset)),
            None => Place::File(self.file.clone()),
        }
    }

    /// Problems with their places, in order of place.
    pub fn locate(&self, problems: Vec<Problem>) -> ConfigError {
        let mut located: Vec<Located> = problems
            .into_iter()
            .map(|problem| Located { place: self.place(&problem.key), problem })
            .collect();
        located.sort_by(|a, b| a.place.cmp(&b.place));
        ConfigError::Invalid(located)
    }
}

/// What the parser says; of a number that TOML has no room for, also what it has room for.
fn syntax(message: &str) -> String {
    match message.contains("too large") {
        true => format!("{message}; allowed: whole numbers up to {}", i64::MAX),
        false => message.to_owned(),
    }
}

/// Line of a byte offset, from 1.
fn line_of(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|&byte| byte == b'\n').count()
}

/// Offset of the deepest part of a path that the file has.
fn offset_of(table: &DeTable<'_>, path: &[Segment]) -> Option<usize> {
    let (first, rest) = path.split_first()?;
    let Segment::Key(name) = first else { return None };
    let (key, value) = table.iter().find(|(key, _)| key.get_ref().as_ref() == name.as_str())?;
    Some(offset_in(value, rest).unwrap_or(key.span().start))
}

fn offset_in(value: &Spanned<DeValue<'_>>, path: &[Segment]) -> Option<usize> {
    match (value.get_ref(), path.split_first()?) {
        (DeValue::Table(table), _) => offset_of(table, path),
        (DeValue::Array(array), (Segment::Index(index), rest)) => {
            let entry = array.get(*index)?;
            Some(offset_in(entry, rest).unwrap_or(entry.span().start))
        }
        _ => None,
    }
}

/// A TOML value, or else the text itself as a string, so that words need no quotes within quotes.
fn value_of(text: &str) -> Value {
    let parsed = format!("value = {text}").parse::<Table>().ok();
    parsed
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Puts a value at a path, making tables on the way; an array must have the entry.
fn place_value(table: &mut Table, path: &[Segment], value: Value) -> Result<(), String> {
    let Some((Segment::Key(name), rest)) = path.split_first() else {
        return Err("a key of a table is needed here".into());
    };
    if rest.is_empty() {
        table.insert(name.clone(), value);
        return Ok(());
    }
    let entry = table.entry(name.clone()).or_insert_with(|| Value::Table(Table::new()));
    place_in(entry, rest, value)
}

fn place_in(target: &mut Value, path: &[Segment], value: Value) -> Result<(), String> {
    match (target, path.split_first()) {
        (target, None) => *target = value,
        (Value::Table(table), Some(_)) => return place_value(table, path, value),
        (Value::Array(array), Some((Segment::Index(index), rest))) => {
            let count = array.len();
            let entry = array.get_mut(*index).ok_or_else(|| {
                format!("there is no entry {index}; allowed: 0 to {}", count.saturating_sub(1))
            })?;
            return place_in(entry, rest, value);
        }
        (target, Some(_)) => {
            return Err(format!("the config has a {} where this key would be", target.type_str()));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "version = 1\n\n[domain]\n[[domain.loop]]\nkind = \"circle\"\nradius_m = 1.0\n\
                        [[domain.loop]]\nkind = \"circle\"\npoints = [[1, 2],\n  [3, 4]]\nt = { a = 1, b = 2 }\n";

    fn source(sets: &[&str]) -> Source {
        let sets: Vec<String> = sets.iter().map(|s| (*s).to_owned()).collect();
        Source::parse(Path::new("c.toml"), TEXT.to_owned(), &sets).unwrap()
    }

    fn place(source: &Source, key: &str) -> String {
        source.place(&KeyPath::of(key)).to_string()
    }

    #[test]
    fn finds_lines() {
        let source = source(&[]);
        assert_eq!(place(&source, "version"), "c.toml:1");
        assert_eq!(place(&source, "domain.loop[0].radius_m"), "c.toml:6");
        assert_eq!(place(&source, "domain.loop[1].points[1][0]"), "c.toml:10");
        assert_eq!(place(&source, "domain.loop[1].t.b"), "c.toml:11");
        // A missing key is reported where its table begins.
        assert_eq!(place(&source, "domain.loop[1].radius_m"), "c.toml:7");
        assert_eq!(place(&source, "search.population"), "c.toml");
    }

    #[test]
    fn arguments_win() {
        let source = source(&["domain.loop[1].radius_m=3", "search.tokens.max=5", "surface.kind=plane"]);
        assert_eq!(source.values()["domain"]["loop"][1]["radius_m"], Value::Integer(3));
        assert_eq!(source.values()["surface"]["kind"], Value::String("plane".into()));
        assert_eq!(place(&source, "search.tokens"), "--set search.tokens.max=5");
        assert_eq!(place(&source, "domain.loop[0].radius_m"), "c.toml:6");
    }

    #[test]
    fn wrong_arguments_are_named() {
        for (argument, message) in [
            ("search", "found no `=`"),
            ("domain.loop[7].radius_m=1", "there is no entry 7; allowed: 0 to 1"),
            ("version.x=1", "has a integer where this key would be"),
        ] {
            let error = Source::parse(Path::new("c.toml"), TEXT.to_owned(), &[argument.to_owned()]).err();
            let error = error.map(|e| e.to_string()).unwrap_or_default();
            assert!(error.contains(message) && error.contains(argument), "{error}");
        }
    }
}
