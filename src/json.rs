//! JSON that users and other programs write, read with errors in their words.

use serde::de::{
    Deserialize, DeserializeOwned, Deserializer, MapAccess, Visitor, value::MapAccessDeserializer,
};
use std::fmt;
use std::marker::PhantomData;

/// Why a text is not what was expected: the place in it, by keys, and what is wrong there, with line and column.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}{message}", place(.key))]
pub struct JsonError {
    /// Keys and indices that lead there, as in `faces[0][2]`; empty for the whole.
    pub key: String,
    /// What is wrong, with line and column.
    pub message: String,
}

fn place(key: &str) -> String {
    if key.is_empty() { String::new() } else { format!("{}: ", shown(key)) }
}

/// A text of the file as a terminal may show it: control characters escaped, and not longer than a line.
fn shown(text: &str) -> String {
    const MOST: usize = 200;
    let escape = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    let start: String = text.chars().take(MOST).map(escape).collect();
    if text.chars().nth(MOST).is_some() { format!("{start}…") } else { start }
}

/// What serde calls the types of Rust, and what a user calls them.
const WORDS: [(&str, &str); 10] = [
    ("EOF while parsing a value at line 1 column 0", "the file is empty"),
    ("EOF while parsing", "the file ends within"),
    ("trailing characters", "something follows where nothing may, such as one number too many in a list,"),
    ("invalid type: sequence", "found a list"),
    ("invalid type: map", "found an object"),
    ("expected u32", "expected a whole number ≥ 0"),
    ("expected u64", "expected a whole number ≥ 0"),
    ("expected f64", "expected a number"),
    ("expected a sequence", "expected a list"),
    ("missing field", "missing key"),
];

/// Words that other programs write for numbers that JSON does not have, in small letters.
const NO_NUMBERS: [&str; 7] = ["nan", "inf", "infinity", "1.#qnan", "1.#ind", "1.#inf", "nan(ind)"];

/// An object with keys. serde also takes a bare list for one, in the order of the fields of a Rust struct, which no user
/// knows.
#[derive(Default)]
pub struct Object<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Keys<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Keys<T> {
            type Value = T;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object with the keys of its format")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map))
            }
        }
        deserializer.deserialize_map(Keys(PhantomData)).map(Self)
    }
}

/// Reads one value and nothing after it; a byte order mark may stand before it.
///
/// # Errors
/// [`JsonError`], also for what comes after the value.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let key = error.path().to_string();
        wrong(if key == "." { "" } else { &key }, error.inner(), text)
    })?;
    json.end().map_err(|error| wrong("", &error, text))?;
    Ok(value)
}

fn wrong(key: &str, error: &serde_json::Error, text: &str) -> JsonError {
    let message = match no_number(error, text) {
        Some(word) => format!(
            "found {word}, which is no number: what wrote the file could not compute it, at line {} column {}",
            error.line(),
            error.column()
        ),
        None => {
            let text = error.to_string();
            unknown_name(&text)
                .unwrap_or_else(|| WORDS.iter().fold(text, |text, (from, to)| text.replace(from, to)))
        }
    };
    JsonError { key: key.to_owned(), message }
}

/// What serde says of a key or a word that it does not know, with the nearest that it does.
fn unknown_name(text: &str) -> Option<String> {
    let (what, rest) = [("unknown field `", "key"), ("unknown variant `", "word")]
        .into_iter()
        .find_map(|(start, what)| Some((what, text.strip_prefix(start)?)))?;
    let (name, rest) = rest.split_once('`')?;
    let (list, place) = rest.rfind(" at line ").map_or((rest, ""), |at| rest.split_at(at));
    let known: Vec<&str> = list.split('`').skip(1).step_by(2).collect();
    let hint = suggestion(name, &known);
    Some(format!("unknown {what} `{}`{hint}; allowed here: {}{place}", shown(name), known.join(", ")))
}

/// `, did you mean …?`, if a known word is near.
pub fn suggestion(name: &str, known: &[&str]) -> String {
    let likeness = |word: &&&str| strsim::damerau_levenshtein(name, word);
    let nearest = known.iter().min_by_key(likeness);
    let near = nearest.filter(|word| strsim::damerau_levenshtein(name, word) <= 1 + name.chars().count() / 4);
    near.map_or(String::new(), |word| format!(", did you mean `{word}`?"))
}

/// The word at the place of an error if it is one that stands for no number.
fn no_number<'a>(error: &serde_json::Error, text: &'a str) -> Option<&'a str> {
    let line = text.split('\n').nth(error.line().checked_sub(1)?)?;
    let ends = |c: char| c.is_whitespace() || ",:[]{}\"".contains(c);
    // The error is at the first character that cannot be, which may be within the word.
    let at = (0..=error.column().min(line.len())).rev().find(|&i| line.is_char_boundary(i))?;
    let start = line[..at].rfind(ends).map_or(0, |i| i + 1);
    let candidates = [start, at];
    candidates.into_iter().find_map(|start| {
        let word = line[start..].split(ends).next()?;
        let bare = word.trim_start_matches(['-', '+']).to_lowercase();
        NO_NUMBERS.contains(&bare.as_str()).then_some(word)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_key_is_told_with_the_nearest() {
        #[derive(Debug, serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Two {
            #[serde(rename = "supports")]
            _supports: u32,
            #[serde(rename = "loads")]
            _loads: u32,
        }
        let error = |text: &str| read::<Two>(text).expect_err("wrong").to_string();
        assert_eq!(
            error(r#"{"suports": 1}"#),
            "suports: unknown key `suports`, did you mean `supports`?; allowed here: supports, loads at line 1 column 10"
        );
        assert!(
            error(r#"{"temperature": 1}"#)
                .contains("unknown key `temperature`; allowed here: supports, loads at")
        );
    }

    #[test]
    fn errors_speak_of_numbers_and_places() {
        type Faces = std::collections::BTreeMap<String, Vec<[u32; 2]>>;
        let error = |text: &str| read::<Faces>(text).expect_err("wrong").to_string();
        assert_eq!(
            error(r#"{"faces": [[0, 1], [2, -3]]}"#),
            "faces[1][1]: invalid value: integer `-3`, expected a whole number ≥ 0 at line 1 column 25"
        );
        assert_eq!(
            error("{} x"),
            "something follows where nothing may, such as one number too many in a list, at line 1 column 4"
        );
        for word in ["NaN", "nan", "-Infinity", "Infinity", "-inf", "1.#QNAN"] {
            let text = error(&format!("{{\"faces\":\n [[0, 1], [2, {word}]]}}"));
            assert!(text.starts_with(&format!("faces[1][1]: found {word}, which is no number")), "{text}");
            assert!(text.contains("line 2"), "{text}");
        }
        assert_eq!(read::<Faces>("\u{feff}{}"), Ok(Faces::new()));
        assert_eq!(error(""), "the file is empty");
        let long = error(&format!("{{\"a\\u001b{}\": 1}}", "x".repeat(100_000)));
        assert!(long.len() < 1_000 && !long.contains('\u{1b}'), "{long}");
    }
}
