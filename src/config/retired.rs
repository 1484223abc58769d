//! Keys of before, and what is there instead.

/// Whole paths, or ends of them.
const RETIRED: [(&str, &str); 1] =
    [("search.initial.seeds", "it is search.seeds now, which also takes a results folder")];

/// What is said of a key that was there once.
pub(super) fn instead_of(key: &str) -> Option<&'static str> {
    RETIRED.iter().find(|(path, _)| *path == key).map(|(_, instead)| *instead)
}
