//! Whether a run may go on with a config.

use std::collections::BTreeMap;

use serde_json::Value;

/// Keys that may differ: they change neither what is evaluated nor in which order, only how long and how fast.
const FREE: [&str; 5] =
    ["run.threads", "search.generations", "search.evaluations", "search.minutes", "search.stall_generations"];

/// The dotted keys in which two resolved configs differ, threads and stopping limits left aside. Sorted.
pub fn differing_keys(recorded: &Value, given: &Value) -> Vec<String> {
    let (recorded, given) = (leaves(recorded), leaves(given));
    let mut keys: Vec<String> = recorded
        .iter()
        .filter(|(key, value)| given.get(*key) != Some(value))
        .map(|(key, _)| key.clone())
        .collect();
    keys.extend(given.keys().filter(|key| !recorded.contains_key(*key)).cloned());
    keys.retain(|key| !FREE.contains(&key.as_str()));
    keys.sort();
    keys.into_iter().map(in_words).collect()
}

/// A key as it is told: a file that the config names has no key of its own.
fn in_words(key: String) -> String {
    match key.strip_prefix("input_files.") {
        Some(file) => format!("what is in the file {file}"),
        None => key,
    }
}

/// Every value that is not an object, under its dotted key.
fn leaves(value: &Value) -> BTreeMap<String, &Value> {
    fn collect<'a>(key: String, value: &'a Value, leaves: &mut BTreeMap<String, &'a Value>) {
        match value {
            // A key without a value is a key that is not there.
            Value::Null => {}
            Value::Object(entries) => {
                for (name, value) in entries {
                    let key = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
                    collect(key, value, leaves);
                }
            }
            _ => {
                leaves.insert(key, value);
            }
        }
    }
    let mut found = BTreeMap::new();
    collect(String::new(), value, &mut found);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn names_what_differs_but_not_the_limits() {
        let recorded =
            json!({"run": {"seed": 1, "threads": 2}, "search": {"generations": 3, "population": 8}});
        let same = json!({"run": {"seed": 1, "threads": 0}, "search": {"generations": 9, "population": 8, "minutes": 1.0}});
        assert!(differing_keys(&recorded, &same).is_empty());
        let other = json!({"run": {"seed": 2}, "search": {"generations": 3}, "pattern": {"panels": 5}});
        assert_eq!(differing_keys(&recorded, &other), ["pattern.panels", "run.seed", "search.population"]);
        let file = |sum: &str| json!({"input_files": {"in/roof.obj": sum}});
        assert_eq!(differing_keys(&file("a"), &file("b")), ["what is in the file in/roof.obj"]);
    }
}
