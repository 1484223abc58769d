//! Strings and what they mean: tokens, marker, strip addition and deletion, decoding (GRAMMAR §2–§5).

pub mod tokens;

pub use tokens::{ParseTokensError, Token, Tokens};
