//! Reads CSV files whose cells keep their places, so that a problem has a line and a column, and so
//! that one column of a file can be replaced without a change of any other byte.

use std::ops::Range;
use std::sync::Arc;

use cases::problem::{Problems, Source};

use super::notes::{Notes, utf8};

/// A cell of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The text, without quotes and without white space around it.
    pub text: String,
    /// The bytes of the cell in the file, with its quotes.
    pub span: Range<usize>,
}

/// A CSV file. All rows have as many cells as the first one.
#[derive(Debug)]
pub struct Table {
    /// The text of the file, without a byte order mark.
    pub source: Arc<Source>,
    /// The names of the columns.
    pub head: Vec<Cell>,
    /// The rows, without empty lines.
    pub rows: Vec<Vec<Cell>>,
    has_mark: bool,
}

/// Characters that can separate cells. The most frequent one in the first line does.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

impl Table {
    /// Reads a table with names of columns in its first line, which messages call `name`.
    ///
    /// # Errors
    /// All problems of the file.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Self, Problems> {
        let (source, has_mark) = utf8(name, bytes)?;
        let mut notes = Notes::new(&source);
        let mut rows = rows(&source.text, &mut notes);
        let head = if rows.is_empty() { vec![] } else { rows.remove(0) };
        if head.is_empty() {
            notes.add(0..0, "the table is empty", "the first line names the columns");
        }
        for row in rows.iter().filter(|row| row.len() != head.len()) {
            let span = row[0].span.start..row[row.len() - 1].span.end;
            let message =
                format!("the row has {} cells, but the first line has {}", row.len(), head.len());
            notes.add(span, message, "put a cell with a separator in it into quotes");
        }
        notes.finish(Self { source: Arc::clone(&source), head, rows, has_mark })
    }

    /// Returns the bytes of the file with other content in some cells, which are in order. The
    /// texts need no quotes.
    pub fn with(&self, changes: &[(&Cell, String)]) -> Vec<u8> {
        let text = &self.source.text;
        let mut out = if self.has_mark { b"\xef\xbb\xbf".to_vec() } else { vec![] };
        let mut at = 0;
        for (cell, fresh) in changes {
            out.extend_from_slice(&text.as_bytes()[at..cell.span.start]);
            out.extend_from_slice(fresh.as_bytes());
            at = cell.span.end;
        }
        out.extend_from_slice(&text.as_bytes()[at..]);
        out
    }
}

/// Returns the text in lower case, with only its letters and digits, by which names of columns are
/// compared.
pub fn plain_key(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

fn rows(text: &str, notes: &mut Notes) -> Vec<Vec<Cell>> {
    let (separator, bytes) = (separator(text), text.as_bytes());
    let (mut rows, mut row, mut at) = (vec![], vec![], 0);
    loop {
        let cell = cell(text, at, separator, notes);
        at = cell.span.end;
        row.push(cell);
        match bytes.get(at) {
            Some(byte) if *byte == separator => at += 1,
            end => {
                let is_empty = row.iter().all(|cell: &Cell| cell.span.is_empty()) && row.len() == 1;
                let done = std::mem::take(&mut row);
                if !is_empty {
                    rows.push(done);
                }
                match end {
                    None => return rows,
                    Some(b'\r') if bytes.get(at + 1) == Some(&b'\n') => at += 2,
                    Some(_) => at += 1,
                }
            }
        }
    }
}

/// Returns the separator that is most frequent in the first line, outside of quotes.
fn separator(text: &str) -> u8 {
    let mut counts = [0; SEPARATORS.len()];
    let mut is_quoted = false;
    for byte in text.bytes().take_while(|byte| !matches!(byte, b'\n' | b'\r')) {
        is_quoted ^= byte == b'"';
        if let Some(n) = SEPARATORS.iter().position(|one| *one == byte).filter(|_| !is_quoted) {
            counts[n] += 1;
        }
    }
    // Of equally frequent ones, the first counts.
    let best = (0..SEPARATORS.len()).rev().max_by_key(|n| counts[*n]).unwrap_or(0);
    SEPARATORS[best]
}

/// Reads the cell that begins at `at`. Its span ends before a separator, a line break or the end.
fn cell(text: &str, at: usize, separator: u8, notes: &mut Notes) -> Cell {
    let bytes = text.as_bytes();
    let is_end = |byte: &u8| *byte == separator || matches!(byte, b'\n' | b'\r');
    let end_from = |from: usize| {
        bytes[from..].iter().position(is_end).map_or(bytes.len(), |length| from + length)
    };
    let (content, end) = if bytes.get(at) == Some(&b'"') {
        let mut from = at + 1;
        loop {
            match bytes[from..].iter().position(|byte| *byte == b'"').map(|length| from + length) {
                None => {
                    notes.add(at..at + 1, "this quote is never closed", "");
                    break (text[at + 1..].to_owned(), bytes.len());
                }
                Some(quote) if bytes.get(quote + 1) == Some(&b'"') => from = quote + 2,
                Some(quote) => {
                    let end = end_from(quote + 1);
                    if !text[quote + 1..end].trim().is_empty() {
                        let message = "there is text behind the quotes of a cell";
                        notes.add(quote + 1..end, message, "double a quote within a quoted cell");
                    }
                    break (text[at + 1..quote].replace("\"\"", "\""), end);
                }
            }
        }
    } else {
        let end = end_from(at);
        if let Some(quote) = text[at..end].find('"').map(|length| at + length) {
            let message = "there is a quote within a cell that does not begin with one";
            notes.add(quote..quote + 1, message, "quote the whole cell, and double the quote");
        }
        (text[at..end].to_owned(), end)
    };
    if content.contains('\0') {
        notes.add(at..end, "the cell has a NUL character", "save the file as CSV UTF-8");
    }
    Cell { text: content.trim().to_owned(), span: at..end }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn texts(rows: &[Vec<Cell>]) -> Vec<Vec<&str>> {
        rows.iter().map(|row| row.iter().map(|cell| &*cell.text).collect()).collect()
    }

    #[test]
    fn separators_quotes_and_line_ends_are_read() {
        for (text, expected) in [
            ("id,name\n1,a\n2,b", vec![vec!["1", "a"], vec!["2", "b"]]),
            ("id;name\r\n1;\"a;\"\"b\"\"\"\r\n\r\n", vec![vec!["1", "a;\"b\""]]),
            ("\u{feff}id\tname\r1\t a, b \r", vec![vec!["1", "a, b"]]),
            ("id,name\n1,\"a\nb\"\n", vec![vec!["1", "a\nb"]]),
            ("id,name\n,\n", vec![vec!["", ""]]),
            ("\"a;b\",c\n1,2", vec![vec!["1", "2"]]),
        ] {
            let table = Table::parse("roster.csv", text.as_bytes()).unwrap();
            assert_eq!(texts(&table.rows), expected, "{text:?}");
            assert_eq!(table.with(&[]), text.as_bytes(), "{text:?}");
        }
    }

    #[test]
    fn problems_have_their_places() {
        let problems = |bytes: &[u8]| {
            let problems = Table::parse("roster.csv", bytes).unwrap_err();
            let line =
                |one: &cases::problem::Problem| (one.line_column().unwrap(), one.message.clone());
            problems.iter().map(line).collect::<Vec<_>>()
        };
        let check = |bytes: &[u8], expected: &[((usize, usize), &str)]| {
            let found = problems(bytes);
            assert_eq!(found.len(), expected.len(), "{found:?}");
            for ((place, message), (expected, words)) in found.iter().zip(expected) {
                assert_eq!(place, expected, "{message}");
                assert!(message.contains(words), "{message}");
            }
        };
        check(b"", &[((1, 1), "empty")]);
        check(b"id,name\n1,\"a", &[((2, 3), "never closed")]);
        check(b"id,name\n1,\"a\"b\n2", &[((2, 6), "behind the quotes"), ((3, 1), "1 cells")]);
        check(b"id,name\n1,a\"b\n", &[((2, 4), "within a cell")]);
        check("é,name\n1,é\n2,\u{0}".as_bytes(), &[((3, 3), "NUL")]);
        check(b"id,name\n1,\xff\n", &[((2, 3), "not UTF-8")]);
    }

    #[test]
    fn one_cell_is_replaced_and_nothing_else() {
        let text = "\u{feff}id;grade;\"x\"\r\n1;\"old\";a\r\n\r\n2; ;b";
        let table = Table::parse("x.csv", text.as_bytes()).unwrap();
        let changes: Vec<(&Cell, String)> =
            table.rows.iter().map(|row| (&row[1], "12.5".to_owned())).collect();
        let expected = "\u{feff}id;grade;\"x\"\r\n1;12.5;a\r\n\r\n2;12.5;b";
        assert_eq!(String::from_utf8(table.with(&changes)).unwrap(), expected);
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            if let Ok(table) = Table::parse("x.csv", &bytes) {
                prop_assert_eq!(table.with(&[]), bytes);
            }
        }

        #[test]
        fn what_is_written_is_read(
            rows in proptest::collection::vec(
                proptest::collection::vec("[a-z,;\"\n\r\t é]{0,6}", 3), 1..6,
            ),
        ) {
            let mut out = csv::WriterBuilder::new()
                .quote_style(csv::QuoteStyle::Always)
                .from_writer(Vec::new());
            out.write_record(["x", "y", "z"]).unwrap();
            rows.iter().for_each(|row| out.write_record(row).unwrap());
            let table = Table::parse("x.csv", &out.into_inner().unwrap()).unwrap();
            let trimmed: Vec<Vec<&str>> =
                rows.iter().map(|row| row.iter().map(|text| text.trim()).collect()).collect();
            prop_assert_eq!(texts(&table.rows), trimmed);
        }
    }
}
