//! Bounds the text of a program in a record as a whole: a program could otherwise write out the
//! scenes of a hidden set, a little at each check.

use std::collections::BTreeSet;

use crate::record::{CheckRecord, Finding, FindingKind, StageRecord};

/// Bytes of a program's text in a record.
const MOST: usize = 32 << 10;

/// Characters of a message that quotes a program, once the bound is reached. The grader's own words
/// come first in it.
const LEAST: usize = 60;

/// Cuts the text that the program wrote at the checks of `stages`, in order, so that there are at
/// most [`MOST`] bytes of it, and a few words for each check beyond.
///
/// Text that an earlier check shows already is replaced by a reference to that check. A message of
/// an earlier check is repeated, since it reveals nothing more.
pub(super) fn apply(stages: &mut [StageRecord]) {
    let mut left = MOST;
    let mut shown: Vec<(String, String)> = vec![];
    let mut messages = BTreeSet::new();
    for CheckRecord { id, finding, .. } in stages.iter_mut().flat_map(|stage| &mut stage.checks) {
        let Some(finding) = finding else { continue };
        if messages.insert(finding.message.clone()) {
            bound_message(finding, &mut left);
        }
        let Some(text) = &mut finding.stderr else { continue };
        if let Some((first, _)) = shown.iter().find(|(_, other)| other == text) {
            *text = format!("[the same as at {first}]");
        } else if text.len() <= left {
            left -= text.len();
            shown.push((id.clone(), text.clone()));
        } else {
            let most = MOST >> 10;
            *text = format!("[left out: a report shows {most} KiB of a program's text in all]");
        }
    }
}

/// Counts a message that may quote the program, or cuts it if nothing is left.
fn bound_message(finding: &mut Finding, left: &mut usize) {
    let message = &mut finding.message;
    let quotes =
        matches!(finding.kind, FindingKind::Crash | FindingKind::Unreadable | FindingKind::Todo);
    match left.checked_sub(message.len()) {
        _ if !quotes => {}
        Some(rest) => *left = rest,
        None if message.chars().count() > LEAST => {
            *message = message.chars().take(LEAST).collect::<String>() + " […]";
        }
        None => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{CheckKind, Verdict};

    fn stage(findings: Vec<Finding>) -> StageRecord {
        let check = |(n, finding): (usize, Finding)| CheckRecord {
            id: format!("01/{n}"),
            kind: CheckKind::Unit,
            about: String::new(),
            rules: vec![],
            verdict: Verdict::Fail,
            earned: 0,
            possible: 1,
            finding: Some(finding),
            credit: None,
            time_s: 0.0,
            cpu_s: None,
            peak_bytes: 0,
        };
        let checks = findings.into_iter().enumerate().map(check).collect();
        StageRecord {
            id: "01".to_owned(),
            title: String::new(),
            earned: 0,
            possible: 1,
            checks,
            remarks: vec![],
        }
    }

    fn crash(message: &str, stderr: &str) -> Finding {
        Finding { stderr: Some(stderr.to_owned()), ..Finding::new(FindingKind::Crash, message) }
    }

    fn after(findings: Vec<Finding>) -> Vec<(String, String)> {
        let mut stages = [stage(findings)];
        apply(&mut stages);
        let found = stages[0].checks.iter().flat_map(|check| check.finding.clone());
        found.map(|one| (one.message, one.stderr.unwrap_or_default())).collect()
    }

    #[test]
    fn a_program_that_prints_at_each_check_is_cut_and_words_of_the_grader_stay() {
        let long = |n: usize| crash(&format!("{}{n:03}", "m".repeat(97)), &format!("{n:04000}"));
        let found = after((0..700).map(long).collect());
        let bytes: usize = found.iter().map(|(message, text)| message.len() + text.len()).sum();
        assert!(bytes < MOST + 700 * 150, "{bytes}");
        assert_eq!(found[0], (format!("{}000", "m".repeat(97)), format!("{:04000}", 0)));
        assert!(found[699].1.starts_with("[left out"), "{:?}", found[699]);
        assert_eq!(found[699].0, format!("{} […]", "m".repeat(LEAST)));
    }

    #[test]
    fn a_message_that_is_repeated_is_never_cut() {
        let todo = "still to be written: `shadow_attenuation` in tracer/shadow.py, says the grader";
        let found = after(vec![Finding::new(FindingKind::Todo, todo); 1000]);
        assert!(found.iter().all(|(message, _)| message == todo));
    }

    #[test]
    fn equal_text_is_shown_once() {
        let found = after(vec![crash("a", "warning: x"), crash("b", "warning: x")]);
        assert_eq!(found[0].1, "warning: x");
        assert_eq!(found[1], ("b".to_owned(), "[the same as at 01/0]".to_owned()));
    }

    #[test]
    fn a_long_message_of_the_grader_itself_is_never_cut() {
        let wrong = Finding::new(FindingKind::Wrong, "w".repeat(MOST));
        let found = after(vec![wrong.clone(), wrong]);
        assert!(found.iter().all(|(message, _)| message.len() == MOST));
    }
}
