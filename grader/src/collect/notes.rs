//! Collects the problems of one file, each with its place.

use std::ops::Range;
use std::sync::Arc;

use cases::problem::{MAX_PROBLEMS, Problem, Problems, Source};

/// The problems of a file that have been found so far.
#[derive(Debug)]
pub(super) struct Notes {
    source: Arc<Source>,
    found: Vec<Problem>,
}

impl Notes {
    pub(super) fn new(source: &Arc<Source>) -> Self {
        Self { source: Arc::clone(source), found: vec![] }
    }

    /// Adds a problem of the bytes `span`, with a way to fix it.
    pub(super) fn add(&mut self, span: Range<usize>, message: impl Into<String>, help: &str) {
        if self.found.len() < MAX_PROBLEMS {
            self.found.push(Problem {
                source: Arc::clone(&self.source),
                span: Some(span),
                message: message.into(),
                label: String::new(),
                help: (!help.is_empty()).then(|| help.to_owned()),
                os_error: None,
            });
        }
    }

    /// Returns whether no problem was found so far.
    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Returns `value` if there is no problem.
    pub(super) fn finish<T>(self, value: T) -> Result<T, Problems> {
        Problems::new(self.found).map_or(Ok(value), Err)
    }
}

/// Returns the text of a file in UTF-8, without its byte order mark, and whether it had one.
pub(super) fn utf8(name: &str, bytes: &[u8]) -> Result<(Arc<Source>, bool), Problems> {
    let (bytes, has_mark) = match bytes.strip_prefix(b"\xef\xbb\xbf") {
        Some(rest) => (rest, true),
        None => (bytes, false),
    };
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok((Source::new(name, text), has_mark)),
        Err(why) => {
            // The text before the first wrong byte is the same in both, so its place is right.
            let source = Source::new(name, String::from_utf8_lossy(bytes));
            let mut notes = Notes::new(&source);
            let at = why.valid_up_to();
            notes.add(
                at..at + 1,
                "the text is not UTF-8",
                "save the file as CSV UTF-8, or as UTF-8 text",
            );
            notes.finish((source, has_mark))
        }
    }
}
