//! Prints the decisions of a course as a page for its students.

use std::fmt::Write;

use super::{Course, DECISIONS, Decision, Legal};
use crate::effects::Effect;

const HEAD: &str = "\
# What this course decides

Courses that teach the Whitted ray tracer agree on most of the \
[rules of light](shading-model.md). Where they differ, a program for this course follows this \
page. A choice of another course is wrong here. `reference course` prints this page from \
`cases/course.toml`.

";

/// Returns the page as Markdown: every decision with the course's choice and its rule, then all
/// legal choices.
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
        let (key, decides) = (decision.key, cell(decision.decides));
        let _ = writeln!(
            page,
            "| `{key}` | {decides} | {}{mark} | {} |",
            explained(decision, value),
            place(decision)
        );
    }
    page += "\n## All legal choices\n\nThe lecture's choice comes first.\n\n\
        | key | values |\n|---|---|\n";
    for decision in DECISIONS {
        let _ = writeln!(page, "| `{}` | {} |", decision.key, values(decision));
    }
    page + "\n`bytes` decides how the expected pictures are rounded. `epsilon` is the RAY_EPSILON \
        of unit checks that give a point. Students may choose their own values within the \
        freedoms of [grading.md](grading.md).\n"
}

/// Returns a value in its written form, with its meaning.
fn explained(decision: &Decision, value: &str) -> String {
    let Legal::OneOf(values) = decision.legal else { return format!("`{value}`") };
    let means = values.iter().find(|(written, _)| *written == value).map_or("", |(_, means)| means);
    format!("`{value}`: {}", cell(means))
}

/// Returns `text` as a cell of a table. A bar, as in |N·L|, would end the cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
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

/// Returns the rules and the decision of the shading model that `decision` belongs to.
fn place(decision: &Decision) -> String {
    let rules = decision.rules.iter().map(u8::to_string);
    let number = decision.number.map(|number| format!("D{number}"));
    rules.chain(number).collect::<Vec<_>>().join(", ")
}
