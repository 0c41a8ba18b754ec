//! Two texts compared line by line, with the differences within lines.

use serde::Serialize;
use similar::{ChangeTag, TextDiff};

use crate::plain;

/// The number of lines of a text that are compared. The rest is replaced by its count.
const MOST_LINES: usize = 200;

/// The texts that contain a line.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Both texts.
    Same,
    /// The expected text alone.
    Expected,
    /// The actual text alone.
    Actual,
}

/// A line of either text, without its line break.
#[derive(Debug, PartialEq, Serialize)]
pub struct Line {
    /// The texts that contain the line.
    pub side: Side,
    /// The sign before the line: `-` for the expected text, `+` for the actual one, else a space.
    pub sign: char,
    /// The parts of the line, none of which is empty.
    pub parts: Vec<Part>,
}

/// A part of a line.
#[derive(Debug, PartialEq, Serialize)]
pub struct Part {
    /// Whether the part differs from the line of the other text.
    pub differs: bool,
    /// The characters of the part.
    pub text: String,
}

impl Line {
    /// Returns the whole line.
    pub fn text(&self) -> String {
        self.parts.iter().map(|part| part.text.as_str()).collect()
    }
}

/// Returns the changes that turn `expected` into `actual`. Lines are made safe to print by
/// [`plain::shown`], and those after the 200th of a text are replaced by their number.
pub fn lines(expected: &str, actual: &str) -> Vec<Line> {
    let (expected, actual) = (short(expected), short(actual));
    let diff = TextDiff::from_lines(expected.as_str(), actual.as_str());
    diff.iter_all_inline_changes()
        .map(|change| {
            let (side, sign) = match change.tag() {
                ChangeTag::Equal => (Side::Same, ' '),
                ChangeTag::Delete => (Side::Expected, '-'),
                ChangeTag::Insert => (Side::Actual, '+'),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_differ_by_the_part_that_differs() {
        let lines = lines("hit\n  t 0.5\n", "hit\n  t -0.5\n");
        let shown: Vec<String> =
            lines.iter().map(|line| format!("{}{}", line.sign, line.text())).collect();
        assert_eq!(shown, [" hit", "-  t 0.5", "+  t -0.5"]);
        let parts = lines.iter().flat_map(|line| &line.parts).filter(|part| part.differs);
        let marked: Vec<&str> = parts.map(|part| &*part.text).collect();
        assert!(marked.iter().all(|text| !text.contains('t')), "{marked:?}");
        assert!(!marked.is_empty());
    }

    #[test]
    fn a_flood_of_lines_is_cut() {
        let lines = lines("a\n", &"b\n".repeat(10_000));
        assert!(lines.len() < 210, "{}", lines.len());
        assert!(lines.iter().any(|line| line.text().contains("9800 more lines")));
    }
}
