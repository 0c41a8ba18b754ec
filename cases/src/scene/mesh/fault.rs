//! The faults of mesh files: a place, a description, and a way to fix the fault.

/// Largest number of characters of a file that a message quotes.
const MOST_QUOTED: usize = 80;

/// A fault of a mesh file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what}")]
pub(super) struct Fault {
    /// The place in the file.
    pub place: Place,
    /// A description, in words that follow the place.
    pub what: String,
    /// A way to fix it.
    pub help: String,
}

/// A place in a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Place {
    /// The file as a whole.
    File,
    /// An offset in a text, which messages show as line and column.
    Text(usize),
    /// An offset in the binary part, and the element that it belongs to, such as "face 3".
    Binary(usize, String),
}

impl Fault {
    /// Returns a fault of the file as a whole.
    pub(super) fn of_file(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { place: Place::File, what: what.into(), help: help.into() }
    }

    /// Returns a fault at an offset in a text.
    pub(super) fn at(byte: usize, what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { place: Place::Text(byte), what: what.into(), help: help.into() }
    }

    /// Returns the place and the description, for a file of these bytes that is called `name`.
    pub(super) fn describe(&self, name: &str, bytes: &[u8]) -> String {
        match &self.place {
            Place::File => format!("{name}: {}", self.what),
            Place::Text(byte) => {
                let (line, column) = line_column(bytes, *byte);
                format!("{name}:{line}:{column}: {}", self.what)
            }
            Place::Binary(byte, element) => {
                format!("{name}: byte {byte}, {element}: {}", self.what)
            }
        }
    }
}

/// Returns the line and the column of an offset, both from 1, the column in characters.
///
/// A line ends with CR, LF, or CR and LF. Bytes that are not UTF-8 count as a character each.
fn line_column(bytes: &[u8], at: usize) -> (usize, usize) {
    let before = &bytes[..at.min(bytes.len())];
    let ends = |n: &usize| {
        before[*n] == b'\n' || (before[*n] == b'\r' && bytes.get(n + 1) != Some(&b'\n'))
    };
    let line = (0..before.len()).filter(ends).count() + 1;
    let start = (0..before.len()).rev().find(ends).map_or(0, |n| n + 1);
    let column =
        String::from_utf8_lossy(&before[start..]).trim_start_matches('\u{feff}').chars().count()
            + 1;
    (line, column)
}

/// Quotes bytes as text in a message. A long text is cut, and characters that do not print are
/// escaped.
pub(super) fn quoted(bytes: &[u8]) -> String {
    let start = &bytes[..bytes.len().min(4 * MOST_QUOTED)];
    let mut text = String::from("`");
    let mut room = MOST_QUOTED;
    for char in String::from_utf8_lossy(start).chars() {
        let escaped: String =
            if char == '"' || char == '\'' { char.into() } else { char.escape_debug().collect() };
        let length = escaped.chars().count();
        if length > room {
            return text + "…`";
        }
        room -= length;
        text += &escaped;
    }
    text.push('`');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_three_ways() {
        let bytes = "\u{feff}é b\r\nc\rd\n\ne".as_bytes();
        let place =
            |letter: u8| line_column(bytes, bytes.iter().position(|byte| *byte == letter).unwrap());
        assert_eq!([b'b', b'c', b'd', b'e'].map(place), [(1, 3), (2, 1), (3, 1), (5, 1)]);
        assert_eq!(line_column(b"ab", 2), (1, 3));
        assert_eq!(line_column(b"", 0), (1, 1));
    }

    #[test]
    fn quotes_are_short_and_print() {
        assert_eq!(quoted(b"v 1"), "`v 1`");
        assert_eq!(quoted(b"\x1b[31m\0\xff"), "`\\u{1b}[31m\\0\u{fffd}`");
        for long in [vec![b'x'; 5_000_000], vec![0; 1000], "é".repeat(100).into_bytes()] {
            assert!(quoted(&long).chars().count() <= MOST_QUOTED + 3, "{}", quoted(&long));
        }
    }
}
