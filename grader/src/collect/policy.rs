//! Reads a policy for late hand-ins: the deadline, and the deduction after it.

use cases::problem::{Problems, did_you_mean};
use toml::de::{DeTable, DeValue};

use super::moment::{Clock, span_s};
use super::notes::{Notes, utf8};

/// A policy for late hand-ins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Policy {
    /// The deadline, on the clock of the course.
    pub deadline: Clock,
    /// Seconds after the deadline during which a hand-in is not late.
    pub grace_s: u64,
    /// The deduction; `None` if lateness is shown and costs nothing.
    pub deduction: Option<Deduction>,
}

/// A deduction for each unit of time that has started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Deduction {
    /// The deduction for one unit.
    pub amount: Amount,
    /// Seconds of a unit: an hour or a day.
    pub unit_s: u64,
    /// The number of points that a share refers to.
    pub of: Of,
    /// The largest deduction; `None` if everything can be lost.
    pub maximum: Option<Amount>,
}

/// A part of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amount {
    /// A share, in thousandths of a percent.
    Share(u64),
    /// Points, in thousandths.
    Points(u64),
}

/// The number of points that a share refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// The points that the hand-in earned.
    Earned,
    /// The points that a hand-in can earn.
    Possible,
}

const KEYS: [&str; 6] = ["deadline", "grace", "deduct", "per", "of", "maximum"];

impl Policy {
    /// Reads a policy in TOML, which messages call `name`.
    ///
    /// # Errors
    /// All problems of the file.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Self, Problems> {
        let (source, _) = utf8(name, bytes)?;
        let mut notes = Notes::new(&source);
        let (table, errors) = DeTable::parse_recoverable(&source.text);
        for error in &errors {
            let span = error.span().unwrap_or(0..0);
            notes.add(span, format!("this is not TOML: {}", error.message()), "");
        }
        if !errors.is_empty() {
            return notes.finish(Self::of_nothing());
        }
        let mut reader = Reader { table: table.get_ref(), notes };
        let policy = reader.policy();
        reader.notes.finish(policy)
    }

    /// Returns a value that stands for a policy with problems, and is never used.
    fn of_nothing() -> Self {
        let moment = super::moment::Moment { unix_s: 0 };
        Self { deadline: Clock { moment, offset_s: 0 }, grace_s: 0, deduction: None }
    }
}

struct Reader<'a> {
    table: &'a DeTable<'a>,
    notes: Notes,
}

impl Reader<'_> {
    fn policy(&mut self) -> Policy {
        for (key, _) in self.table {
            if !KEYS.contains(&&**key.get_ref()) {
                let help = did_you_mean(key.get_ref(), KEYS)
                    .map_or_else(|| KEYS.join(", "), |near| format!("did you mean `{near}`?"));
                let message = format!("unknown key `{}`", key.get_ref());
                self.notes.add(key.span(), message, &help);
            }
        }
        let deadline = self.deadline();
        let grace_s = self.text("grace").map(|(text, span)| {
            let grace_s = span_s(&text);
            if grace_s.is_none() {
                self.notes.add(span, "this is no span of time", "such as \"15 min\" or \"1 h\"");
            }
            grace_s.unwrap_or(0)
        });
        let deduction = self.deduction();
        Policy {
            deadline: deadline.unwrap_or(Policy::of_nothing().deadline),
            grace_s: grace_s.unwrap_or(0),
            deduction,
        }
    }

    fn deadline(&mut self) -> Option<Clock> {
        let help = "a date, a time and an offset: deadline = 2026-10-05T23:59:00+02:00";
        let Some(value) = self.table.get("deadline") else {
            self.notes.add(0..0, "the key `deadline` is missing", help);
            return None;
        };
        let text = match value.get_ref() {
            DeValue::Datetime(moment) => moment.to_string(),
            DeValue::String(text) => text.to_string(),
            _ => String::new(),
        };
        let deadline = Clock::parse(&text);
        if deadline.is_none() {
            self.notes.add(value.span(), "this is no deadline in a known time zone", help);
        }
        deadline
    }

    fn deduction(&mut self) -> Option<Deduction> {
        let amount = self.amount("deduct");
        let maximum = self.amount("maximum");
        let unit_s = self.choice("per", &[("hour", 3600), ("day", 86_400)]);
        let of = self.choice("of", &[("earned", Of::Earned), ("possible", Of::Possible)]);
        if !self.table.contains_key("deduct") {
            for key in ["per", "of", "maximum"] {
                if let Some((key, _)) = self.table.get_key_value(key) {
                    let message = format!("`{}` says nothing without `deduct`", key.get_ref());
                    self.notes.add(key.span(), message, "add deduct = \"10 %\", or leave it out");
                }
            }
            return None;
        }
        if !self.table.contains_key("per") {
            let span = self.table.get("deduct").map_or(0..0, toml::Spanned::span);
            let help = "add per = \"day\" or per = \"hour\"";
            self.notes.add(span, "the deduction has no unit of time", help);
        }
        Some(Deduction {
            amount: amount?,
            unit_s: unit_s.unwrap_or(86_400),
            of: of.unwrap_or(Of::Earned),
            maximum,
        })
    }

    /// Returns the text under a key, and its place.
    fn text(&mut self, key: &str) -> Option<(String, std::ops::Range<usize>)> {
        let value = self.table.get(key)?;
        match value.get_ref() {
            DeValue::String(text) => Some((text.to_string(), value.span())),
            _ => {
                let message = format!("`{key}` is a text in quotes");
                self.notes.add(value.span(), message, "");
                None
            }
        }
    }

    fn amount(&mut self, key: &str) -> Option<Amount> {
        let (text, span) = self.text(key)?;
        let amount = amount(&text);
        if amount.is_none() {
            let help = "such as \"10 %\" (at most 100 %) or \"2.5 points\", with at most three \
                decimals";
            self.notes.add(span, "this is no part of the points", help);
        }
        amount
    }

    fn choice<T: Copy>(&mut self, key: &str, choices: &[(&str, T)]) -> Option<T> {
        let (text, span) = self.text(key)?;
        let found = choices.iter().find(|(name, _)| *name == text).map(|(_, value)| *value);
        if found.is_none() {
            let names: Vec<String> =
                choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            let message = format!("`{key}` cannot be \"{text}\"");
            self.notes.add(span, message, &format!("either {}", names.join(" or ")));
        }
        found
    }
}

fn amount(text: &str) -> Option<Amount> {
    if let Some(share) = text.strip_suffix('%') {
        return thousandths(share.trim()).filter(|share| *share <= 100_000).map(Amount::Share);
    }
    let points = text.strip_suffix("points").or_else(|| text.strip_suffix("point"))?;
    thousandths(points.trim()).map(Amount::Points)
}

/// Reads a number with at most nine digits before the point and three behind it, as thousandths.
pub(super) fn thousandths(text: &str) -> Option<u64> {
    let (whole, part) = text.split_once('.').unwrap_or((text, "0"));
    let is_number = |text: &str, most: usize| {
        (1..=most).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_digit())
    };
    let is_right = is_number(whole, 9) && is_number(part, 3);
    is_right.then(|| format!("{whole}{part:0<3}").parse().ok())?
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn problems(text: &str) -> Vec<(Option<(usize, usize)>, String)> {
        let problems = Policy::parse("late.toml", text.as_bytes()).unwrap_err();
        problems.iter().map(|one| (one.line_column(), one.message.clone())).collect()
    }

    #[test]
    fn a_policy_is_read() {
        let text = "deadline = 2026-10-05T23:59:00+02:00\ngrace = \"15 min\"\ndeduct = \"10 %\"\n\
            per = \"day\"\nof = \"possible\"\nmaximum = \"7.5 points\"\n";
        let policy = Policy::parse("late.toml", text.as_bytes()).unwrap();
        assert_eq!(policy.deadline.to_string(), "2026-10-05 23:59:00 +02:00");
        assert_eq!(policy.grace_s, 900);
        let expected = Deduction {
            amount: Amount::Share(10_000),
            unit_s: 86_400,
            of: Of::Possible,
            maximum: Some(Amount::Points(7_500)),
        };
        assert_eq!(policy.deduction, Some(expected));
        let plain = Policy::parse("late.toml", b"deadline = 2026-10-05 23:59Z").unwrap();
        assert_eq!((plain.grace_s, plain.deduction), (0, None));
    }

    #[test]
    fn all_problems_are_reported_with_their_places() {
        let text = "deadline = 2026-10-05T23:59:00\ngrase = \"1 h\"\ndeduct = 10\nper = \"week\"\n\
            maximum = \"120 %\"\n";
        let expected = [
            ((1, 12), "this is no deadline in a known time zone"),
            ((2, 1), "unknown key `grase`"),
            ((3, 10), "`deduct` is a text in quotes"),
            ((4, 7), "`per` cannot be \"week\""),
            ((5, 11), "this is no part of the points"),
        ];
        let expected: Vec<_> =
            expected.iter().map(|(place, text)| (Some(*place), (*text).to_owned())).collect();
        assert_eq!(problems(text), expected);
    }

    #[test]
    fn what_says_nothing_is_refused() {
        let deadline = "deadline = 2026-10-05T23:59:00Z\n";
        for (text, words) in [
            (String::new(), "`deadline` is missing"),
            (format!("{deadline}maximum = \"5 %\""), "`maximum` says nothing"),
            (format!("{deadline}deduct = \"5 %\""), "no unit of time"),
            (format!("{deadline}grace = \"15\""), "no span of time"),
            (format!("{deadline}deadline = 1"), "not TOML"),
            (format!("{deadline}deduct = \"1.2345 %\"\nper = \"day\""), "no part of the points"),
        ] {
            let found = problems(&text);
            assert!(found.iter().any(|(_, one)| one.contains(words)), "{text:?}: {found:?}");
        }
    }

    #[test]
    fn numbers_become_thousandths() {
        for (text, expected) in [
            ("10", Some(10_000)),
            ("2.5", Some(2_500)),
            ("0.125", Some(125)),
            ("1.2345", None),
            ("", None),
            (".5", None),
            ("1.", None),
            ("-1", None),
            ("1e3", None),
            ("1234567890", None),
        ] {
            assert_eq!(thousandths(text), expected, "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(
            text in "(deadline|grace|deduct|per|of| |=|\"|2026-10-05|T|23:59Z|10|%|\n|é){0,30}",
        ) {
            let _ = Policy::parse("x.toml", text.as_bytes());
        }
    }
}
