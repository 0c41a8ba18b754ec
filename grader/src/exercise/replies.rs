//! What a program prints in answer to questions, matched with them by id.

use std::collections::{BTreeMap, BTreeSet};

use cases::probe::{Answer, Reply};
use serde_json::Value;

use crate::plain;

/// What came back for a question.
#[derive(Clone, Debug, PartialEq)]
pub enum Got {
    /// An answer.
    Answer(Answer),
    /// A line with the question's id that is no answer; says why.
    Malformed(String),
    /// Two answers or more.
    Twice,
}

/// All that stood on standard output.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Replies {
    /// By id of the question.
    pub(super) got: BTreeMap<String, Got>,
    /// Answers to questions that were not asked.
    pub(super) n_unknown: usize,
    /// Lines that are no answers, and the first of them.
    pub(super) n_stray: usize,
    pub(super) stray: Option<String>,
}

/// Reads an answer a line, to the questions `asked`.
pub(super) fn parse(stdout: &[u8], asked: &BTreeSet<&str>) -> Replies {
    let mut replies = Replies::default();
    for line in stdout.split(|byte| *byte == b'\n').filter(|line| !line.trim_ascii().is_empty()) {
        match understand(line, asked) {
            Line::Reply(id, got) if asked.contains(id.as_str()) => {
                replies.got.entry(id).and_modify(|before| *before = Got::Twice).or_insert(got);
            }
            Line::Reply(..) => replies.n_unknown += 1,
            Line::Stray => {
                replies.n_stray += 1;
                replies.stray.get_or_insert_with(|| plain::name(line));
            }
        }
    }
    replies
}

enum Line {
    Reply(String, Got),
    Stray,
}

fn understand(line: &[u8], asked: &BTreeSet<&str>) -> Line {
    let value = match serde_json::from_slice::<Value>(line) {
        Ok(value) => value,
        Err(why) => return named_in(line, asked, &why.to_string()),
    };
    let Some(id) = value.get("id").and_then(Value::as_str).map(str::to_owned) else { return Line::Stray };
    let got = match serde_json::from_value::<Reply>(value) {
        Ok(reply) => Got::Answer(reply.answer),
        Err(why) => Got::Malformed(format!("{why}: {}", plain::name(line))),
    };
    Line::Reply(id, got)
}

/// A line that is no JSON still answers the question whose quoted id stands in it: Python, say, prints a bare NaN.
fn named_in(line: &[u8], asked: &BTreeSet<&str>, why: &str) -> Line {
    let text = String::from_utf8_lossy(line);
    let quoted = text.split('"').find(|part| asked.contains(part));
    let why = format!("it is no JSON ({why}; write \"nan\" and \"inf\" in quotes): {}", plain::name(line));
    quoted.map_or(Line::Stray, |id| Line::Reply(id.to_owned(), Got::Malformed(why)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(stdout: &str, expected: &[(&str, Got)], n_unknown: usize, n_stray: usize) {
        let replies = parse(stdout.as_bytes(), &["a", "b"].into());
        let expected = expected.iter().map(|(id, got)| ((*id).to_owned(), got.clone())).collect();
        assert_eq!((replies.got, replies.n_unknown, replies.n_stray), (expected, n_unknown, n_stray), "{stdout}");
    }

    #[test]
    fn answers_are_matched_by_id_in_any_order() {
        let value = |x| Got::Answer(Answer::Value(x));
        check(
            "{\"id\":\"b\",\"value\":2}\n{\"id\":\"a\",\"value\":1}\n",
            &[("a", value(1.0)), ("b", value(2.0))],
            0,
            0,
        );
        check("{\"id\":\"a\",\"value\":1}\r\n\n{\"id\":\"c\",\"value\":1}", &[("a", value(1.0))], 1, 0);
        check("{\"id\":\"a\",\"value\":\"inf\"}", &[("a", value(f64::INFINITY))], 0, 0);
        check("{\"id\":\"a\",\"value\":1}\n{\"id\":\"a\",\"value\":1}", &[("a", Got::Twice)], 0, 0);
    }

    #[test]
    fn what_is_no_answer_is_counted() {
        check("debug: t = 1\n[1]\n{\"value\":1}\n\u{1b}[2J", &[], 0, 4);
        let replies = parse(b"{\"id\":\"a\",\"value\":[1]}\n{\"id\": \"b\", \"value\": NaN}", &["a", "b"].into());
        assert!(matches!(&replies.got["a"], Got::Malformed(_)), "{replies:?}");
        assert!(matches!(&replies.got["b"], Got::Malformed(why) if why.contains("no JSON")), "{replies:?}");
    }
}
