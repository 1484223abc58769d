//! Strings and what they mean: tokens, marker, strip addition and deletion, decoding (docs/reference/grammar.md §2–§5).

pub mod decode;
pub mod random;
pub mod rules;
pub mod tokens;
pub mod walker;

pub use decode::{Decoded, decode};
pub use rules::{Rules, Skip};
pub use tokens::{ParseTokensError, Token, Tokens};
pub use walker::{Added, Deleted, Effect, Walker};
