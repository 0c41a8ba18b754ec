//! Compares two texts line by line, and marks the differences within lines.

use serde::Serialize;
use similar::{ChangeTag, TextDiff};

use crate::plain;

/// The number of lines of a text that are compared. The rest is replaced by its count.
const MOST_LINES: usize = 200;

#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Line {
    /// The texts that contain the line: `same` (both), `expected` or `actual`.
    pub(super) side: &'static str,
    /// The sign before the line: `-`, `+` or a space.
    pub(super) sign: char,
    pub(super) parts: Vec<Part>,
}

#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Part {
    pub(super) differs: bool,
    pub(super) text: String,
}

/// Returns the changes that turn `expected` into `actual`.
pub(super) fn lines(expected: &str, actual: &str) -> Vec<Line> {
    let (expected, actual) = (short(expected), short(actual));
    let diff = TextDiff::from_lines(expected.as_str(), actual.as_str());
    diff.iter_all_inline_changes()
        .map(|change| {
            let (side, sign) = match change.tag() {
                ChangeTag::Equal => ("same", ' '),
                ChangeTag::Delete => ("expected", '-'),
                ChangeTag::Insert => ("actual", '+'),
            };
            let part = |(differs, text): (bool, &str)| Part {
                differs,
                text: text.trim_end_matches('\n').to_owned(),
            };
            let parts = change.values().iter().map(|(differs, text)| part((*differs, text)));
            Line { side, sign, parts: parts.filter(|part| !part.text.is_empty()).collect() }
        })
        .collect()
}

fn short(text: &str) -> String {
    let mut lines: Vec<String> = text.lines().take(MOST_LINES).map(plain::shown).collect();
    let n_more = text.lines().count() - lines.len();
    if n_more > 0 {
        lines.push(format!("({n_more} more lines)"));
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}
