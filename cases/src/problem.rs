//! Problems of files that people write. All problems of a file are reported at once, each with its
//! place, the reason and a way to fix it.

use std::fmt;
use std::io;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::files::ReadError;

/// Largest number of problems of one file that are kept. A file with more is not worth reading to
/// its end.
pub const MAX_PROBLEMS: usize = 100;

/// The text of a file and its name.
#[derive(Debug, PartialEq, Eq)]
pub struct Source {
    /// The name that messages use.
    pub name: String,
    /// The text; empty if the file could not be read.
    pub text: String,
}

impl Source {
    /// Returns a text under that name.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self { name: name.into(), text: text.into() })
    }
}

/// A problem of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The file.
    pub source: Arc<Source>,
    /// Bytes of the file that are wrong; `None` if the file as a whole is.
    pub span: Option<Range<usize>>,
    /// A statement of the problem, such as ``unknown material `brik` ``.
    pub message: String,
    /// The reason, in a few words below the underlined bytes; may be empty.
    pub label: String,
    /// A way to fix the problem.
    pub help: Option<String>,
    /// The number of the system's error, if the system could not read a file.
    pub os_error: Option<i32>,
}

impl Problem {
    /// Returns line and column, both from 1, the column in characters; `None` if the file as a
    /// whole is wrong.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        let before = self.source.text.get(..self.span.as_ref()?.start)?;
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        Some((before.matches('\n').count() + 1, before[line_start..].chars().count() + 1))
    }

    /// Sets the way to fix the problem.
    pub fn help(&mut self, help: impl Into<String>) {
        self.help = Some(help.into());
    }

    /// Returns the key by which problems are ordered.
    fn place(&self) -> (&str, Option<(usize, usize)>) {
        (&self.source.name, self.span.as_ref().map(|span| (span.start, span.end)))
    }

    fn group(&self) -> Group<'_> {
        let title = Level::ERROR.primary_title(self.message.as_str());
        let group = match &self.span {
            Some(span) => {
                let label = (!self.label.is_empty()).then_some(self.label.as_str());
                let Line { text, number, part } = line_of(&self.source.text, span);
                let here = AnnotationKind::Primary.span(part).label(label);
                // Only this line is passed: the renderer indexes all lines of its source for each
                // problem.
                let snippet =
                    Snippet::source(text).line_start(number).path(self.source.name.as_str());
                title.element(snippet.annotation(here))
            }
            None => title.element(Origin::path(self.source.name.as_str())),
        };
        let reason = (self.span.is_none() && !self.label.is_empty()).then_some(self.label.as_str());
        group
            .elements(reason.map(|reason| Level::NOTE.message(reason)))
            .elements(self.help.as_deref().map(|help| Level::HELP.message(help)))
    }
}

/// A line of a text, and the part of it that is wrong.
struct Line<'a> {
    text: &'a str,
    /// The number of the line, from 1.
    number: usize,
    /// The bytes of the line that are wrong.
    part: Range<usize>,
}

/// Returns the line on which `span` begins, with the part of `span` that lies on it. The part is
/// widened to whole characters.
fn line_of<'a>(text: &'a str, span: &Range<usize>) -> Line<'a> {
    let (before, behind) = text.split_at(text.floor_char_boundary(span.start));
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = before.len() + behind.find(['\n', '\r']).unwrap_or(behind.len());
    let part = before.len()..text.ceil_char_boundary(span.end.clamp(before.len(), end));
    let number = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
    Line { text: &text[start..end], number, part: part.start - start..part.end - start }
}

/// One or more problems of one or more files, in order of file and place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems(Vec<Problem>);

impl Problems {
    /// Returns the number of the system's error, if the system could not read one of the files.
    pub fn os_error(&self) -> Option<i32> {
        self.0.iter().find_map(|problem| problem.os_error)
    }

    /// Sorts the problems and removes duplicates. Returns `None` if there are no problems.
    pub fn new(mut problems: Vec<Problem>) -> Option<Self> {
        problems.sort_by(|a, b| a.place().cmp(&b.place()));
        problems.dedup();
        (!problems.is_empty()).then_some(Self(problems))
    }

    /// Returns a single problem of the file of that name as a whole.
    pub fn of_file(
        name: impl Into<String>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> Self {
        let source = Source::new(name, "");
        let label = String::new();
        Self(vec![Problem {
            source,
            span: None,
            message: message.into(),
            label,
            help,
            os_error: None,
        }])
    }

    /// Returns the problem of a file that could not be read.
    pub(crate) fn of_reading(path: &Path, why: &ReadError) -> Self {
        let mut problems = Self::of_file(
            path.display().to_string(),
            format!("the file cannot be used: {why}"),
            None,
        );
        if let ReadError::Io(why) = why {
            problems.0[0].os_error = why.raw_os_error();
        }
        problems
    }

    /// Returns the problem of a folder that could not be listed.
    pub(crate) fn of_listing(folder: &Path, why: &io::Error) -> Self {
        let message = format!("the folder cannot be read: {why}");
        let mut problems = Self::of_file(folder.display().to_string(), message, None);
        problems.0[0].os_error = why.raw_os_error();
        problems
    }

    /// Iterates over the problems, in order.
    pub fn iter(&self) -> impl Iterator<Item = &Problem> {
        self.0.iter()
    }

    /// Returns the problems as a list.
    pub fn into_vec(self) -> Vec<Problem> {
        self.0
    }

    /// Returns these problems and those of `other`, in order.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self.0.sort_by(|a, b| a.place().cmp(&b.place()));
        self
    }

    /// Returns the text for people: each problem with its place underlined, then the numbers of
    /// problems and files. It has escape codes only if `colour`.
    pub fn render(&self, colour: bool) -> String {
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        let mut text = String::new();
        for problem in &self.0 {
            text += &renderer.render(&[problem.group()]);
            text.push('\n');
        }
        let mut files: Vec<&str> =
            self.0.iter().map(|problem| problem.source.name.as_str()).collect();
        files.dedup();
        text + &format!("{} in {}", count(self.0.len(), "problem"), count(files.len(), "file"))
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Problems {}

fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

/// Returns the one of `known` that `word` was most likely meant to be, if one is near enough.
pub fn did_you_mean<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let far = |candidate: &str| edits(&word.to_lowercase(), &candidate.to_lowercase());
    let near_enough = |candidate: &str, n: usize| {
        n * 3 <= candidate.chars().count().max(word.chars().count()) + 1
    };
    let nearest =
        known.into_iter().map(|candidate| (far(candidate), candidate)).min_by_key(|(n, _)| *n);
    nearest.filter(|(n, candidate)| near_enough(candidate, *n)).map(|(_, candidate)| candidate)
}

/// Returns the edit distance, in which a swap of neighbours counts once. Words are cut at 64
/// characters, so that a long one in a file costs no time.
fn edits(a: &str, b: &str) -> usize {
    let cut = |word: &str| word.chars().take(64).collect::<String>();
    strsim::osa_distance(&cut(a), &cut(b))
}

/// Returns a list of names for a message: `` `a`, `b` and `c` ``; "none" for an empty list.
pub(crate) fn quoted<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        None => "none".to_owned(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_only_what_is_near() {
        let known = ["fov_y_deg", "eye", "up", "look_at"];
        let table = [
            ("fov_deg", Some("fov_y_deg")),
            ("eey", Some("eye")),
            ("lookat", Some("look_at")),
            ("UP", Some("up")),
            ("banana", None),
            ("", None),
        ];
        for (word, meant) in table {
            assert_eq!(did_you_mean(word, known), meant, "{word}");
        }
    }

    #[test]
    fn counts_lines_and_characters() {
        let source = Source::new("a.toml", "é = 1\nñü = 2\n");
        let at = source.text.find('2').map(|at| at..at + 1);
        let problem = Problem {
            source,
            span: at,
            message: String::new(),
            label: String::new(),
            help: None,
            os_error: None,
        };
        assert_eq!(problem.line_column(), Some((2, 6)));
    }
}
