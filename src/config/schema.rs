//! Keys, types and ranges, checked against the JSON schema of [`Config`](super::Config).
//!
//! serde alone would stop at the first error, forget the line inside tagged enums, and know no ranges. The schema is
//! derived from the same types that serde fills, so that nothing is written twice.

use super::error::Problem;
use super::path::KeyPath;
use super::retired;
pub use crate::json::suggestion;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value as Json};
use toml::{Table, Value};

/// The schema of the config, with every type written out where it is used.
pub fn config_schema() -> Json {
    let settings = SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    settings.into_generator().into_root_schema_for::<super::Config>().to_value()
}

/// All that is wrong with the values, as far as each key can be judged alone.
pub fn check(values: &Table) -> Vec<Problem> {
    let schema = config_schema();
    let mut checker = Checker { root: &schema, problems: Vec::new() };
    checker.table(values, &schema, &KeyPath::default());
    checker.problems
}

/// The alternatives of a schema; one that has no alternatives is its own.
pub fn alternatives(schema: &Json) -> Vec<&Json> {
    let listed = schema.get("oneOf").or_else(|| schema.get("anyOf")).and_then(Json::as_array);
    match listed {
        Some(list) => list.iter().filter(|s| !is_type(s, "null")).flat_map(alternatives).collect(),
        None => vec![schema],
    }
}

/// Whether values of this JSON type fit.
pub fn is_type(schema: &Json, name: &str) -> bool {
    match schema.get("type") {
        Some(Json::String(one)) => one == name,
        Some(Json::Array(several)) => several.iter().any(|t| t == name),
        _ => match (schema.get("const"), name) {
            (Some(Json::String(_)), "string") => true,
            (Some(Json::Number(_)), "integer") => true,
            _ => schema.get("enum").is_some() && name == "string",
        },
    }
}

/// The words a string schema allows; none if any string will do.
pub fn words(schema: &Json) -> Vec<&str> {
    match (schema.get("const"), schema.get("enum").and_then(Json::as_array)) {
        (Some(one), _) => one.as_str().into_iter().collect(),
        (_, Some(list)) => list.iter().filter_map(Json::as_str).collect(),
        _ => Vec::new(),
    }
}

/// The keys of a table schema.
pub fn properties(schema: &Json) -> Option<&Map<String, Json>> {
    schema.get("properties").and_then(Json::as_object)
}

/// The `kind` that a variant of a tagged table stands for.
pub fn tag(schema: &Json) -> Option<&str> {
    properties(schema)?.get("kind")?.get("const")?.as_str()
}

/// The keys without which a table is refused.
pub fn required(schema: &Json) -> Vec<&str> {
    let listed = schema.get("required").and_then(Json::as_array);
    listed.into_iter().flatten().filter_map(Json::as_str).collect()
}

/// The range of a number, in words; none if all finite numbers will do.
pub fn range(schema: &Json) -> Option<String> {
    let bound = |key: &str| schema.get(key).and_then(Json::as_f64).filter(|b| b.abs() < 1e16);
    let low =
        bound("minimum").map(|b| format!("≥ {b}")).or(bound("exclusiveMinimum").map(|b| format!("> {b}")));
    let high =
        bound("maximum").map(|b| format!("≤ {b}")).or(bound("exclusiveMaximum").map(|b| format!("< {b}")));
    match (low, high) {
        (Some(low), Some(high)) => Some(format!("{low} and {high}")),
        (low, high) => low.or(high),
    }
}

/// What a schema allows, in words.
pub fn allowed(schema: &Json) -> String {
    let mut list: Vec<String> = alternatives(schema).into_iter().map(allowed_alone).collect();
    list.extend(instead(schema).map(str::to_owned));
    list.join(", or ")
}

/// Another key, in words, that says what this one cannot.
fn instead(schema: &Json) -> Option<&str> {
    schema.get("x-instead").and_then(Json::as_str)
}

fn allowed_alone(schema: &Json) -> String {
    let with_range = |noun: &str| range(schema).map_or(noun.to_owned(), |range| format!("{noun} {range}"));
    if is_type(schema, "string") {
        return match words(schema).as_slice() {
            [] => "a string".into(),
            words => words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", "),
        };
    }
    if is_type(schema, "boolean") {
        return "true, false".into();
    }
    if is_type(schema, "integer") {
        return with_range("a whole number");
    }
    if is_type(schema, "number") {
        return with_range("a number");
    }
    if is_type(schema, "array") {
        // A range of the list is that of all its items, instead of their own.
        let item = items(schema, 0).map_or("values".into(), |item| match range(schema) {
            Some(range) if is_type(item, "integer") => format!("a whole number {range}"),
            Some(range) => format!("a number {range}"),
            None => allowed(item),
        });
        return format!("a list{} of: {item}", counts(schema));
    }
    match (tag(schema), properties(schema)) {
        (Some(kind), _) => format!("{{ kind = \"{kind}\", … }}"),
        (None, Some(keys)) => {
            let keys: Vec<&str> = keys.keys().map(String::as_str).collect();
            format!("a table with {}", keys.join(", "))
        }
        (None, None) => "a table".into(),
    }
}

fn bounds_of_count(schema: &Json) -> (u64, u64) {
    let bound = |key: &str| schema.get(key).and_then(Json::as_u64);
    (bound("minItems").unwrap_or(0), bound("maxItems").unwrap_or(u64::MAX))
}

fn counts(schema: &Json) -> String {
    match bounds_of_count(schema) {
        (0, u64::MAX) => String::new(),
        (low, u64::MAX) => format!(" ({low} or more)"),
        (low, high) if low == high => format!(" ({low})"),
        (low, high) => format!(" ({low} to {high})"),
    }
}

fn items(schema: &Json, index: usize) -> Option<&Json> {
    let prefix = schema.get("prefixItems").and_then(Json::as_array).and_then(|list| list.get(index));
    prefix.or_else(|| schema.get("items").filter(|items| items.is_object()))
}

struct Checker<'a> {
    root: &'a Json,
    problems: Vec<Problem>,
}

impl Checker<'_> {
    fn refuse(&mut self, path: &KeyPath, message: String) {
        self.problems.push(Problem::new(path.clone(), message));
    }

    fn unknown_key(&self, name: &str, known: Option<&Map<String, Json>>, path: &KeyPath) -> String {
        let keys: Vec<&str> = known.into_iter().flat_map(|known| known.keys().map(String::as_str)).collect();
        let mut hint = suggestion(name, &keys);
        if let (true, Some(home)) = (hint.is_empty(), home_of(name, self.root))
            && !KeyPath::of(home).holds(path)
        {
            hint = format!("; `{name}` belongs in [{home}]");
        }
        if let Some(instead) = retired::instead_of(&path.to_string()) {
            return format!("unknown key: {instead}");
        }
        format!("unknown key{hint}; allowed here: {}", keys.join(", "))
    }

    fn value(&mut self, value: &Value, schema: &Json, path: &KeyPath) {
        let fitting: Vec<&Json> = alternatives(schema).into_iter().filter(|s| fits(value, s)).collect();
        match (value, fitting.as_slice()) {
            (_, []) => self.refuse(path, format!("found {}; allowed: {}", found(value), allowed(schema))),
            (Value::String(text), _) => self.word(text, &fitting, instead(schema), path),
            (Value::Table(table), [first, ..]) => match tag(first) {
                Some(_) => self.tagged(table, &fitting, path),
                None => self.table(table, nearest_table(table, &fitting), path),
            },
            (Value::Array(array), [first, ..]) => self.array(array, first, path),
            (Value::Integer(_) | Value::Float(_), [first, ..]) => self.number(value, first, path),
            _ => {}
        }
    }

    fn word(&mut self, text: &str, schemas: &[&Json], instead: Option<&str>, path: &KeyPath) {
        let free = schemas.iter().any(|s| words(s).is_empty());
        let known: Vec<&str> = schemas.iter().flat_map(|s| words(s)).collect();
        if free || known.contains(&text) {
            return;
        }
        let allowed: Vec<String> = known.iter().map(|word| format!("\"{word}\"")).collect();
        let (hint, instead) =
            (suggestion(text, &known), instead.map_or(String::new(), |i| format!(", or {i}")));
        self.refuse(path, format!("found \"{text}\"{hint}; allowed: {}{instead}", allowed.join(", ")));
    }

    fn number(&mut self, value: &Value, schema: &Json, path: &KeyPath) {
        let number = match value {
            Value::Integer(integer) => *integer as f64,
            Value::Float(float) => *float,
            _ => return,
        };
        let bound = |key: &str| schema.get(key).and_then(Json::as_f64);
        // Where no range is given, what the type of the number has room for.
        let is_short = schema.get("format").and_then(Json::as_str) == Some("uint32");
        if is_short && number > f64::from(u32::MAX) && bound("maximum").is_none() {
            let allowed = format!("{} and ≤ {}", allowed(schema), u32::MAX);
            return self.refuse(path, format!("found {}; allowed: {allowed}", found(value)));
        }
        let inside = number.is_finite()
            && bound("minimum").is_none_or(|b| number >= b)
            && bound("exclusiveMinimum").is_none_or(|b| number > b)
            && bound("maximum").is_none_or(|b| number <= b)
            && bound("exclusiveMaximum").is_none_or(|b| number < b);
        if !inside {
            let finite = if number.is_finite() { "a number" } else { "a finite number" };
            let allowed = allowed(schema).replace("a number", finite);
            self.refuse(path, format!("found {}; allowed: {allowed}", found(value)));
        }
    }

    fn array(&mut self, array: &[Value], schema: &Json, path: &KeyPath) {
        let (low, high) = bounds_of_count(schema);
        let count = array.len() as u64;
        if count < low || count > high {
            self.refuse(path, format!("found a list of {count}; allowed: {}", allowed(schema)));
        }
        for (index, value) in array.iter().enumerate() {
            let path = path.index(index);
            if let Some(item) = items(schema, index) {
                self.value(value, item, &path);
            }
            // A range written at a list of numbers holds for each of them.
            if matches!(value, Value::Integer(_) | Value::Float(_)) && range(schema).is_some() {
                self.number(value, schema, &path);
            }
        }
    }

    fn tagged(&mut self, table: &Table, variants: &[&Json], path: &KeyPath) {
        let kinds: Vec<&str> = variants.iter().filter_map(|s| tag(s)).collect();
        match table.get("kind") {
            None => self.refuse(&path.key("kind"), format!("missing; allowed: {}", quoted(&kinds))),
            Some(Value::String(kind)) => match variants.iter().find(|s| tag(s) == Some(kind)) {
                Some(variant) => self.table(table, variant, path),
                None => {
                    let message =
                        format!("found \"{kind}\"{}; allowed: {}", suggestion(kind, &kinds), quoted(&kinds));
                    self.refuse(&path.key("kind"), message);
                }
            },
            Some(other) => {
                self.refuse(
                    &path.key("kind"),
                    format!("found {}; allowed: {}", found(other), quoted(&kinds)),
                );
            }
        }
    }

    fn table(&mut self, table: &Table, schema: &Json, path: &KeyPath) {
        let known = properties(schema);
        let other = schema.get("additionalProperties").filter(|s| s.is_object());
        for (name, value) in table {
            let path = path.key(name);
            match (known.and_then(|known| known.get(name)), other) {
                (Some(schema), _) | (None, Some(schema)) => self.value(value, schema, &path),
                (None, None) => {
                    let message = self.unknown_key(name, known, &path);
                    self.refuse(&path, message);
                }
            }
        }
        for name in required(schema).into_iter().filter(|name| !table.contains_key(*name)) {
            let allowed = known.and_then(|known| known.get(name)).map_or(String::new(), allowed);
            self.refuse(&path.key(name), format!("missing; allowed: {allowed}"));
        }
    }
}

/// A top-level table that knows a key.
fn home_of<'a>(name: &str, root: &'a Json) -> Option<&'a str> {
    let home = properties(root)?.iter().find(|(_, schema)| {
        alternatives(schema).into_iter().filter_map(properties).any(|keys| keys.contains_key(name))
    });
    home.map(|(table, _)| table.as_str())
}

/// Of several untagged tables, the one that shares most keys with the given one.
fn nearest_table<'a>(table: &Table, variants: &[&'a Json]) -> &'a Json {
    let shared = |schema: &Json| {
        let known = properties(schema);
        table.keys().filter(|key| known.is_some_and(|known| known.contains_key(*key))).count()
    };
    let mut best = variants[0];
    for variant in &variants[1..] {
        if shared(variant) > shared(best) {
            best = variant;
        }
    }
    best
}

fn fits(value: &Value, schema: &Json) -> bool {
    match value {
        Value::String(_) => is_type(schema, "string"),
        Value::Integer(_) => is_type(schema, "integer") || is_type(schema, "number"),
        Value::Float(_) => is_type(schema, "number"),
        Value::Boolean(_) => is_type(schema, "boolean"),
        Value::Array(_) => is_type(schema, "array"),
        Value::Table(_) => is_type(schema, "object"),
        Value::Datetime(_) => false,
    }
}

fn quoted(words: &[&str]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}

/// A value as it would be written, shortened.
pub fn found(value: &Value) -> String {
    const MOST: usize = 60;
    match value {
        Value::Table(_) => "a table".into(),
        Value::Array(array) if array.len() > 6 => format!("a list of {}", array.len()),
        other => {
            let text = other.to_string();
            match text.char_indices().nth(MOST) {
                Some((end, _)) => format!("{}…", &text[..end]),
                None => text,
            }
        }
    }
}
