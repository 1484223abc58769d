//! The alphabet and the strings over it (docs/reference/grammar.md §2), and the two distances between strings (§6.4).

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};
use std::str::FromStr;

/// One rule of the grammar. `A*` is one token.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Token {
    /// `T`: go along the marker's edge, then turn left.
    Turn,
    /// `P`: rotate clockwise about the position.
    Pivot,
    /// `D`: delete the strip of the marker's edge.
    Delete,
    /// `A`: start or stop collecting a polyedge; a regular end.
    Add,
    /// `A*`: as `A`, with a pole at this end.
    AddPole,
    /// `A°`: as `A`, and the polyedge is closed.
    AddClosed,
}

impl Token {
    /// All tokens, in the order in which the paper and the printed form list them.
    pub const ALL: [Self; 6] =
        [Self::Turn, Self::Pivot, Self::Delete, Self::Add, Self::AddPole, Self::AddClosed];

    /// The printed form: `T P D A A* Ao`.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Turn => "T",
            Self::Pivot => "P",
            Self::Delete => "D",
            Self::Add => "A",
            Self::AddPole => "A*",
            Self::AddClosed => "Ao",
        }
    }

    /// True for `A`, `A*` and `A°`.
    pub fn is_addition(self) -> bool {
        matches!(self, Self::Add | Self::AddPole | Self::AddClosed)
    }
}

impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// A string of the grammar, as tokens. Prints without separators (`ATTPA*`) and parses what it prints.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Tokens(pub Vec<Token>);

/// A character that belongs to no token.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("unexpected {found:?} at character {position}: a string is made of T, P, D, A, A* and A° (or Ao)")]
pub struct ParseTokensError {
    /// 0-based position in characters of the string as given, spaces counted.
    pub position: usize,
    /// The offending character.
    pub found: char,
}

impl FromStr for Tokens {
    type Err = ParseTokensError;

    /// Reads case-insensitively; `°`, `o` and `O` are alike; U+0020 is ignored, also inside a token.
    fn from_str(text: &str) -> Result<Self, ParseTokensError> {
        let mut tokens: Vec<Token> = Vec::with_capacity(text.len());
        for (position, found) in text.chars().enumerate() {
            match (found, tokens.last_mut()) {
                (' ', _) => {}
                ('T' | 't', _) => tokens.push(Token::Turn),
                ('P' | 'p', _) => tokens.push(Token::Pivot),
                ('D' | 'd', _) => tokens.push(Token::Delete),
                ('A' | 'a', _) => tokens.push(Token::Add),
                ('*', Some(last @ Token::Add)) => *last = Token::AddPole,
                ('°' | 'o' | 'O', Some(last @ Token::Add)) => *last = Token::AddClosed,
                _ => return Err(ParseTokensError { position, found }),
            }
        }
        Ok(Self(tokens))
    }
}

impl fmt::Display for Tokens {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|token| f.write_str(token.as_str()))
    }
}

impl Serialize for Tokens {
    /// As it is printed.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Tokens {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl Deref for Tokens {
    type Target = Vec<Token>;

    fn deref(&self) -> &Vec<Token> {
        &self.0
    }
}

impl DerefMut for Tokens {
    fn deref_mut(&mut self) -> &mut Vec<Token> {
        &mut self.0
    }
}

impl FromIterator<Token> for Tokens {
    fn from_iter<I: IntoIterator<Item = Token>>(tokens: I) -> Self {
        Self(tokens.into_iter().collect())
    }
}

impl Tokens {
    /// Levenshtein distance: fewest insertions, removals and substitutions of tokens, each counting 1
    /// (Wagner, Fischer 1974; one row of the table at a time).
    pub fn levenshtein(&self, other: &Self) -> usize {
        let mut row: Vec<usize> = (0..=other.len()).collect();
        for (i, a) in self.iter().enumerate() {
            let mut diagonal = std::mem::replace(&mut row[0], i + 1);
            for (j, b) in other.iter().enumerate() {
                let substituted = diagonal + usize::from(a != b);
                diagonal = row[j + 1];
                row[j + 1] = substituted.min(diagonal + 1).min(row[j] + 1);
            }
        }
        row[other.len()]
    }

    /// Hamming distance, `None` when the lengths differ.
    pub fn hamming(&self, other: &Self) -> Option<usize> {
        (self.len() == other.len()).then(|| self.iter().zip(other.iter()).filter(|(a, b)| a != b).count())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Tokens {
        text.parse().unwrap()
    }

    #[test]
    fn prints_what_it_reads() {
        for text in ["", "ATTPA*", "AoTDA"] {
            assert_eq!(tokens(text).to_string(), text);
        }
        assert_eq!(tokens(" a ° t p A * d").to_string(), "AoTPA*D");
    }

    #[test]
    fn names_the_offending_character() {
        let error = "ATX".parse::<Tokens>().unwrap_err();
        assert_eq!(error, ParseTokensError { position: 2, found: 'X' });
        assert!(error.to_string().contains("'X' at character 2"), "{error}");
        assert_eq!("AT\tP".parse::<Tokens>().unwrap_err().position, 2);
        assert_eq!("é°".parse::<Tokens>().unwrap_err().position, 0);
        assert_eq!("A°°".parse::<Tokens>().unwrap_err().position, 2, "positions count characters, not bytes");
    }

    #[test]
    fn distances_work_on_tokens() {
        assert_eq!(tokens("ATA*").levenshtein(&tokens("ATA")), 1, "A* for A is one substitution");
        assert_eq!(tokens("TTP").levenshtein(&tokens("")), 3);
        assert_eq!(tokens("TAPP").levenshtein(&tokens("TAPPPAoTA")), 4);
        assert_eq!(tokens("ATA").hamming(&tokens("ATAo")), Some(1));
        assert_eq!(tokens("AT").hamming(&tokens("A")), None);
    }
}
