//! Keys of before, and what is there instead.

use super::Config;
use toml::{Table, Value};

/// Keys, and tables whose keys are all meant.
const RETIRED: [(&str, &str); 5] = [
    ("search.initial.seeds", "it is search.seeds now, which also takes a results folder"),
    ("search.screen", "it is gone: it found nothing more in the same time (docs/search.md)"),
    ("search.archive", "it is gone: with search.local children come from the whole front"),
    ("search.crossover_kinds", "it is gone: all kinds of crossover are as likely as each other"),
    (
        "search.rules",
        "it is gone: search.local is the share of children that are a strip or two away from what is good so far",
    ),
];

/// What is said of a key that was there once.
pub(super) fn instead_of(key: &str) -> Option<&'static str> {
    RETIRED.iter().find(|(path, _)| *path == key).map(|(_, instead)| *instead)
}

/// The config that a run recorded, as [`to_toml`](super::to_toml) wrote it; also one of before, whose retired keys say only how that run
/// searched.
///
/// # Errors
/// It is no config.
pub fn recorded(text: &str) -> Result<Config, toml::de::Error> {
    let mut values: Table = toml::from_str(text)?;
    for (key, _) in RETIRED {
        remove(&mut values, key);
    }
    let is_retired = |kind: &mut Value| matches!(kind.as_str(), Some("uniform" | "structured"));
    if values.get_mut("search").and_then(|s| s.get_mut("initial")?.get_mut("kind")).is_some_and(is_retired) {
        remove(&mut values, "search.initial.kind");
    }
    values.try_into()
}

/// Removes a dotted key, if it is there.
fn remove(table: &mut Table, key: &str) {
    match key.split_once('.') {
        None => drop(table.remove(key)),
        Some((first, rest)) => {
            if let Some(Value::Table(inner)) = table.get_mut(first) {
                remove(inner, rest);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_runs_of_before_recorded_is_read() {
        let ci =
            include_str!("../../configs/ci.toml").replace("initial = { kind = \"near\", near = 36 }\n", "");
        let before = "screen = 1\n[search.initial]\nkind = \"uniform\"\nseeds = [\"\"]\n[search.rules]\nappend_strip = 0.3\n";
        let text = format!("{ci}\n{before}");
        assert!(toml::from_str::<Config>(&text).is_err());
        assert_eq!(recorded(&text).unwrap(), toml::from_str::<Config>(&ci).unwrap());
        assert!(recorded("version = 1\nnonsense = 2").is_err());
    }
}
