//! Reading the files of a results folder, with errors that name file, line and column.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, HashMap};
use std::io;
use std::path::{Path, PathBuf};

/// Why a results folder cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// A file is missing or unreadable.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file does not hold what it should.
    #[error("{}: {what}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and in which line.
        what: String,
    },
}

impl ReadError {
    fn content(path: &Path, what: impl Into<String>) -> Self {
        Self::Content { path: path.to_owned(), what: what.into() }
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    std::fs::read(path).map_err(|source| ReadError::Io { path: path.to_owned(), source })
}

/// A JSON file.
pub(super) fn json<T: DeserializeOwned>(path: &Path) -> Result<T, ReadError> {
    serde_json::from_slice(&bytes(path)?).map_err(|error| ReadError::content(path, error.to_string()))
}

/// A CSV file in memory.
pub(super) struct Sheet {
    path: PathBuf,
    header: csv::StringRecord,
    place: HashMap<String, usize>,
    records: Vec<csv::StringRecord>,
}

impl Sheet {
    pub(super) fn read(path: &Path) -> Result<Self, ReadError> {
        let bytes = bytes(path)?;
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let wrong = |error: csv::Error| ReadError::content(path, error.to_string());
        let header = reader.headers().map_err(wrong)?.clone();
        let place = header.iter().enumerate().map(|(i, name)| (name.to_owned(), i)).collect();
        let records = reader.records().collect::<Result<_, _>>().map_err(wrong)?;
        Ok(Self { path: path.to_owned(), header, place, records })
    }

    pub(super) fn columns(&self) -> impl Iterator<Item = &str> {
        self.header.iter()
    }

    pub(super) fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        self.records.iter().map(|record| Line { sheet: self, record })
    }

    /// The error of a column that is not there.
    pub(super) fn lacks(&self, column: &str) -> ReadError {
        ReadError::content(&self.path, format!("there is no column {column}"))
    }
}

/// A line of a [`Sheet`].
pub(super) struct Line<'a> {
    sheet: &'a Sheet,
    record: &'a csv::StringRecord,
}

impl<'a> Line<'a> {
    pub(super) fn text(&self, column: &str) -> Result<&'a str, ReadError> {
        let place = self.sheet.place.get(column);
        place.and_then(|&place| self.record.get(place)).ok_or_else(|| self.sheet.lacks(column))
    }

    /// `None` for an empty cell.
    pub(super) fn number(&self, column: &str) -> Result<Option<f64>, ReadError> {
        match self.text(column)? {
            "" => Ok(None),
            text => text.parse().map(Some).map_err(|_| self.wrong(column, text, "number")),
        }
    }

    pub(super) fn count(&self, column: &str) -> Result<u64, ReadError> {
        let text = self.text(column)?;
        text.parse().map_err(|_| self.wrong(column, text, "count"))
    }

    fn wrong(&self, column: &str, found: &str, expected: &str) -> ReadError {
        let line = self.record.position().map_or(0, csv::Position::line);
        ReadError::content(&self.sheet.path, format!("line {line}, {column}: {found:?} is no {expected}"))
    }
}

#[derive(Deserialize)]
struct CompasFile {
    data: CompasMesh,
}

#[derive(Deserialize)]
struct CompasMesh {
    vertex: BTreeMap<u32, CompasVertex>,
    face: BTreeMap<u32, Vec<u32>>,
}

#[derive(Deserialize)]
struct CompasVertex {
    x: f64,
    y: f64,
    z: f64,
}

type Shape = (Vec<[f64; 3]>, Vec<Vec<u32>>);

/// Positions and panels of a COMPAS mesh as this program writes it; `None` if there is no such file.
pub(super) fn compas(path: &Path) -> Result<Option<Shape>, ReadError> {
    if !path.exists() {
        return Ok(None);
    }
    let CompasMesh { vertex, face } = json::<CompasFile>(path)?.data;
    let number: HashMap<u32, u32> = vertex.keys().zip(0..).map(|(&key, i)| (key, i)).collect();
    let panel = |(key, corners): (u32, Vec<u32>)| {
        let corners: Option<Vec<u32>> = corners.iter().map(|v| number.get(v).copied()).collect();
        corners.filter(|corners| (3..=4).contains(&corners.len())).ok_or_else(|| {
            ReadError::content(path, format!("face {key} is no triangle or quad of its vertices"))
        })
    };
    let panels = face.into_iter().map(panel).collect::<Result<_, _>>()?;
    Ok(Some((vertex.into_values().map(|v| [v.x, v.y, v.z]).collect(), panels)))
}

/// Utilisation of each edge from a table of members, `from` and `to` being vertices; of an edge of several members the
/// largest. Empty if there is no such file.
pub(super) fn utilisation(path: &Path, edges: &[[u32; 2]]) -> Result<Vec<Option<f64>>, ReadError> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let sheet = Sheet::read(path)?;
    let mut of_edge: HashMap<[u32; 2], f64> = HashMap::new();
    for line in sheet.lines() {
        let (a, b) = (line.count("from")? as u32, line.count("to")? as u32);
        if let Some(value) = line.number("utilisation")? {
            let largest = of_edge.entry([a.min(b), a.max(b)]).or_insert(value);
            *largest = largest.max(value);
        }
    }
    Ok(edges.iter().map(|edge| of_edge.get(edge).copied()).collect())
}
