//! Tables as spreadsheets save them: with commas, with semicolons or tabs and then perhaps decimal commas, `TRUE` for `true`.

/// What stands between two cells of a table that begins like this: the first of `,`, `;` and tab outside quotes in its header, or what
/// Excel's line `sep=;` before it says; and whether there is that line.
pub fn delimiter(start: &[u8]) -> (u8, bool) {
    let start = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(start);
    let first_line = start.split(|byte| b"\r\n".contains(byte)).next().unwrap_or_default();
    if let [b's' | b'S', b'e' | b'E', b'p' | b'P', b'=', delimiter] = *first_line {
        return (delimiter, true);
    }
    let mut is_quoted = false;
    let found = first_line.iter().find(|&&byte| {
        is_quoted ^= byte == b'"';
        !is_quoted && b",;\t".contains(&byte)
    });
    (found.copied().unwrap_or(b','), false)
}

/// A cell as a program writes it: `TRUE` and `FALSE` in small letters; where the delimiter is no comma, a number with a decimal comma
/// with a point.
pub fn plain(cell: &str, delimiter: u8) -> String {
    let cell = cell.trim();
    if cell.eq_ignore_ascii_case("true") || cell.eq_ignore_ascii_case("false") {
        return cell.to_ascii_lowercase();
    }
    let pointed = cell.replacen(',', ".", 1);
    let is_number = delimiter != b',' && cell.contains(',') && pointed.parse::<f64>().is_ok();
    if is_number { pointed } else { cell.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delimiters_of_spreadsheets() {
        for (start, expected) in [
            ("id,string\n1;2", (b',', false)),
            ("\u{feff}id;a,b\r\n", (b';', false)),
            ("\"a,b\";\"c\"\n", (b';', false)),
            ("string\tname", (b'\t', false)),
            ("string", (b',', false)),
            ("sep=;\r\nstring;name", (b';', true)),
        ] {
            assert_eq!(delimiter(start.as_bytes()), expected, "{start:?}");
        }
    }

    #[test]
    fn cells_of_spreadsheets() {
        assert_eq!(plain("TRUE", b','), "true");
        assert_eq!(plain(" -1,5e3", b';'), "-1.5e3");
        assert_eq!(plain("1,5", b','), "1,5");
        assert_eq!(plain("a,b", b';'), "a,b");
        assert_eq!(plain("1,2,3", b';'), "1,2,3");
    }
}
