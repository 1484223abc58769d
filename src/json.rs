//! JSON that users and other programs write, read with errors in their words.

use serde::de::DeserializeOwned;

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
    if key.is_empty() { String::new() } else { format!("{key}: ") }
}

/// What serde calls the types of Rust, and what a user calls them.
const WORDS: [(&str, &str); 5] = [
    ("expected u32", "expected a whole number ≥ 0"),
    ("expected u64", "expected a whole number ≥ 0"),
    ("expected f64", "expected a number"),
    ("expected a sequence", "expected a list"),
    ("missing field", "missing key"),
];

/// Words that other programs write for numbers that JSON does not have, in small letters.
const NO_NUMBERS: [&str; 7] = ["nan", "inf", "infinity", "1.#qnan", "1.#ind", "1.#inf", "nan(ind)"];

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
        None => WORDS.iter().fold(error.to_string(), |text, (from, to)| text.replace(from, to)),
    };
    JsonError { key: key.to_owned(), message }
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
    fn errors_speak_of_numbers_and_places() {
        type Faces = std::collections::BTreeMap<String, Vec<[u32; 2]>>;
        let error = |text: &str| read::<Faces>(text).expect_err("wrong").to_string();
        assert_eq!(
            error(r#"{"faces": [[0, 1], [2, -3]]}"#),
            "faces[1][1]: invalid value: integer `-3`, expected a whole number ≥ 0 at line 1 column 25"
        );
        assert_eq!(error("{} x"), "trailing characters at line 1 column 4");
        for word in ["NaN", "nan", "-Infinity", "Infinity", "-inf", "1.#QNAN"] {
            let text = error(&format!("{{\"faces\":\n [[0, 1], [2, {word}]]}}"));
            assert!(text.starts_with(&format!("faces[1][1]: found {word}, which is no number")), "{text}");
            assert!(text.contains("line 2"), "{text}");
        }
        assert_eq!(read::<Faces>("\u{feff}{}"), Ok(Faces::new()));
        assert_eq!(error(""), "EOF while parsing a value at line 1 column 0");
    }
}
