//! Tables as CSV: RFC 4180 with line feeds, and a copy for a spreadsheet with decimal commas.

use super::number::{push_integer, push_shortest};
use std::io::{self, Write};

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words. None at all, which the empty string is, are written as `""`: an empty cell is a missing value.
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
    /// Words where there are any, such as a reason: without them the value is missing.
    pub fn words(text: &str) -> Self {
        if text.is_empty() { Self::Empty } else { text.into() }
    }

    /// As in a canonical file, before quoting.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        self.push(&mut text);
        text
    }

    /// Appends it.
    fn push(&self, text: &mut String) {
        match self {
            Self::Text(words) => text.push_str(words),
            Self::Number(number) => push_shortest(text, *number),
            Self::Count(count) => push_integer(text, *count),
            Self::Bool(value) => text.push_str(if *value { "true" } else { "false" }),
            Self::Empty => {}
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
        let columns: Vec<Cell> = columns.iter().map(|name| name.as_str().into()).collect();
        let mut line = String::new();
        self.write_line(out, &mut line, &columns)?;
        rows.into_iter().try_for_each(|row| self.write_line(out, &mut line, row.as_ref()))
    }

    /// Writes a line by way of `line`, room that is used again for the next.
    fn write_line(self, out: &mut dyn Write, line: &mut String, cells: &[Cell]) -> io::Result<()> {
        let (separator, end) = match self {
            Self::Canonical => (',', "\n"),
            Self::ExcelEu => (';', "\r\n"),
        };
        line.clear();
        for (place, cell) in cells.iter().enumerate() {
            if place > 0 {
                line.push(separator);
            }
            let start = line.len();
            cell.push(line);
            match cell {
                Cell::Text(text) if needs_quotes(text, separator) => {
                    line.truncate(start);
                    line.push('"');
                    line.push_str(&text.replace('"', "\"\""));
                    line.push('"');
                }
                Cell::Number(_) if self == Self::ExcelEu => {
                    if let Some(point) = line[start..].find('.') {
                        line.replace_range(start + point..=start + point, ",");
                    }
                }
                _ => {}
            }
        }
        // A lone empty field would look like an empty line, which readers skip.
        if line.is_empty() && cells.len() == 1 {
            line.push_str("\"\"");
        }
        line.push_str(end);
        out.write_all(line.as_bytes())
    }
}

/// Whether a field would otherwise be taken for several (RFC 4180 §2.5–2.7) or for none.
fn needs_quotes(field: &str, separator: char) -> bool {
    field.is_empty() || field.contains([separator, '"', '\n', '\r'])
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
            "id,string,mass_kg,feasible,reason\na1,\"\",1.5,true,\nb2,ATA*,,false,\"a, \"\"b\"\"; c\"\n"
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
            "id;string;mass_kg;feasible;reason\r\na1;\"\";1,5;true;\r\nb2;ATA*;;false;\"a, \"\"b\"\"; c\"\r\n"
        );
    }
}
