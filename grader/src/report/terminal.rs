//! The report for a terminal: a table of stages, then what is wrong, where and why.

use std::collections::BTreeMap;
use std::fmt::Write;

use anstyle::{AnsiColor, Style};
use similar::{ChangeTag, TextDiff};

use super::{mistakes, words};
use crate::plain::shown;
use crate::record::{CheckKind, CheckRecord, Diagnosis, Finding, FindingKind, Record, StageRecord, Verdict};

const GOOD: Style = AnsiColor::Green.on_default();
const BAD: Style = AnsiColor::Red.on_default();
const ODD: Style = AnsiColor::Yellow.on_default();
const BOLD: Style = Style::new().bold();

/// Wrong answers of one function that are shown; more of them say little more.
const MOST_OF_ONE: usize = 3;

/// The report as text with colours; whoever prints it strips them where they do not belong. `is_verbose` adds warnings,
/// what programs wrote on their error streams, what each check is about, and all wrong answers of a function.
pub fn render(record: &Record, is_verbose: bool) -> String {
    let mut text = String::new();
    build(record, is_verbose, &mut text);
    for stage in &record.stages {
        checks(record, stage, is_verbose, &mut text);
        not_run(stage, &mut text);
        for remark in &stage.remarks {
            line(&mut text, &format!("{ODD}{}{ODD:#}  {}", stage.id, shown(remark)));
        }
    }
    if !text.is_empty() {
        text.push('\n');
    }
    table(record, &mut text);
    record.diagnoses.iter().for_each(|one| diagnosis(record, one, &mut text));
    text
}

/// What the program most likely does, where to look, and how much that explains.
fn diagnosis(record: &Record, diagnosis: &Diagnosis, text: &mut String) {
    let mut lead = format!("{BOLD}Most likely{BOLD:#}");
    for mistake in &diagnosis.mistakes {
        let see = mistakes::rule(mistake.rule).map_or(String::new(), |rule| format!("; see {}", rule.link()));
        line(text, &format!("{lead}  {} [rule {}]", shown(&mistake.says), mistake.rule));
        line(text, &format!("    look at {}{see}", mistakes::place(mistake)));
        lead = format!("{BOLD}or{BOLD:#}");
    }
    line(text, &format!("    It explains {}.", mistakes::extent(record, diagnosis)));
}

fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

fn indented(text: &mut String, block: &str) {
    block.lines().for_each(|one| line(text, &format!("    {one}")));
}

fn build(record: &Record, is_verbose: bool, text: &mut String) {
    for ignored in &record.build.ignored {
        line(text, &format!("{ODD}left aside{ODD:#}  {}", shown(ignored)));
    }
    let warnings = &record.build.warnings;
    if is_verbose {
        warnings.iter().for_each(|warning| line(text, &format!("{}\n", shown(warning))));
    } else if !warnings.is_empty() {
        let s = if warnings.len() == 1 { "" } else { "s" };
        line(text, &format!("{ODD}the compiler gives {} warning{s}{ODD:#} (-v shows them)", warnings.len()));
    }
    if let Some(finding) = &record.build.finding {
        line(text, &format!("{BAD}{}{BAD:#}", words::finding(finding.kind)));
        indented(text, &shown(&finding.message));
    }
}

/// What there is to say of the checks that were run: of the wrong answers of one function the first few, and how many more there are.
fn checks(record: &Record, stage: &StageRecord, is_verbose: bool, text: &mut String) {
    let mut wrong: BTreeMap<&str, usize> = BTreeMap::new();
    for one in stage.checks.iter().filter(|check| check.verdict != Verdict::NotRun) {
        if let Some(function) = function(one).filter(|_| !is_verbose) {
            let n = wrong.entry(function).or_default();
            *n += 1;
            if *n > MOST_OF_ONE {
                continue;
            }
        }
        check(record, one, is_verbose, text);
    }
    for (function, n) in wrong.into_iter().filter(|(_, n)| *n > MOST_OF_ONE) {
        let more = count(n - MOST_OF_ONE, "more wrong answer");
        line(text, &format!("{BAD}{}{BAD:#}  {more} of `{}` (-v shows all)", stage.id, shown(function)));
    }
}

/// The function that a unit check asks, where it failed.
fn function(check: &CheckRecord) -> Option<&str> {
    let finding = check.finding.as_ref().filter(|_| check.verdict == Verdict::Fail)?;
    finding.asked.as_ref()?.get("fn")?.as_str()
}

/// A line on a check that is not simply right; for a wrong answer also the difference.
fn check(record: &Record, check: &CheckRecord, is_verbose: bool, text: &mut String) {
    let Some(finding) = &check.finding else { return };
    let style = match check.verdict {
        Verdict::Pass | Verdict::Partial | Verdict::Ours => ODD,
        Verdict::Fail | Verdict::NotRun => BAD,
    };
    let part = match check.verdict {
        Verdict::Partial => format!("{} of {} points, ", words::points(check.earned), words::points(check.possible)),
        _ => String::new(),
    };
    let rules: String = check.rules.iter().map(|rule| format!(" [rule {rule}]")).collect();
    let kind = words::finding(finding.kind);
    line(text, &format!("{style}{}{style:#}  {part}{kind}: {}{rules}", check.id, shown(&finding.message)));
    if let Some(says) = finding.diagnosis.as_ref().and_then(|id| mistakes::says(record, id)) {
        line(text, &format!("    most likely {}", shown(says)));
    }
    if let (Some(expected), Some(actual)) = (&finding.expected, &finding.actual) {
        difference(&shown(expected), &shown(actual), text);
    }
    if is_verbose {
        details(check, finding, text);
    }
}

fn details(check: &CheckRecord, finding: &Finding, text: &mut String) {
    indented(text, &check.about);
    if let Some(asked) = &finding.asked {
        let question = shown(&asked.to_string());
        let cut: String = question.chars().take(400).collect();
        indented(text, &format!("asked: {cut}{}", if cut.len() < question.len() { " […]" } else { "" }));
    }
    if let Some(stderr) = &finding.stderr {
        indented(text, &format!("standard error:\n{}", shown(stderr)));
    }
}

/// Expected and actual, line by line: `-` was expected, `+` came.
fn difference(expected: &str, actual: &str, text: &mut String) {
    for change in TextDiff::from_lines(expected, actual).iter_all_changes() {
        let (sign, style) = match change.tag() {
            ChangeTag::Delete => ("- expected ", GOOD),
            ChangeTag::Insert => ("+ yours    ", BAD),
            ChangeTag::Equal => ("           ", Style::new()),
        };
        line(text, &format!("    {style}{sign}{}{style:#}", change.value().trim_end()));
    }
}

/// What was not run, in as few lines as there are reasons.
fn not_run(stage: &StageRecord, text: &mut String) {
    let mut reasons: BTreeMap<&str, Vec<&CheckRecord>> = BTreeMap::new();
    for check in stage.checks.iter().filter(|check| check.verdict == Verdict::NotRun) {
        let why = check.finding.as_ref().map_or("not run", |finding| finding.message.as_str());
        reasons.entry(why).or_default().push(check);
    }
    for (why, checks) in reasons {
        let n = |kind| checks.iter().filter(|check| check.kind == kind).count();
        let counts = [(n(CheckKind::Image), "picture"), (n(CheckKind::Unit), "unit check")];
        let counts: Vec<String> = counts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| count(*n, what)).collect();
        line(text, &format!("{ODD}{}{ODD:#}  {}: {}", stage.id, counts.join(" and "), shown(why)));
    }
}

fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

fn table(record: &Record, text: &mut String) {
    let width = record.stages.iter().map(|stage| stage.id.len()).max().unwrap_or(0);
    for stage in &record.stages {
        let style = if stage.earned == stage.possible { GOOD } else { BAD };
        let right = |kind| {
            let all = stage.checks.iter().filter(|check| check.kind == kind);
            let n = all.clone().filter(|check| check.verdict == Verdict::Pass).count();
            (n, all.count())
        };
        let ((images, n_images), (units, n_units)) = (right(CheckKind::Image), right(CheckKind::Unit));
        let points = format!("{} of {} points", words::points(stage.earned), words::points(stage.possible));
        let _ = writeln!(
            text,
            "{style}{:width$}{style:#}  {images:>2}/{n_images:<2} pictures  {units:>2}/{n_units:<2} unit checks  {points}",
            stage.id
        );
    }
    let (earned, possible) = (words::points(record.score.earned), words::points(record.score.possible));
    let _ = writeln!(text, "{BOLD}{earned} of {possible} points{BOLD:#}  (protection: {})", record.sandbox);
    if has_internal(record) {
        line(text, &format!("{ODD}What is our fault is left out of the points; tell whoever runs this course.{ODD:#}"));
    }
}

fn has_internal(record: &Record) -> bool {
    let is_internal = |check: &CheckRecord| {
        check.verdict == Verdict::Ours && check.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Internal)
    };
    record.stages.iter().flat_map(|stage| &stage.checks).any(is_internal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    fn text(record: &Record, is_verbose: bool) -> String {
        anstream::adapter::strip_str(&render(record, is_verbose)).to_string()
    }

    #[test]
    fn says_what_is_wrong_and_how_many_points_that_makes() {
        let shown = text(&sample::record("somebody"), false);
        let parts = ["left aside", "1 warning (-v", "[rule 3] [rule 14]", "- expected ", "+ yours    ", " points"];
        for part in parts.into_iter().chain(["  0.75 of 2 points, wrong: ", "look at this: "]) {
            assert!(shown.contains(part), "no {part:?} in\n{shown}");
        }
    }

    #[test]
    fn names_the_mistakes_that_explain_what_is_wrong() {
        let shown = text(&sample::record("somebody"), false);
        let end = "\nMost likely  the one is <wrong> [rule 3]\n    look at sphere.rs, function intersect_sphere; \
                   see docs/shading-model.md#rule-3-direct-light\nor  the other is <wrong> [rule 14]\n    \
                   look at sphere.rs, function intersect_sphere; see docs/shading-model.md#rule-14-the-sphere\n    \
                   It explains 1 of 3 failed pictures and 1 of 1 failed unit check.\n";
        assert!(shown.ends_with(end), "{shown}");
        assert_eq!(shown.matches("    most likely the one is <wrong>\n").count(), 2, "{shown}");
    }

    #[test]
    fn one_wrong_function_does_not_fill_the_screen() {
        let mut record = sample::record("somebody");
        let checks = &mut record.stages[0].checks;
        let wrong = checks.iter().find(|check| check.id.ends_with("inside")).cloned().unwrap();
        checks.extend((0..4).map(|_| wrong.clone()));
        let n_shown = |is_verbose| text(&record, is_verbose).matches("sphere/inside").count();
        assert_eq!((n_shown(false), n_shown(true)), (3, 5));
        assert!(text(&record, false).contains("2 more wrong answers of `sphere` (-v shows all)"));
        assert!(!text(&record, true).contains("-v shows all"));
    }

    #[test]
    fn nothing_of_the_submission_reaches_the_terminal_raw() {
        let rendered = render(&sample::record("somebody"), true);
        let own = anstream::adapter::strip_str(&rendered).to_string();
        assert!(!own.contains('\u{1b}'), "{own:?}");
        assert!(own.chars().all(|c| c == '\n' || !crate::plain::is_hidden(c)), "{own:?}");
    }
}
