//! Bytes of a file as text: what editors, spreadsheets and shells put around it.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The text of a file in UTF-8, or in UTF-16 with a byte order mark, as spreadsheets ("Unicode text") and PowerShell write it; without
/// that mark.
///
/// # Errors
/// The line (from 1) that is in another encoding, and what to do.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, (usize, String)> {
    if let Some(text) = utf16(bytes) {
        return text.map(Cow::Owned);
    }
    let bytes = without_mark(bytes);
    std::str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        (line, "not in UTF-8; save the file as UTF-8".to_owned())
    })
}

/// What is read of a file at most: a device or a pipe that never ends would fill the memory.
const MOST_BYTES: u64 = 1 << 30;

/// The text of a file on the disk, or of stdin where it is called `-` ([`decode`]).
///
/// # Errors
/// It cannot be read, has more than a gigabyte, or is in another encoding; then the line is told.
pub fn read(file: &Path) -> io::Result<String> {
    match file == Path::new("-") {
        true => whole(io::stdin().lock(), MOST_BYTES),
        false => whole(File::open(file)?, MOST_BYTES),
    }
}

fn whole(from: impl Read, most: u64) -> io::Result<String> {
    let mut bytes = Vec::new();
    from.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let message =
            format!("more than {most} bytes: a device, a pipe that does not end, or no file of this kind");
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    owned(&bytes)
}

/// As [`decode`], with the error as that of reading.
///
/// # Errors
/// The bytes are in another encoding.
pub fn owned(bytes: &[u8]) -> io::Result<String> {
    let wrong = |(line, reason)| io::Error::new(io::ErrorKind::InvalidData, format!("line {line}: {reason}"));
    decode(bytes).map(Cow::into_owned).map_err(wrong)
}

/// As [`decode`], but bytes that are not UTF-8 become `�`: comments and names may be in any encoding.
///
/// # Errors
/// A file that is no text.
pub fn decode_lossy(bytes: &[u8]) -> Result<Cow<'_, str>, (usize, String)> {
    if let Some(text) = utf16(bytes) {
        return text.map(Cow::Owned);
    }
    if let Some(at) = bytes.iter().position(|&byte| byte == 0) {
        let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
        return Err((
            line,
            "a zero byte: this is no text file, or one in UTF-16; save it as UTF-8".to_owned(),
        ));
    }
    Ok(String::from_utf8_lossy(without_mark(bytes)))
}

fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

/// A text that begins with the byte order mark of UTF-16.
fn utf16(bytes: &[u8]) -> Option<Result<String, (usize, String)>> {
    let (rest, low_first) = match bytes {
        // Of UTF-32, whose texts of the languages on earth have a zero in every fourth place.
        [0xFF, 0xFE, 0, 0, ..] | [0, 0, 0xFE, 0xFF, ..] => {
            return Some(Err((1, "a text in UTF-32; save the file as UTF-8".to_owned())));
        }
        [0xFF, 0xFE, rest @ ..] => (rest, true),
        [0xFE, 0xFF, rest @ ..] => (rest, false),
        _ => return None,
    };
    let unit = |pair: &[u8]| match low_first {
        true => u16::from_le_bytes([pair[0], pair[1]]),
        false => u16::from_be_bytes([pair[0], pair[1]]),
    };
    let units: Vec<u16> = rest.chunks_exact(2).map(unit).collect();
    let whole = rest.len() % 2 == 0;
    let text = String::from_utf16(&units).ok().filter(|_| whole);
    Some(text.ok_or_else(|| (1, "a broken text in UTF-16; save the file as UTF-8".to_owned())))
}

/// The lines of a text, which may end in LF, CR LF or CR alone.
pub fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.find(['\n', '\r']) else {
            rest = None;
            return (!text.is_empty()).then_some(text);
        };
        let width = if text[end..].starts_with("\r\n") { 2 } else { 1 };
        rest = Some(&text[end + width..]);
        Some(&text[..end])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_line_ends() {
        let of = |text| lines(text).collect::<Vec<_>>();
        assert_eq!(of("a\nb\r\nc\rd"), ["a", "b", "c", "d"]);
        assert_eq!(of("a\r\r\nb\n"), ["a", "", "b"]);
        assert_eq!(of(""), [""; 0]);
    }

    #[test]
    fn what_never_ends_is_refused() {
        assert_eq!(whole(&b"abc"[..], 3).unwrap(), "abc");
        let endless = whole(io::repeat(b'a'), 3).unwrap_err().to_string();
        assert!(endless.starts_with("more than 3 bytes"), "{endless}");
    }

    #[test]
    fn encodings() {
        assert_eq!(decode(b"\xEF\xBB\xBFa").unwrap(), "a");
        assert_eq!(decode(b"\xFF\xFEa\0\xE9\0").unwrap(), "aé");
        assert_eq!(decode(b"\xFE\xFF\0a\0\xE9").unwrap(), "aé");
        assert_eq!(decode(b"a\nb\xE9").unwrap_err().0, 2);
        for bytes in [&b"\xFF\xFE\0\0a\0\0\0"[..], b"\0\0\xFE\xFF\0\0\0a"] {
            assert!(decode(bytes).unwrap_err().1.contains("UTF-32"));
        }
        assert_eq!(decode_lossy(b"a\xE9").unwrap(), "a\u{FFFD}");
        for bytes in [&b"a\n\0"[..], b"\xFF\xFEa", b"\xFF\xFE\0\xD8"] {
            assert!(decode_lossy(bytes).unwrap_err().1.contains("UTF-8"));
        }
    }
}
