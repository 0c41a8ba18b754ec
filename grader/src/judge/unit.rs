//! Judges answers to unit checks, number by number, each within the allowed error of its question.

use std::iter;

use cases::answer::CheckAnswer;
use cases::glam::DVec3;
use cases::probe::Answer;

use super::Judgement;
use super::numbers::short;
use crate::record::{Finding, FindingKind};

/// The number of characters of a panic's message that are shown.
const MAX_MESSAGE: usize = 200;

/// Judges the answer `actual` of a function by the correct one, and by those that are correct as
/// well: a miss for a hit, another object. It passes if it decides like one of them and has the
/// numbers of that one.
pub fn unit(actual: &Answer, right: &CheckAnswer, function: &str) -> Judgement {
    match actual {
        Answer::Todo(_) => {
            let message =
                format!("still to be written: what answers `{function}`, or a function it calls");
            return Judgement::not_run(Finding::new(FindingKind::Todo, message));
        }
        Answer::Panic(message) => {
            let message =
                format!("`{function}` panicked: {}", crate::plain::shown(&start(message)));
            return Judgement::fail(Finding::new(FindingKind::Crash, message));
        }
        _ => {}
    }
    let given = parts(actual);
    let alike: Vec<(&Answer, Parts)> = iter::once(&right.answer)
        .chain(&right.also)
        .map(|legal| (legal, parts(legal)))
        .filter(|(_, legal)| legal.decision == given.decision)
        .collect();
    let off = |legal: &Parts| {
        let mut both = legal.values.iter().zip(&given.values);
        both.find(|(e, g)| !e.is_near(g, right.allowed)).map(|(e, g)| e.mismatch(g, right.allowed))
    };
    let mismatches: Vec<_> = alike.iter().map(|(legal, parts)| (*legal, off(parts))).collect();
    match mismatches.iter().find(|(_, off)| off.is_none()).or(mismatches.first()) {
        Some((_, None)) => Judgement::PASS,
        Some((legal, Some(message))) => wrong(message.clone(), actual, legal, right.allowed),
        None => {
            let expected = parts(&right.answer).decision;
            let message = format!("it answers {}, expected {expected}", given.decision);
            wrong(message, actual, &right.answer, right.allowed)
        }
    }
}

/// Returns the start of a panic's message, with ` […]` if it was cut.
fn start(message: &str) -> String {
    let start: String = message.chars().take(MAX_MESSAGE).collect();
    if start.len() < message.len() { start + " […]" } else { start }
}

fn wrong(message: String, actual: &Answer, legal: &Answer, allowed: f64) -> Judgement {
    let finding = Finding::new(FindingKind::Wrong, message);
    let (expected, actual) = lines(legal, actual, allowed);
    Judgement::fail(Finding { expected: Some(expected), actual: Some(actual), ..finding })
}

/// An answer split into its decision and the numbers that belong to it.
struct Parts {
    decision: String,
    values: Vec<Value>,
}

/// A named number or triple.
struct Value {
    name: &'static str,
    numbers: Vec<f64>,
}

fn parts(answer: &Answer) -> Parts {
    let number = |name, x: &f64| Value { name, numbers: vec![*x] };
    let triple = |name, v: &DVec3| Value { name, numbers: v.to_array().to_vec() };
    let (decision, values) = match answer {
        Answer::Hit { t, normal } => {
            ("hit".to_owned(), vec![number("t", t), triple("normal", normal)])
        }
        Answer::Found { t, object } => (format!("object {object}"), vec![number("t", t)]),
        Answer::Miss(_) => ("miss".to_owned(), vec![]),
        Answer::Ray { origin, direction } => {
            ("ray".to_owned(), vec![triple("origin", origin), triple("direction", direction)])
        }
        Answer::Value(x) => ("value".to_owned(), vec![number("value", x)]),
        Answer::Vector(v) => ("vector".to_owned(), vec![triple("vector", v)]),
        Answer::Colour(v) => ("colour".to_owned(), vec![triple("colour", v)]),
        Answer::Facing { normal, inside } => {
            (if *inside { "inside" } else { "outside" }.to_owned(), vec![triple("normal", normal)])
        }
        Answer::ToLight { direction, t } => {
            ("to_light".to_owned(), vec![triple("direction", direction), number("t", t)])
        }
        Answer::Indices { eta_i, eta_t } => {
            ("indices".to_owned(), vec![number("eta_i", eta_i), number("eta_t", eta_t)])
        }
        Answer::GoesOn(yes) => (if *yes { "goes on" } else { "ends" }.to_owned(), vec![]),
        Answer::Todo(_) => ("todo".to_owned(), vec![]),
        Answer::Panic(_) => ("panic".to_owned(), vec![]),
    };
    Parts { decision, values }
}

/// Returns whether two numbers agree: they are equal (which includes infinities) or at most
/// `allowed` apart. NaN agrees with nothing.
fn is_near(expected: f64, given: f64, allowed: f64) -> bool {
    expected == given || (expected - given).abs() <= allowed
}

/// Returns whether two answers are equal: they have the same decision and numbers that agree. NaN
/// agrees with NaN here.
pub fn equal(one: &Answer, other: &Answer, allowed: f64) -> bool {
    let (one, other) = (parts(one), parts(other));
    let numbers = |parts: &Parts| {
        parts.values.iter().flat_map(|value| value.numbers.clone()).collect::<Vec<_>>()
    };
    let agree = |(a, b): (f64, f64)| is_near(a, b, allowed) || a.is_nan() && b.is_nan();
    one.decision == other.decision && numbers(&one).into_iter().zip(numbers(&other)).all(agree)
}

impl Value {
    fn is_near(&self, given: &Self, allowed: f64) -> bool {
        self.numbers.iter().zip(&given.numbers).all(|(e, g)| is_near(*e, *g, allowed))
    }

    /// Describes the most telling difference between the two values.
    fn mismatch(&self, given: &Self, allowed: f64) -> String {
        let name = self.name;
        if given.numbers.iter().any(|x| x.is_nan()) {
            return format!("the {name} is not a number");
        }
        let loose = allowed.max(1e-6);
        let (length, right_length) = (length(&given.numbers), length(&self.numbers));
        let all = |factor: f64| {
            self.numbers.iter().zip(&given.numbers).all(|(e, g)| is_near(*e, g * factor, loose))
        };
        if all(-1.0) {
            format!("the {name} has the opposite sign")
        } else if self.numbers.len() == 3
            && name != "colour"
            && length > 0.0
            && all(right_length / length)
        {
            format!(
                "the {name} points the right way, but its length is {}, not {}",
                short(length),
                short(right_length)
            )
        } else {
            let by = self
                .numbers
                .iter()
                .zip(&given.numbers)
                .map(|(e, g)| (e - g).abs())
                .fold(0.0, f64::max);
            format!("the {name} differs by {}; {} is allowed", short(by), short(allowed))
        }
    }
}

fn length(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Returns the correct and the given answer as texts that can be compared line by line. One line is
/// for the decision, and one for each number. A number within the tolerance is shown as the correct
/// one, so that only differences are visible.
pub fn lines(right: &Answer, actual: &Answer, allowed: f64) -> (String, String) {
    let (right, actual) = (parts(right), parts(actual));
    let mut texts = (right.decision.clone() + "\n", actual.decision.clone() + "\n");
    let same_decision = right.decision == actual.decision;
    for (n, value) in right.values.iter().enumerate() {
        for (i, expected) in value.numbers.iter().enumerate() {
            texts.0 += &line(value, i, &short(*expected));
            let given = actual
                .values
                .get(n)
                .and_then(|given| given.numbers.get(i))
                .filter(|_| same_decision);
            if let Some(given) = given {
                texts.1 += &line(value, i, &format_given(*expected, *given, allowed));
            }
        }
    }
    if !same_decision {
        for value in &actual.values {
            texts.1.extend(
                value.numbers.iter().enumerate().map(|(i, given)| line(value, i, &short(*given))),
            );
        }
    }
    texts
}

fn line(value: &Value, i: usize, number: &str) -> String {
    let axes = if value.name == "colour" { ["r", "g", "b"] } else { ["x", "y", "z"] };
    let axis = if value.numbers.len() == 1 { String::new() } else { format!(".{}", axes[i]) };
    format!("{}{axis} {number}\n", value.name)
}

/// Formats a given number for a comparison with the correct one. Within the tolerance it is shown
/// as the correct one. It has all its digits if nine digits would hide the difference.
fn format_given(expected: f64, given: f64, allowed: f64) -> String {
    match short(given) {
        _ if is_near(expected, given, allowed) => short(expected),
        text if text == short(expected) => given.to_string(),
        text => text,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use cases::answer::Digest;

    use super::*;
    use crate::record::Verdict;

    fn right(answer: Answer, also: &[Answer]) -> CheckAnswer {
        CheckAnswer {
            id: "x".to_owned(),
            made_from: Digest::default(),
            answer,
            allowed: 1e-6,
            also: also.to_vec(),
            wrong: BTreeMap::new(),
        }
    }

    /// Judges an answer, and checks the verdict and the message.
    fn check(actual: &Answer, right: &CheckAnswer, verdict: Verdict, message: Option<&str>) {
        let judgement = unit(actual, right, "f");
        let said = judgement.finding.map(|finding| finding.message);
        assert_eq!((judgement.verdict, said.as_deref()), (verdict, message), "{actual:?}");
    }

    fn hit(t: f64, normal: DVec3) -> Answer {
        Answer::Hit { t, normal }
    }

    #[test]
    fn numbers_count_within_what_is_allowed() {
        let wanted = right(hit(1.5, DVec3::Z), &[]);
        let fail = |message| (Verdict::Fail, Some(message));
        let table = [
            (hit(1.5 + 9e-7, DVec3::Z), (Verdict::Pass, None)),
            (hit(1.6, DVec3::Z), fail("the t differs by 0.1; 1e-6 is allowed")),
            (hit(1.5, -DVec3::Z), fail("the normal has the opposite sign")),
            (
                hit(1.5, 2.0 * DVec3::Z),
                fail("the normal points the right way, but its length is 2, not 1"),
            ),
            (hit(1.5, DVec3::X), fail("the normal differs by 1; 1e-6 is allowed")),
            (hit(f64::NAN, DVec3::Z), fail("the t is not a number")),
            (hit(f64::INFINITY, DVec3::Z), fail("the t differs by inf; 1e-6 is allowed")),
            (Answer::Miss(true), fail("it answers miss, expected hit")),
            (Answer::Value(1.5), fail("it answers value, expected hit")),
            (
                Answer::Todo(true),
                (
                    Verdict::NotRun,
                    Some("still to be written: what answers `f`, or a function it calls"),
                ),
            ),
            (Answer::Panic("at\u{1b}x".to_owned()), fail("`f` panicked: at\\u{1b}x")),
        ];
        for (actual, (verdict, message)) in table {
            check(&actual, &wanted, verdict, message);
        }
    }

    #[test]
    fn infinities_agree_with_themselves() {
        let wanted = right(Answer::ToLight { direction: DVec3::Y, t: f64::INFINITY }, &[]);
        check(
            &Answer::ToLight { direction: DVec3::Y, t: f64::INFINITY },
            &wanted,
            Verdict::Pass,
            None,
        );
        let far = Answer::ToLight { direction: DVec3::Y, t: 1e300 };
        assert_eq!(unit(&far, &wanted, "f").verdict, Verdict::Fail);
    }

    #[test]
    fn each_correct_answer_passes_and_no_other() {
        let grazing = right(Answer::Miss(true), &[hit(3.0, DVec3::Z), hit(3.0, -DVec3::Z)]);
        for legal in [Answer::Miss(true), hit(3.0, DVec3::Z), hit(3.0, -DVec3::Z)] {
            check(&legal, &grazing, Verdict::Pass, None);
        }
        let far = Some("the t differs by 1; 1e-6 is allowed");
        check(&hit(4.0, DVec3::Z), &grazing, Verdict::Fail, far);
        let other = Some("it answers value, expected miss");
        check(&Answer::Value(0.0), &grazing, Verdict::Fail, other);
        let nan = Some("the t is not a number");
        check(&hit(f64::NAN, DVec3::Z), &grazing, Verdict::Fail, nan);
        let found = |t, object| Answer::Found { t, object };
        let tie = right(found(1.0, 0), &[found(1.0, 1)]);
        check(&found(1.0, 1), &tie, Verdict::Pass, None);
        check(&found(2.0, 1), &tie, Verdict::Fail, far);
        let third = Some("it answers object 2, expected object 0");
        check(&found(1.0, 2), &tie, Verdict::Fail, third);
        let ends = Some("it answers ends, expected goes on");
        check(&Answer::GoesOn(false), &right(Answer::GoesOn(true), &[]), Verdict::Fail, ends);
    }

    #[test]
    fn lines_show_only_what_is_wrong() {
        let (expected, actual) = lines(&hit(1.5, DVec3::Z), &hit(1.500_000_1, DVec3::X), 1e-6);
        assert_eq!(expected, "hit\nt 1.5\nnormal.x 0\nnormal.y 0\nnormal.z 1\n");
        assert_eq!(actual, "hit\nt 1.5\nnormal.x 1\nnormal.y 0\nnormal.z 0\n");
        let (_, close) = lines(&Answer::Value(1.0), &Answer::Value(1.0 + 1e-12), 1e-14);
        assert_eq!(close, "value\nvalue 1.000000000001\n");
    }
}
