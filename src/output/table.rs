//! Tables as CSV: RFC 4180 with line feeds, and a copy for a spreadsheet with decimal commas.

use super::number::shortest;
use std::io::{self, Write};

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number; one that is not finite is written as an empty cell.
    Number(f64),
    /// A count.
    Count(u64),
    /// `true` or `false`.
    Bool(bool),
    /// No such value.
    Empty,
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Empty, Self::Number)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<bool> for Cell {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}

impl From<u64> for Cell {
    fn from(value: u64) -> Self {
        Self::Count(value)
    }
}

impl Cell {
    /// As in a canonical file, before quoting.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => shortest(*number).unwrap_or_default(),
            Self::Count(count) => count.to_string(),
            Self::Bool(value) => value.to_string(),
            Self::Empty => String::new(),
        }
    }
}

/// A header and rows of as many cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns, with units.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub fn new(columns: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// The table as a file of the given dialect.
    pub fn to_bytes(&self, dialect: Dialect) -> Vec<u8> {
        let mut out = Vec::new();
        // Memory takes whatever is written.
        let _ = dialect.write(&mut out, &self.columns, self.rows.iter().map(Vec::as_slice));
        out
    }

    /// As canonical CSV.
    pub fn to_csv(&self) -> Vec<u8> {
        self.to_bytes(Dialect::Canonical)
    }
}

/// How a table is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Dialect {
    /// UTF-8, comma, decimal point, line feeds, no byte order mark.
    Canonical,
    /// For a spreadsheet in most of Europe: byte order mark, semicolon, decimal comma, CR LF.
    ExcelEu,
}

impl Dialect {
    /// Writes a header and rows, each as it comes: a long table need not be in memory as a whole.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(
        self,
        out: &mut dyn Write,
        columns: &[String],
        rows: impl Iterator<Item = impl AsRef<[Cell]>>,
    ) -> io::Result<()> {
        if self == Self::ExcelEu {
            out.write_all(b"\xEF\xBB\xBF")?;
        }
        self.write_line(out, columns.iter().cloned())?;
        rows.into_iter()
            .try_for_each(|row| self.write_line(out, row.as_ref().iter().map(|cell| self.text(cell))))
    }

    fn text(self, cell: &Cell) -> String {
        match (self, cell) {
            (Self::ExcelEu, Cell::Number(_)) => cell.text().replace('.', ","),
            _ => cell.text(),
        }
    }

    fn write_line(self, out: &mut dyn Write, fields: impl Iterator<Item = String>) -> io::Result<()> {
        let (separator, end) = match self {
            Self::Canonical => (",", "\n"),
            Self::ExcelEu => (";", "\r\n"),
        };
        let fields: Vec<String> = fields.map(|field| quote(field, separator)).collect();
        // A lone empty field would look like an empty line, which readers skip.
        let line = if fields == [""] { "\"\"".to_owned() } else { fields.join(separator) };
        out.write_all(line.as_bytes())?;
        out.write_all(end.as_bytes())
    }
}

/// Quotes a field that needs it (RFC 4180 §2.5–2.7).
fn quote(field: String, separator: &str) -> String {
    if field.contains(separator) || field.contains(['"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(["id", "string", "mass_kg", "feasible", "reason"]);
        table.rows.push(vec!["a1".into(), "".into(), 1.5.into(), true.into(), Cell::Empty]);
        table.rows.push(vec![
            "b2".into(),
            "ATA*".into(),
            f64::NAN.into(),
            false.into(),
            "a, \"b\"; c".into(),
        ]);
        table
    }

    #[test]
    fn canonical() {
        let text = String::from_utf8(table().to_csv()).unwrap();
        assert_eq!(
            text,
            "id,string,mass_kg,feasible,reason\na1,,1.5,true,\nb2,ATA*,,false,\"a, \"\"b\"\"; c\"\n"
        );
    }

    #[test]
    fn canonical_reads_back() {
        let bytes = table().to_csv();
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows[1].iter().collect::<Vec<_>>(), ["b2", "ATA*", "", "false", "a, \"b\"; c"]);
    }

    #[test]
    fn excel_eu() {
        let bytes = table().to_bytes(Dialect::ExcelEu);
        assert_eq!(&bytes[..3], [0xEF, 0xBB, 0xBF]);
        let text = String::from_utf8(bytes[3..].to_vec()).unwrap();
        assert_eq!(
            text,
            "id;string;mass_kg;feasible;reason\r\na1;;1,5;true;\r\nb2;ATA*;;false;\"a, \"\"b\"\"; c\"\r\n"
        );
    }
}
