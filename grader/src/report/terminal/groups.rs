//! Groups the checks that did not pass by their cause, so that one bug takes a few lines.

use std::collections::BTreeMap;

use crate::record::{CheckKind, CheckRecord, FindingKind, Record, Verdict};

/// Checks with the same cause, in the order of the record.
pub(super) struct Group<'a> {
    pub(super) cause: Cause<'a>,
    pub(super) checks: Vec<&'a CheckRecord>,
}

/// The common cause of a group.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Cause<'a> {
    /// A known mistake explains the checks.
    Mistake(&'a str),
    /// One function gives wrong answers, in any stage.
    Answers(&'a str),
    /// The pictures of a stage are wrong.
    Pictures(&'a str),
    /// The program ended in the same way, or another finding has the same kind and words.
    Ending(FindingKind, &'a str),
    /// The checks were not run, for this reason.
    NotRun(FindingKind, &'a str),
    /// The checks passed, and something is worth saying.
    Remark(FindingKind, &'a str),
}

/// Returns the groups in the order of their first checks. A check that passed without a remark is
/// in none.
pub(super) fn of(record: &Record) -> Vec<Group<'_>> {
    let mut groups: Vec<Group> = vec![];
    let mut places: BTreeMap<Cause, usize> = BTreeMap::new();
    for (stage, check) in
        record.stages.iter().flat_map(|stage| stage.checks.iter().map(move |check| (stage, check)))
    {
        let Some(cause) = cause(&stage.id, check) else { continue };
        let place = *places.entry(cause).or_insert(groups.len());
        if place == groups.len() {
            groups.push(Group { cause, checks: vec![] });
        }
        groups[place].checks.push(check);
    }
    groups
}

fn cause<'a>(stage: &'a str, check: &'a CheckRecord) -> Option<Cause<'a>> {
    let kind = check.finding.as_ref().map_or(FindingKind::Remark, |finding| finding.kind);
    let message =
        check.finding.as_ref().map_or("no reason is given", |finding| finding.message.as_str());
    let diagnosis = check.finding.as_ref().and_then(|finding| finding.diagnosis.as_deref());
    match (check.verdict, kind, check.kind) {
        (Verdict::Pass, ..) => check.finding.as_ref().map(|_| Cause::Remark(kind, message)),
        (Verdict::NotRun, ..) => Some(Cause::NotRun(kind, message)),
        (Verdict::Partial | Verdict::Fail, ..) if diagnosis.is_some() => {
            diagnosis.map(Cause::Mistake)
        }
        (Verdict::Fail | Verdict::Partial, FindingKind::Wrong, CheckKind::Unit) => {
            Some(Cause::Answers(function(check).unwrap_or(&check.id)))
        }
        (Verdict::Fail | Verdict::Partial, FindingKind::Wrong, CheckKind::Image) => {
            Some(Cause::Pictures(stage))
        }
        _ => Some(Cause::Ending(kind, message)),
    }
}

/// Returns the function that a unit check calls, by its name in the protocol.
pub(super) fn function(check: &CheckRecord) -> Option<&str> {
    check.finding.as_ref()?.asked.as_ref()?.get("fn")?.as_str()
}
