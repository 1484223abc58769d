//! Words of commands that a user is told to type.

/// A word as a shell takes it: in quotes where it holds more than letters, digits and `-_./=`.
pub fn quote(word: &str) -> String {
    match !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "-_./=".contains(c)) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}
