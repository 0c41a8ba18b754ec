//! Reads the answers that a program prints, and matches them with the questions by id.

use std::collections::{BTreeMap, BTreeSet};

use cases::probe::{Answer, Reply};
use serde_json::{Value, json};

use crate::plain;

/// Largest number of bytes of a line that is parsed. No answer is nearly as long, and parsed JSON
/// takes many times its length in memory.
const MAX_LINE: usize = 64 << 10;

/// The reply to a question.
#[derive(Clone, Debug, PartialEq)]
pub enum Got {
    /// An answer.
    Answer(Answer),
    /// A line with the question's id that is no answer; the text says why.
    Malformed(String),
    /// Two or more answers.
    Twice,
}

/// The content of standard output.
#[derive(Debug, Default, PartialEq)]
pub struct Replies {
    /// The replies, by id of the question.
    pub got: BTreeMap<String, Got>,
    /// Number of answers that belong to no question.
    pub n_unknown: usize,
    /// Number of lines that are no answers.
    pub n_stray: usize,
    /// The first line that is no answer.
    pub stray: Option<String>,
}

/// Reads one answer per line. `ids` holds the ids of the questions.
pub fn parse(stdout: &[u8], ids: &BTreeSet<&str>) -> Replies {
    let mut replies = Replies::default();
    for line in stdout.split(|byte| *byte == b'\n').filter(|line| !line.trim_ascii().is_empty()) {
        match understand(line, ids) {
            Line::Reply(id, got) if ids.contains(id.as_str()) => {
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

fn understand(line: &[u8], ids: &BTreeSet<&str>) -> Line {
    if line.len() > MAX_LINE {
        return named_in(line, ids, &format!("the line is longer than {} KiB", MAX_LINE >> 10));
    }
    let value = match serde_json::from_slice::<Value>(line) {
        Ok(value) => value,
        Err(why) => {
            return named_in(
                line,
                ids,
                &format!("it is no JSON ({why}; write \"nan\" and \"inf\" in quotes)"),
            );
        }
    };
    let Some(id) = value.get("id").and_then(Value::as_str).map(str::to_owned) else {
        return Line::Stray;
    };
    let got = match answer(value) {
        Ok(answer) => Got::Answer(answer),
        Err(why) => Got::Malformed(format!("{why}: {}", plain::name(line))),
    };
    Line::Reply(id, got)
}

/// Returns the only answer of a reply. Keys that are no answers are ignored.
fn answer(reply: Value) -> Result<Answer, String> {
    let answers = |(key, value): &(&String, &Value)| {
        serde_json::from_value::<Answer>(json!({ *key: value })).is_ok()
    };
    if reply.as_object().is_some_and(|reply| reply.iter().filter(answers).count() > 1) {
        return Err("it gives several answers at once".to_owned());
    }
    match serde_json::from_value::<Reply>(reply).map_err(|why| why.to_string())?.answer {
        Answer::Miss(false) => Err("`miss` is always true".to_owned()),
        Answer::Todo(false) => Err("`todo` is always true".to_owned()),
        answer => Ok(answer),
    }
}

/// Assigns a line that cannot be read to the question whose quoted id it contains. Python, for
/// example, prints a bare NaN.
fn named_in(line: &[u8], ids: &BTreeSet<&str>, why: &str) -> Line {
    let text = String::from_utf8_lossy(line);
    let quoted = text.split('"').find(|part| ids.contains(part));
    let why = format!("{why}: {}", plain::name(line));
    quoted.map_or(Line::Stray, |id| Line::Reply(id.to_owned(), Got::Malformed(why)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(stdout: &str, expected: &[(&str, Got)], n_unknown: usize, n_stray: usize) {
        let replies = parse(stdout.as_bytes(), &["a", "b"].into());
        let expected = expected.iter().map(|(id, got)| ((*id).to_owned(), got.clone())).collect();
        assert_eq!(
            (replies.got, replies.n_unknown, replies.n_stray),
            (expected, n_unknown, n_stray),
            "{stdout}"
        );
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
        check(
            "{\"id\":\"a\",\"value\":1}\r\n\n{\"id\":\"c\",\"value\":1}",
            &[("a", value(1.0))],
            1,
            0,
        );
        check("{\"id\":\"a\",\"value\":\"inf\"}", &[("a", value(f64::INFINITY))], 0, 0);
        check("{\"id\":\"a\",\"value\":1}\n{\"id\":\"a\",\"value\":1}", &[("a", Got::Twice)], 0, 0);
    }

    #[test]
    fn one_reply_is_one_answer_and_says_yes_to_what_is_always_so() {
        let long = format!("{{\"id\":\"a\",\"value\":1,\"x\":[{}0]}}", "0,".repeat(MAX_LINE));
        for (line, why) in [
            (
                r#"{"id":"a","miss":true,"hit":{"t":1,"normal":[0,0,1]}}"#,
                "it gives several answers at once",
            ),
            (r#"{"id":"a","miss":false}"#, "`miss` is always true"),
            (r#"{"id":"a","todo":false}"#, "`todo` is always true"),
            (long.as_str(), "the line is longer than 64 KiB"),
        ] {
            let replies = parse(line.as_bytes(), &["a"].into());
            assert!(
                matches!(&replies.got["a"], Got::Malformed(said) if said.starts_with(why)),
                "{replies:?}"
            );
        }
        check(
            r#"{"id":"a","value":1,"note":"from the sphere"}"#,
            &[("a", Got::Answer(Answer::Value(1.0)))],
            0,
            0,
        );
    }

    #[test]
    fn what_is_no_answer_is_counted() {
        check("debug: t = 1\n[1]\n{\"value\":1}\n\u{1b}[2J", &[], 0, 4);
        let replies = parse(
            b"{\"id\":\"a\",\"value\":[1]}\n{\"id\": \"b\", \"value\": NaN}",
            &["a", "b"].into(),
        );
        assert!(matches!(&replies.got["a"], Got::Malformed(_)), "{replies:?}");
        assert!(
            matches!(&replies.got["b"], Got::Malformed(why) if why.contains("no JSON")),
            "{replies:?}"
        );
    }
}
