//! Where a key is: `domain.loop[1].radius_m`.

use std::fmt;

/// One step of a [`KeyPath`].
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Segment {
    /// Into a table.
    Key(String),
    /// Into an array, from 0.
    Index(usize),
}

/// The path of a key in a config, from its root.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct KeyPath(pub Vec<Segment>);

impl KeyPath {
    /// Reads `a.b[1].c` or `a.b.1.c`. Empty parts are kept as empty keys, which no table has.
    pub fn of(text: &str) -> Self {
        let mut segments = Vec::new();
        for part in text.split('.') {
            let (name, indices) = part.split_once('[').map_or((part, ""), |(name, rest)| (name, rest));
            segments.push(match name.parse() {
                Ok(index) if !segments.is_empty() => Segment::Index(index),
                _ => Segment::Key(name.trim().to_owned()),
            });
            let indices = indices.split('[').filter_map(|i| i.trim_end_matches(']').parse().ok());
            segments.extend(indices.map(Segment::Index));
        }
        Self(segments)
    }

    /// The path of a key of the table that this path leads to.
    pub fn key(&self, name: impl Into<String>) -> Self {
        self.with(Segment::Key(name.into()))
    }

    /// The path of an entry of the array that this path leads to.
    pub fn index(&self, index: usize) -> Self {
        self.with(Segment::Index(index))
    }

    fn with(&self, segment: Segment) -> Self {
        let mut segments = self.0.clone();
        segments.push(segment);
        Self(segments)
    }

    /// Whether this path leads to `other` or to something that holds it.
    pub fn holds(&self, other: &Self) -> bool {
        other.0.starts_with(&self.0)
    }
}

impl From<&str> for KeyPath {
    fn from(text: &str) -> Self {
        Self::of(text)
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Key(name) if i == 0 => f.write_str(name)?,
                Segment::Key(name) => write!(f, ".{name}")?,
                Segment::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_prints() {
        let path = KeyPath::default().key("domain").key("loop").index(1).key("points_m").index(3).index(0);
        assert_eq!(path.to_string(), "domain.loop[1].points_m[3][0]");
        assert_eq!(KeyPath::of(&path.to_string()), path);
        assert_eq!(KeyPath::of("domain.loop.1.points_m.3.0"), path);
    }
}
