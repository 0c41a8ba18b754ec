//! Splits a Wavefront file into statements and words.
//!
//! A line ends with CR, LF, or both. A comment runs from `#` to the end of its line. A `\` at the
//! end of a line continues a statement on the next one; blanks may follow the `\`.

use crate::scene::mesh::text::{Word, is_blank, is_end};

/// A reader of the statements from an offset on.
#[derive(Clone, Copy)]
pub(super) struct Scan<'a> {
    bytes: &'a [u8],
    at: usize,
}

/// Returns whether statements with this keyword make the mesh. (`fo` is an old name of `f`.)
pub(super) fn is_used(keyword: &[u8]) -> bool {
    matches!(keyword, b"v" | b"vn" | b"f" | b"fo")
}

impl<'a> Scan<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// Returns the offset of the next byte.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Returns the keyword of the next statement. The reader is at the start of a line or after all
    /// words of a statement.
    pub(super) fn keyword(&mut self) -> Option<Word<'a>> {
        loop {
            if let Some(word) = self.word() {
                return Some(word);
            }
            match self.bytes.get(self.at)? {
                b'#' => self.skip(),
                _ => self.at += 1,
            }
        }
    }

    /// Returns the next word of the statement, or `None` at its end.
    pub(super) fn word(&mut self) -> Option<Word<'a>> {
        loop {
            match *self.bytes.get(self.at)? {
                byte if is_blank(byte) => self.at += 1,
                b'\\' => match self.continuation() {
                    Some(next) => self.at = next,
                    None => break,
                },
                byte if is_end(byte) || byte == b'#' => return None,
                _ => break,
            }
        }
        let at = self.at;
        while let Some(byte) = self.bytes.get(self.at)
            && !is_blank(*byte)
            && !is_end(*byte)
            && *byte != b'#'
            && !(*byte == b'\\' && self.continuation().is_some())
        {
            self.at += 1;
        }
        Some(Word { at, text: &self.bytes[at..self.at] })
    }

    /// Returns the offset of the next line if the `\` at the current offset continues the statement
    /// there.
    fn continuation(&self) -> Option<usize> {
        let rest = &self.bytes[self.at + 1..];
        let n_blanks = rest.iter().take_while(|byte| is_blank(**byte)).count();
        let n_ends = match rest[n_blanks..] {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            [] => 0,
            _ => return None,
        };
        Some(self.at + 1 + n_blanks + n_ends)
    }

    /// Skips the rest of a comment, or of a statement that is not used.
    ///
    /// If the line ends with `\`, the next line is skipped too, unless it is a statement that is
    /// used: a comment can end with the name of a folder, which must not cost a vertex.
    pub(super) fn skip(&mut self) {
        while self.skip_line() {
            let mut next = *self;
            match next.word() {
                // The lines between here and this word hold no word and end with `\` as well. A
                // look at each of them would take quadratic time.
                Some(word) if !is_used(word.text) => self.at = word.at,
                _ => return,
            }
        }
    }

    /// Moves to the next line. Returns whether this one ends with `\` and another one follows.
    fn skip_line(&mut self) -> bool {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|byte| is_end(*byte)).unwrap_or(rest.len());
        let is_continued = rest[..length].trim_ascii_end().ends_with(b"\\");
        self.at += length;
        self.at += match self.bytes[self.at..] {
            [b'\r', b'\n', ..] => 2,
            [_, ..] => 1,
            [] => 0,
        };
        is_continued && self.at < self.bytes.len()
    }
}
