//! Turns the records into rows of numbers.

use std::collections::{BTreeMap, BTreeSet};

use super::entry::Entry;
use crate::collect::moment::shown_span;
use crate::collect::roll::{Member, Roll};
use crate::record::{FindingKind, Record, Verdict};
use crate::report::words;

/// Counts by kind of finding.
type Counts = BTreeMap<FindingKind, usize>;

/// A column of the table.
pub(super) struct Stage<'a> {
    pub(super) id: &'a str,
    pub(super) title: &'a str,
    /// The possible points, in thousandths.
    pub(super) possible: u64,
}

/// A submission, or a student of the roster. Points are in thousandths, and `None` without a
/// record.
pub(super) struct Row<'a> {
    /// The id of the submission; empty if there is none.
    pub(super) id: &'a str,
    pub(super) name: &'a str,
    /// The student, if there is a roster and the row is one of a student.
    pub(super) member: Option<&'a Member>,
    /// Whether the grader or the machine failed at the submission.
    pub(super) is_failed: bool,
    pub(super) earned: Option<u64>,
    pub(super) possible: Option<u64>,
    pub(super) build: &'static str,
    /// The points of each stage, in the order of the columns.
    pub(super) stages: Vec<Option<u64>>,
    pub(super) findings: Counts,
}

/// Returns the stages that occur, in order, and the rows, ordered by name. With a roll, each
/// student has a row, and so has each submission that counts for none.
pub(super) fn of<'a>(
    entries: &'a [Entry],
    roll: Option<&'a Roll>,
) -> (Vec<Stage<'a>>, Vec<Row<'a>>) {
    let mut stages = BTreeMap::new();
    for stage in
        entries.iter().filter_map(|entry| entry.record.as_ref()).flat_map(|record| &record.stages)
    {
        stages.entry(&*stage.id).or_insert(Stage {
            id: &stage.id,
            title: &stage.title,
            possible: stage.possible,
        });
    }
    let stages: Vec<Stage> = stages.into_values().collect();
    let members = roll.map_or(&[][..], |roll| &roll.members);
    let by_id: BTreeMap<&str, &Entry> = entries.iter().map(|entry| (&*entry.id, entry)).collect();
    let counted = |member: &Member| by_id.get(&**member.submission.as_ref()?).copied();
    let of_members = members.iter().map(|member| Row {
        name: if member.name.is_empty() { &member.id } else { &member.name },
        member: Some(member),
        ..row(counted(member), &stages)
    });
    let mut rows: Vec<Row> = of_members.collect();
    let taken: BTreeSet<&str> =
        members.iter().filter_map(|member| member.submission.as_deref()).collect();
    let others = entries.iter().filter(|entry| !taken.contains(&*entry.id));
    rows.extend(others.map(|entry| row(Some(entry), &stages)));
    rows.sort_by_key(|row| (row.name, row.member.map(|member| &member.id), row.id));
    (stages, rows)
}

/// Returns the row of a submission, or an empty one.
fn row<'a>(entry: Option<&'a Entry>, stages: &[Stage]) -> Row<'a> {
    let record = entry.and_then(|entry| entry.record.as_ref());
    let earned_in =
        |id: &str| record?.stages.iter().find(|stage| stage.id == id).map(|stage| stage.earned);
    Row {
        id: entry.map_or("", |entry| &entry.id),
        name: entry.map_or("", |entry| &entry.name),
        member: None,
        is_failed: entry.is_some_and(|entry| entry.record.is_none()),
        earned: record.map(|record| record.score.earned),
        possible: record.map(|record| record.score.possible),
        build: match record.map(|record| (record.interrupted, record.build.verdict)) {
            None if entry.is_none() => "",
            None => "not graded",
            Some((true, _)) => "interrupted",
            Some((_, Verdict::Pass)) => "worked",
            Some((_, verdict)) => words::verdict(verdict),
        },
        stages: stages.iter().map(|stage| earned_in(stage.id)).collect(),
        findings: record.map(findings).unwrap_or_default(),
    }
}

/// Returns how late a hand-in is; empty if it is in time, or if that is not known.
pub(super) fn late(member: &Member) -> String {
    member.late_s.filter(|late_s| *late_s > 0).map(shown_span).unwrap_or_default()
}

fn findings(record: &Record) -> Counts {
    let of_checks = record
        .stages
        .iter()
        .flat_map(|stage| &stage.checks)
        .filter_map(|check| check.finding.as_ref());
    let mut counts = Counts::new();
    for finding in of_checks.chain(&record.build.finding) {
        *counts.entry(finding.kind).or_default() += 1;
    }
    counts
}
