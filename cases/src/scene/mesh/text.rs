//! Words and numbers of mesh files that are text.

use super::fault::{Fault, quoted};

/// A word of a text, and the offset at which it starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub at: usize,
    pub text: &'a [u8],
}

impl Word<'_> {
    /// Returns a fault at this word, which the message quotes.
    pub(super) fn fault(&self, what: &str, help: impl Into<String>) -> Fault {
        Fault::at(self.at, format!("{} {what}", quoted(self.text)), help)
    }
}

/// Returns where a text begins: after a byte order mark of UTF-8, if there is one.
///
/// # Errors
/// The file is empty, or a text of UTF-16.
pub(super) fn beginning(bytes: &[u8]) -> Result<usize, Fault> {
    match bytes {
        [] => Err(Fault::of_file("the file is empty", "write the file again")),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => {
            Err(Fault::at(0, "the text is UTF-16", "save the file as UTF-8, or as plain ASCII"))
        }
        [0xef, 0xbb, 0xbf, ..] => Ok(3),
        _ => Ok(0),
    }
}

/// Returns whether the byte separates words on a line: a blank, a tab, a vertical tab or a form
/// feed.
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0b | 0x0c)
}

/// Returns whether the byte ends a line.
pub(super) fn is_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// Parses a decimal number, rounded to the nearest double; infinite if it is too large for one.
pub(super) fn real(text: &[u8]) -> Option<f64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

/// Parses a decimal whole number; `None` also if 64 bits do not hold it.
pub(super) fn whole(text: &[u8]) -> Option<i64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}
