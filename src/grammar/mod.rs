//! Strings and what they mean: tokens, marker, strip addition and deletion, decoding (GRAMMAR §2–§5).
