//! The table of stages with the points, and the next step.

use super::groups;
use super::look::{BAD, BOLD, GOOD, Look, ODD, line};
use crate::functions;
use crate::plain::shown;
use crate::record::{CheckKind, CheckRecord, FindingKind, Record, StageRecord, Verdict};
use crate::report::words;

/// Writes a line for each stage, and the total.
pub(super) fn write(record: &Record, look: Look, text: &mut String) {
    let rows: Vec<[String; 3]> = record.stages.iter().map(cells).collect();
    let width =
        |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    for (stage, row) in record.stages.iter().zip(&rows) {
        let style = if stage.earned == stage.possible { GOOD } else { BAD };
        let mut columns = format!("{style}{:1$}{style:#}", row[0], width(0));
        for column in (1..3).filter(|column| width(*column) > 0) {
            columns += &format!("  {:>1$}", row[column], width(column));
        }
        line(text, &format!("{columns}  {} points", words::share(stage.earned, stage.possible)));
    }
    let sum = words::share(record.score.earned, record.score.possible);
    let protection = if look.is_verbose {
        format!("  (protection: {})", shown(&record.sandbox))
    } else {
        String::new()
    };
    line(text, &format!("{BOLD}{sum} points{BOLD:#}{protection}"));
    if has_internal(record) {
        line(
            text,
            &format!(
                "{ODD}Faults of the grader or the machine cost no points; report them to the \
                    staff.{ODD:#}"
            ),
        );
    }
}

/// Returns the id of a stage, and its counts of right pictures and right unit checks. A count is
/// empty if the stage has none.
fn cells(stage: &StageRecord) -> [String; 3] {
    let right = |kind: CheckKind, what: &str| {
        let all: Vec<&CheckRecord> =
            stage.checks.iter().filter(|check| check.kind == kind).collect();
        let n = all.iter().filter(|check| check.verdict == Verdict::Pass).count();
        if all.is_empty() { String::new() } else { format!("{n}/{} {what}", all.len()) }
    };
    [shown(&stage.id), right(CheckKind::Image, "pictures"), right(CheckKind::Unit, "unit checks")]
}

fn has_internal(record: &Record) -> bool {
    let is_internal = |check: &CheckRecord| {
        check.verdict == Verdict::Ours
            && check.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Internal)
    };
    record.stages.iter().flat_map(|stage| &stage.checks).any(is_internal)
}

/// Writes the next step if nothing is wrong: the function to write next, or the step after the last
/// one.
pub(super) fn next(record: &Record, text: &mut String) {
    let checks = || record.stages.iter().flat_map(|stage| &stage.checks);
    let is_wrong = |check: &CheckRecord| !matches!(check.verdict, Verdict::Pass | Verdict::NotRun);
    if record.build.verdict != Verdict::Pass || record.interrupted || checks().any(is_wrong) {
        return;
    }
    let place = |check: &&CheckRecord| {
        groups::function(check).and_then(functions::find).map_or(usize::MAX, |it| it.0)
    };
    let missing = checks().filter(|check| check.verdict == Verdict::NotRun).min_by_key(place);
    let step = match missing.map(|check| check.finding.as_ref()) {
        Some(Some(finding)) if finding.kind == FindingKind::Todo => {
            format!("write {}", shown(functions::subject(&finding.message)))
        }
        Some(_) => return,
        None if checks().next().is_none() => return,
        None => "everything that was run passes. Grade all stages (without --stage and --case), \
                 look at the pictures (--html report.html --open), and hand it in."
            .to_owned(),
    };
    line(text, &format!("{BOLD}Next{BOLD:#}  {step}"));
}
