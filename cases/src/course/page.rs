//! What a course decides, as a page for its students.

use std::fmt::Write;

use super::{Course, DECISIONS, Decision, Legal};
use crate::effects::Effect;

const HEAD: &str = "\
# What this course decides

Courses that teach the Whitted ray tracer agree on most of the [rules of \
light](shading-model.md), not on all. Where they differ, a program for this
course follows this page; a value that another course chose is wrong here. `reference course` \
prints this page from `cases/course.toml`.

";

/// Every decision with the course's choice and its rule, and then all that could be chosen.
pub fn markdown(course: &Course) -> String {
    let mut page = HEAD.to_owned();
    let chosen = course.written();
    let n_other = DECISIONS
        .iter()
        .zip(&chosen)
        .filter(|(decision, value)| decision.legal.lecture() != **value)
        .count();
    page += &match n_other {
        0 => "This course decides everything as the lecture does.\n\n".to_owned(),
        1 => "One decision differs from the lecture's.\n\n".to_owned(),
        n => format!("{n} decisions differ from the lecture's.\n\n"),
    };
    page += "| key | what it decides | this course | rule |\n|---|---|---|---|\n";
    for (decision, value) in DECISIONS.iter().zip(&chosen) {
        let mark = if decision.legal.lecture() == *value { "" } else { " (not as in the lecture)" };
        let (key, decides) = (decision.key, decision.decides);
        let _ = writeln!(
            page,
            "| `{key}` | {decides} | {}{mark} | {} |",
            explained(decision, value),
            place(decision)
        );
    }
    page += "\n## All that could be chosen\n\nThe lecture's choice comes first.\n\n\
        | key | values |\n|---|---|\n";
    for decision in DECISIONS {
        let _ = writeln!(page, "| `{}` | {} |", decision.key, values(decision));
    }
    page + "\n`bytes` says how the expected pictures are made, `epsilon` what the unit checks \
        take for points that they bring themselves; students may choose theirs freely within what \
        [grading.md](grading.md) lists.\n"
}

/// A value as it is written, and what it means.
fn explained(decision: &Decision, value: &str) -> String {
    let Legal::OneOf(values) = decision.legal else { return format!("`{value}`") };
    let means = values.iter().find(|(written, _)| *written == value).map_or("", |(_, means)| means);
    format!("`{value}`: {means}")
}

fn values(decision: &Decision) -> String {
    match decision.legal {
        Legal::OneOf(values) => {
            let each: Vec<String> =
                values.iter().map(|(value, _)| explained(decision, value)).collect();
            each.join("<br>")
        }
        Legal::Range { least, most, lecture } => {
            format!("`{lecture:e}`; any number from {least:e} to {most:e}")
        }
        Legal::Effects => {
            let effects: Vec<String> =
                Effect::ALL.iter().map(|effect| format!("`\"{effect}\"`")).collect();
            format!("`[]`; any list of {}", effects.join(", "))
        }
    }
}

/// The rules and the decision of the shading model that it belongs to.
fn place(decision: &Decision) -> String {
    let rules = decision.rules.iter().map(u8::to_string);
    let number = decision.number.map(|number| format!("D{number}"));
    rules.chain(number).collect::<Vec<_>>().join(", ")
}
