//! Turns the table into the values that the template shows.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::histogram::{self, Histogram};
use super::{Entry, entry, rows};
use crate::alike::Pair;
use crate::collect::roll::{Member as Student, Roll};
use crate::plain::shown;
use crate::record::{CheckRecord, Confidence, FindingKind, Verdict};
use crate::report::words;

#[derive(Serialize)]
pub(super) struct Class {
    n_graded: usize,
    missing: Vec<String>,
    epochs: Vec<String>,
    median: Option<String>,
    histograms: Vec<Histogram>,
    stages: Vec<Stage>,
    rows: Vec<Row>,
    mistakes: Vec<Mistake>,
    checks: Vec<Check>,
    flagged: Vec<Flagged>,
    alike: Vec<Alike>,
    /// Whether the rows are those of a roster.
    has_roll: bool,
    deadline: Option<String>,
    decisions: Vec<Decision>,
    not_counted: Vec<Decision>,
}

/// A question for a person, or a hand-in that does not count.
#[derive(Serialize)]
struct Decision {
    hand_ins: String,
    students: String,
    why: String,
}

#[derive(Serialize)]
struct Stage {
    id: String,
    title: String,
    possible: String,
}

#[derive(Serialize)]
struct Row {
    id: String,
    name: String,
    is_graded: bool,
    /// The student of the row, if there is a roster.
    member: Option<Member>,
    /// The total in thousandths, to sort by, and as text.
    total: Number,
    stages: Vec<Number>,
    build: &'static str,
    findings: String,
}

/// What the roster and the policy say about a row.
#[derive(Serialize)]
struct Member {
    id: String,
    section: String,
    handed_in: String,
    late: Number,
    deduction: Number,
    total: Number,
    standing: &'static str,
}

#[derive(Serialize)]
struct Number {
    value: u64,
    text: String,
}

/// A picture that a person should look at.
#[derive(Serialize)]
struct Flagged {
    id: String,
    name: String,
    check: String,
    message: String,
}

/// Two submissions whose sources are alike.
#[derive(Serialize)]
struct Alike {
    /// The id and the name of each.
    ids: [String; 2],
    names: [String; 2],
    percent: String,
}

/// Counts of the submissions that got a check right.
#[derive(Serialize)]
struct Check {
    id: String,
    n_right: usize,
    n_partly: usize,
    n_run: usize,
}

/// The count of submissions that seem to make a mistake.
#[derive(Serialize)]
struct Mistake {
    says: String,
    /// The broken rule; 0 if it breaks none.
    rule: u8,
    n: usize,
    /// The number of these submissions for which the mistake is not sure.
    n_perhaps: usize,
}

/// The kinds of finding that a person should look at.
const FLAGS: [FindingKind; 2] = [FindingKind::Contested, FindingKind::Nondeterministic];

pub(super) fn class(entries: &[Entry], alike: &[Pair], roll: Option<&Roll>) -> Class {
    let (stages, rows) = rows::of(entries, roll);
    let totals = rows.iter().filter_map(|row| row.earned.zip(row.possible));
    let of_stage = |n: usize, stage: &rows::Stage| {
        let scores = rows.iter().filter_map(move |row| row.stages[n]);
        histogram::of(shown(stage.title), scores.map(|earned| (earned, stage.possible)))
    };
    let mut histograms = vec![histogram::of("All stages".to_owned(), totals)];
    histograms.extend(stages.iter().enumerate().map(|(n, stage)| of_stage(n, stage)));
    let mut epochs: Vec<String> =
        entries.iter().flat_map(|entry| &entry.record).map(|one| shown(&one.epoch)).collect();
    epochs.sort();
    epochs.dedup();
    Class {
        n_graded: entries.iter().filter(|entry| entry.record.is_some()).count(),
        missing: rows.iter().filter(|row| row.is_failed).map(|row| shown(row.name)).collect(),
        epochs,
        median: median(rows.iter().filter_map(|row| row.earned).collect()).map(words::points),
        histograms,
        stages: stages.iter().map(stage).collect(),
        rows: rows.iter().map(row).collect(),
        mistakes: mistakes(entries),
        checks: checks(entries),
        flagged: flagged(entries, &rows),
        alike: alike.iter().map(|pair| self::alike(entries, pair)).collect(),
        has_roll: roll.is_some(),
        deadline: roll.and_then(|roll| roll.deadline.clone()),
        decisions: roll.map(decisions).unwrap_or_default(),
        not_counted: roll.map(not_counted).unwrap_or_default(),
    }
}

/// Returns the median, the lower one of two middle values. `None` for no values.
fn median(mut values: Vec<u64>) -> Option<u64> {
    values.sort_unstable();
    values.get(values.len().saturating_sub(1) / 2).copied()
}

fn stage(stage: &rows::Stage) -> Stage {
    Stage {
        id: shown(stage.id),
        title: shown(stage.title),
        possible: words::points(stage.possible),
    }
}

fn decisions(roll: &Roll) -> Vec<Decision> {
    let decision = |one: &crate::collect::roll::Decision| Decision {
        hand_ins: shown(&one.hand_ins.join(", ")),
        students: shown(&one.students.join(", ")),
        why: shown(&one.why),
    };
    roll.decisions.iter().map(decision).collect()
}

fn not_counted(roll: &Roll) -> Vec<Decision> {
    let decision = |one: &crate::collect::roll::NotCounted| Decision {
        hand_ins: shown(&one.hand_in),
        students: shown(&one.students.join(", ")),
        why: shown(&one.why),
    };
    roll.not_counted.iter().map(decision).collect()
}

fn number(value: &Option<u64>) -> Number {
    Number {
        value: value.unwrap_or(0), text: value.map_or_else(|| "–".to_owned(), words::points)
    }
}

fn member(member: &Student) -> Member {
    Member {
        id: shown(&member.id),
        section: shown(&member.section),
        handed_in: shown(member.handed_in.as_deref().unwrap_or("–")),
        late: Number { value: member.late_s.unwrap_or(0), text: rows::late(member) },
        deduction: number(&member.deduction),
        total: number(&member.total),
        standing: member.standing.words(),
    }
}

fn row(row: &rows::Row) -> Row {
    let findings =
        row.findings.iter().map(|(kind, count)| format!("{count} × {}", words::finding(*kind)));
    Row {
        id: shown(row.id),
        name: shown(row.name),
        is_graded: row.earned.is_some(),
        member: row.member.map(member),
        total: number(&row.earned),
        stages: row.stages.iter().map(number).collect(),
        build: row.build,
        findings: findings.collect::<Vec<_>>().join(", "),
    }
}

fn alike(entries: &[Entry], Pair { ids, share }: &Pair) -> Alike {
    Alike {
        names: ids.each_ref().map(|id| shown(entry::name(entries, id))),
        ids: ids.each_ref().map(|id| shown(id)),
        // No pair that differs is shown as equal.
        percent: format!("{:.0} %", (share * 100.0).floor()),
    }
}

/// Returns the pictures that a person should look at. Those of a submission of several students are
/// listed once.
fn flagged(entries: &[Entry], rows: &[rows::Row]) -> Vec<Flagged> {
    let mut seen = BTreeSet::new();
    let first = rows.iter().filter(|row| seen.insert(row.id));
    first.flat_map(|row| flagged_in(entries, row)).collect()
}

fn flagged_in(entries: &[Entry], row: &rows::Row) -> Vec<Flagged> {
    let record =
        entries.iter().find(|entry| entry.id == row.id).and_then(|entry| entry.record.as_ref());
    let checks =
        record.into_iter().flat_map(|record| &record.stages).flat_map(|stage| &stage.checks);
    let flag = |check: &CheckRecord| {
        let finding = check.finding.as_ref().filter(|finding| FLAGS.contains(&finding.kind))?;
        let (id, name) = (shown(row.id), shown(row.name));
        Some(Flagged { id, name, check: shown(&check.id), message: shown(&finding.message) })
    };
    checks.filter_map(flag).collect()
}

/// Returns the checks, ordered by the share of submissions that got them right, the smallest first.
fn checks(entries: &[Entry]) -> Vec<Check> {
    let mut counts: BTreeMap<&str, Check> = BTreeMap::new();
    let records = entries.iter().filter_map(|entry| entry.record.as_ref());
    for check in records.flat_map(|record| &record.stages).flat_map(|stage| &stage.checks) {
        let fresh = || Check { id: shown(&check.id), n_right: 0, n_partly: 0, n_run: 0 };
        let count = counts.entry(&check.id).or_insert_with(fresh);
        count.n_right += usize::from(check.verdict == Verdict::Pass);
        count.n_partly += usize::from(check.verdict == Verdict::Partial);
        count.n_run += 1;
    }
    let mut checks: Vec<Check> = counts.into_values().collect();
    checks.sort_by(|a, b| {
        (a.n_right * b.n_run).cmp(&(b.n_right * a.n_run)).then_with(|| a.id.cmp(&b.id))
    });
    checks
}

/// Returns the mistakes, the most frequent first, each with the first sentence on it. If a
/// diagnosis has several possible mistakes, its first one counts.
fn mistakes(entries: &[Entry]) -> Vec<Mistake> {
    let records = entries.iter().filter_map(|entry| entry.record.as_ref());
    let mut counts: BTreeMap<(u8, &str), Mistake> = BTreeMap::new();
    for diagnosis in records.flat_map(|record| &record.diagnoses) {
        let Some(one) = diagnosis.mistakes.first() else { continue };
        let fresh = || Mistake { says: shown(&one.says), rule: one.rule, n: 0, n_perhaps: 0 };
        let count = counts.entry((one.rule, &one.id)).or_insert_with(fresh);
        count.n += 1;
        count.n_perhaps += usize::from(diagnosis.confidence == Confidence::Perhaps);
    }
    let mut mistakes: Vec<Mistake> = counts.into_values().collect();
    // The sort is stable, so equally frequent mistakes stay ordered by rule.
    mistakes.sort_by_key(|mistake| std::cmp::Reverse(mistake.n));
    mistakes
}
