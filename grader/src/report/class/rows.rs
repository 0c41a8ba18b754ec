//! Turns the records into rows of numbers.

use std::collections::BTreeMap;

use super::entry::Entry;
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

/// A submission. Points are in thousandths, and `None` if it has no record.
pub(super) struct Row<'a> {
    pub(super) id: &'a str,
    pub(super) name: &'a str,
    pub(super) earned: Option<u64>,
    pub(super) possible: Option<u64>,
    pub(super) build: &'static str,
    /// The points of each stage, in the order of the columns.
    pub(super) stages: Vec<Option<u64>>,
    pub(super) findings: Counts,
}

/// Returns the stages that occur, in order, and the rows, ordered by name.
pub(super) fn of(entries: &[Entry]) -> (Vec<Stage<'_>>, Vec<Row<'_>>) {
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
    let mut rows: Vec<Row> = entries.iter().map(|entry| row(entry, &stages)).collect();
    rows.sort_by_key(|row| (row.name, row.id));
    (stages, rows)
}

fn row<'a>(entry: &'a Entry, stages: &[Stage]) -> Row<'a> {
    let record = entry.record.as_ref();
    let earned_in =
        |id: &str| record?.stages.iter().find(|stage| stage.id == id).map(|stage| stage.earned);
    Row {
        id: &entry.id,
        name: &entry.name,
        earned: record.map(|record| record.score.earned),
        possible: record.map(|record| record.score.possible),
        build: match record.map(|record| (record.interrupted, record.build.verdict)) {
            None => "not graded",
            Some((true, _)) => "interrupted",
            Some((_, Verdict::Pass)) => "worked",
            Some((_, verdict)) => words::verdict(verdict),
        },
        stages: stages.iter().map(|stage| earned_in(stage.id)).collect(),
        findings: record.map(findings).unwrap_or_default(),
    }
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
