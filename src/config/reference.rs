//! The config reference, `docs/config.md`, written from the schema: names, types, ranges, defaults and meanings are
//! those of the code.

use super::schema::{allowed, alternatives, config_schema, is_type, properties, required, tag};
use serde_json::Value as Json;
use std::fmt::Write;

const HEAD: &str = "\
# Config reference

Written by the program from its own types (`tests/program/config_reference.rs` keeps it true). A config is one TOML file; paths
in it are relative to it; every key has its unit in its name; a key that is not listed here is an error. *Default* is
what holds when the key is absent; only what is *required* must be there. `quadrille check CONFIG.toml` prints a config
with all defaults filled in, `quadrille init` writes a commented one to start from, and `--set key=value` sets a key
for one run: `--set search.population=24`, `--set 'domain.loop[1].radius_m=20'`.
";

/// The reference as Markdown.
pub fn reference() -> String {
    let schema = config_schema();
    let mut out = HEAD.to_owned();
    table(&mut out, &schema, "", "the whole file");
    out
}

/// One table and, after it, the tables inside.
fn table(out: &mut String, schema: &Json, path: &str, title: &str) {
    let Some(keys) = properties(schema) else { return };
    let _ = write!(out, "\n## {title}\n\n");
    if let (Some(text), false) = (description(schema), path.is_empty()) {
        let _ = write!(out, "{text}\n\n");
    }
    if keys.is_empty() {
        out.push_str("No keys.\n");
        return;
    }
    out.push_str("| key | allowed | default | meaning |\n|---|---|---|---|\n");
    let needed = required(schema);
    for (name, key) in keys {
        let default = match key.get("default") {
            _ if needed.contains(&name.as_str()) => "required".to_owned(),
            Some(value) => default_of(value),
            None => "none".into(),
        };
        let cells = [format!("`{name}`"), kinds(key), default, meaning(key)];
        let _ = writeln!(
            out,
            "| {} |",
            cells.map(|cell| cell.replace('|', "\\|").replace('\n', " ")).join(" | ")
        );
    }
    for (name, key) in keys {
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        inside(out, key, &path);
    }
}

/// The tables that a key holds: itself, the entries of a list, or those of a table with free names.
fn inside(out: &mut String, key: &Json, path: &str) {
    let tables: Vec<&Json> =
        alternatives(key).into_iter().filter(|schema| is_type(schema, "object")).collect();
    let several = tables.len() > 1;
    for schema in tables {
        let title = match (tag(schema), several) {
            (Some(kind), _) => format!("`[{path}]` with `kind = \"{kind}\"`"),
            (None, true) => format!("`[{path}]` with `{}`", required(schema).join("`, `")),
            (None, false) => format!("`[{path}]`"),
        };
        table(out, schema, path, &title);
        if let Some(entry) = schema.get("additionalProperties").filter(|entry| entry.is_object()) {
            inside(out, entry, &format!("{path}.<name>"));
        }
    }
    if let Some(entry) = key.get("items").filter(|_| is_type(key, "array")) {
        inside(out, entry, &format!("[{path}]"));
    }
}

fn description(schema: &Json) -> Option<&str> {
    schema.get("description").and_then(Json::as_str)
}

/// What is allowed, tables by name only, since they follow.
fn kinds(key: &Json) -> String {
    let tables = alternatives(key).into_iter().filter(|schema| is_type(schema, "object")).count();
    match tables {
        0 => allowed(key),
        _ if tables == alternatives(key).len() => "a table, see below".into(),
        _ => {
            let others =
                alternatives(key).into_iter().filter(|schema| !is_type(schema, "object")).map(allowed);
            format!("{}, or a table, see below", others.collect::<Vec<_>>().join(", or "))
        }
    }
}

/// The description, and what each word means.
fn meaning(key: &Json) -> String {
    let words = alternatives(key).into_iter().filter_map(|schema| {
        let word = schema.get("const").and_then(Json::as_str)?;
        Some(format!("`\"{word}\"`: {}", description(schema)?))
    });
    let parts: Vec<String> = description(key).map(str::to_owned).into_iter().chain(words).collect();
    parts.join(" ")
}

/// A default as it would be written; a table only if it is small, since its keys are listed with theirs.
fn default_of(value: &Json) -> String {
    match value {
        Json::Object(table) if table.len() > 1 => "see below".into(),
        other => format!("`{}`", inline(other)),
    }
}

fn inline(value: &Json) -> String {
    match value {
        Json::Object(table) => {
            let entries: Vec<String> =
                table.iter().map(|(key, value)| format!("{key} = {}", inline(value))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
        Json::Array(list) => format!("[{}]", list.iter().map(inline).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}
