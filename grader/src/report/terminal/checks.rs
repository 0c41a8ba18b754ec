//! Writes lines on the checks that did not pass: an example of each group, and the number of the
//! others.

use pages::diff::{self, Side};
use pages::lines::count;

use super::groups::{self, Cause, Group};
use super::look::{BAD, GOOD, Look, ODD, indented, line};
use crate::functions;
use crate::plain::shown;
use crate::record::{CheckKind, CheckRecord, Finding, FindingKind, Record, Verdict};
use crate::report::{mistakes, words};

/// The number of groups for which the difference between the answers of an example is shown.
const MOST_DIFFERENCES: usize = 6;
/// The number of differing lines of an answer that are shown.
const MOST_DIFFERENT: usize = 8;
/// The number of characters of a message that are shown.
const MOST_OF_A_MESSAGE: usize = 180;
/// The number of checks of a group that are named.
const MOST_NAMED: usize = 3;

/// Writes the lines on all checks: in full if the look is verbose, else an example of each group.
pub(super) fn write(record: &Record, look: Look, text: &mut String) {
    let groups = groups::of(record);
    let are_answers_wrong =
        groups.iter().any(|group| is_of_a_function(group) && !is_of_a_composed_one(group));
    let mut n_differences = 0;
    for group in groups.iter().filter(|group| !matches!(group.cause, Cause::NotRun(..))) {
        match group.cause {
            _ if look.is_verbose => group.checks.iter().for_each(|one| in_full(record, one, text)),
            // A wrong function makes pictures and the functions that call it wrong, so these get
            // one line.
            Cause::Pictures(_) if are_answers_wrong => {
                in_short(&count(group.checks.len(), "wrong picture"), group, text);
            }
            Cause::Answers(function) if are_answers_wrong && is_of_a_composed_one(group) => {
                let n = count(group.checks.len(), "wrong answer");
                in_short(&format!("{n} of `{}`, which calls others", shown(function)), group, text);
            }
            _ => by_example(record, group, &mut n_differences, text),
        }
    }
    still_to_be_written(&groups, text);
    not_run(&groups, text);
    for (stage, remark) in
        record.stages.iter().flat_map(|stage| stage.remarks.iter().map(|one| (&stage.id, one)))
    {
        line(text, &format!("{ODD}{}{ODD:#}  {}", shown(stage), shown(remark)));
    }
}

fn is_of_a_function(group: &Group) -> bool {
    matches!(group.cause, Cause::Answers(_))
}

/// Returns whether a group is of a function that leaves most of its work to others.
fn is_of_a_composed_one(group: &Group) -> bool {
    let function = groups::function(group.checks[0]).and_then(functions::find);
    is_of_a_function(group) && function.is_some_and(|(_, function)| function.is_composed)
}

/// Writes one check of a group with its error, and the names of the others.
fn by_example(record: &Record, group: &Group, n_differences: &mut usize, text: &mut String) {
    let has_answers =
        |one: &&&CheckRecord| one.finding.as_ref().is_some_and(|it| it.expected.is_some());
    // An answer is more informative than a picture.
    let example = group.checks.iter().find(has_answers).unwrap_or(&group.checks[0]);
    headline(record, example, text);
    if has_answers(&example) && *n_differences < MOST_DIFFERENCES {
        *n_differences += 1;
        differences(example, false, text);
    }
    more(group, example, text);
}

/// Writes a line on a whole group.
fn in_short(what: &str, group: &Group, text: &mut String) {
    line(text, &format!("{BAD}{}{BAD:#}  {what}: {}", place(&group.checks), named(&group.checks)));
}

/// Returns the first names of checks, without their stage, and the number of the others.
fn named(checks: &[&CheckRecord]) -> String {
    let behind = |one: &&CheckRecord| {
        shown(one.id.split_once('/').map_or(one.id.as_str(), |(_, behind)| behind))
    };
    let names = checks.iter().take(MOST_NAMED).map(behind).collect::<Vec<_>>().join(", ");
    let rest = checks.len().saturating_sub(MOST_NAMED);
    if rest == 0 { names } else { format!("{names} and {rest} more (-v)") }
}

/// Writes the line on one check: its id, its error, its rules.
fn headline(record: &Record, check: &CheckRecord, text: &mut String) {
    let Some(finding) = &check.finding else { return };
    let style = if matches!(check.verdict, Verdict::Fail | Verdict::NotRun) { BAD } else { ODD };
    let part = match check.verdict {
        Verdict::Partial => format!("{} points, ", words::share(check.earned, check.possible)),
        _ => String::new(),
    };
    let rules: String = check.rules.iter().map(|rule| format!(" [rule {rule}]")).collect();
    let (kind, message) = (words::finding(finding.kind), short(&shown(&finding.message)));
    line(text, &format!("{style}{}{style:#}  {part}{kind}: {message}{rules}", shown(&check.id)));
    if let Some((lead, says)) = finding.diagnosis.as_ref().and_then(|id| mistakes::says(record, id))
    {
        line(text, &format!("    {} {}", lead.to_lowercase(), shown(says)));
    }
}

/// Writes the number of other checks in a group, and the first of their names.
fn more(group: &Group, example: &CheckRecord, text: &mut String) {
    let others: Vec<&CheckRecord> =
        group.checks.iter().copied().filter(|one| one.id != example.id).collect();
    let what = match group.cause {
        _ if others.is_empty() => return,
        Cause::Mistake(_) => "the same explains most of",
        Cause::Answers(_) | Cause::Pictures(_) => "wrong as well:",
        Cause::Ending(..) | Cause::NotRun(..) | Cause::Remark(..) => "the same applies to",
    };
    line(text, &format!("    {what} {}", named(&others)));
}

fn in_full(record: &Record, check: &CheckRecord, text: &mut String) {
    headline(record, check, text);
    let Some(finding) = &check.finding else { return };
    differences(check, true, text);
    details(check, finding, text);
}

fn details(check: &CheckRecord, finding: &Finding, text: &mut String) {
    indented(text, &shown(&check.about));
    if let Some(question) = &finding.asked {
        indented(text, &format!("question: {}", short(&shown(&question.to_string()))));
    }
    if let Some(stderr) = &finding.stderr {
        indented(text, &format!("standard error:\n{}", shown(stderr)));
    }
}

/// Writes the expected and the actual answer. Unless `is_whole`, only the first lines that differ
/// are written, side by side.
fn differences(check: &CheckRecord, is_whole: bool, text: &mut String) {
    let Some((expected, actual)) =
        check.finding.as_ref().and_then(|it| it.expected.as_ref().zip(it.actual.as_ref()))
    else {
        return;
    };
    let mut changes = diff::lines(expected, actual);
    changes.retain(|line| is_whole || line.side != Side::Same);
    let most = if is_whole { usize::MAX } else { MOST_DIFFERENT };
    for same in changes[..changes.len().min(most)].chunk_by(|a, b| !is_whole && a.side == b.side) {
        let (sign, style) = match same[0].side {
            Side::Expected => ("- expected ", GOOD),
            Side::Actual => ("+ yours    ", BAD),
            Side::Same => ("           ", anstyle::Style::new()),
        };
        let values: Vec<String> =
            same.iter().map(|change| change.text().trim_end().to_owned()).collect();
        line(text, &format!("    {style}{sign}{}{style:#}", values.join("  ")));
    }
    if changes.len() > most {
        line(text, &format!("    ({} (-v shows all))", count(changes.len() - most, "more line")));
    }
}

/// Writes the functions that are still to be written, in the order of the stages, each with the
/// checks that need it.
fn still_to_be_written(groups: &[Group], text: &mut String) {
    let mut waiting: Vec<(usize, &str, &Group)> = groups.iter().filter_map(waiting).collect();
    waiting.sort_by_key(|(place, ..)| *place);
    if !waiting.is_empty() {
        line(
            text,
            &format!("{ODD}still to be written{ODD:#} (each function, or one that it calls)"),
        );
    }
    for (_, message, group) in waiting {
        line(
            text,
            &format!("    {}: {}", shown(functions::subject(message)), counts(&group.checks)),
        );
    }
}

/// Returns the index of the function that the unit checks of a group need, and its message. `None`
/// for any other group.
fn waiting<'a>(group: &'a Group<'a>) -> Option<(usize, &'a str, &'a Group<'a>)> {
    let Cause::NotRun(FindingKind::Todo, message) = group.cause else { return None };
    let key = groups::function(group.checks[0])?;
    Some((functions::find(key).map_or(usize::MAX, |(place, _)| place), message, group))
}

/// Writes the other checks that were not run, one line for each reason.
fn not_run(groups: &[Group], text: &mut String) {
    for group in groups {
        if let (Cause::NotRun(_, why), None) = (group.cause, waiting(group)) {
            line(
                text,
                &format!("{ODD}not run{ODD:#}  {}: {}", counts(&group.checks), short(&shown(why))),
            );
        }
    }
}

/// Describes the number of pictures and unit checks, and their stage.
fn counts(checks: &[&CheckRecord]) -> String {
    let n = |kind| checks.iter().filter(|check| check.kind == kind).count();
    let kinds = [(n(CheckKind::Image), "picture"), (n(CheckKind::Unit), "unit check")];
    let kinds: Vec<String> =
        kinds.iter().filter(|(n, _)| *n > 0).map(|(n, what)| count(*n, what)).collect();
    format!("{} of {}", kinds.join(" and "), place(checks))
}

/// Returns the stage of the checks, or the number of their stages.
fn place(checks: &[&CheckRecord]) -> String {
    let mut stages: Vec<&str> =
        checks.iter().filter_map(|check| check.id.split('/').next()).collect();
    stages.dedup();
    match stages.as_slice() {
        [one] => shown(one),
        several => count(several.len(), "stage"),
    }
}

/// Returns the beginning of a long message, cut after a complete part if one ends in the second
/// half.
fn short(message: &str) -> String {
    let start: String = message.chars().take(MOST_OF_A_MESSAGE).collect();
    if start.len() == message.len() {
        return start;
    }
    let end = start.rfind("; ").filter(|end| *end > MOST_OF_A_MESSAGE / 2).unwrap_or(start.len());
    format!("{} […]", &start[..end])
}
