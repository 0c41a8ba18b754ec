//! `results.json` of an external grader of PrairieLearn, which it reads from `/grade/results`.
//!
//! Every test has points, since one without them would hide the points of all. A fault of the
//! grader, and a hand-in that is no submission, are not gradable, which costs no attempt.

use serde_json::{Value, json};

use super::gradescope::{is_final, message, points, summary};
use crate::plain::{self, shown};
use crate::record::{CheckRecord, FindingKind, Record};

/// Most bytes of the file that PrairieLearn reads.
const MAX_BYTES: usize = 1 << 20;
/// Most characters of the text on a check. The first at which the file fits counts.
const LENGTHS: [usize; 4] = [4000, 1000, 200, 0];

/// Returns the text of the file.
pub fn to_string(record: &Record) -> String {
    let is_no_submission =
        record.build.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Submission);
    if is_no_submission || !is_final(record) {
        let results = json!({ "gradable": false, "format_errors": [summary(record)] });
        return plain::json(&results.to_string()) + "\n";
    }
    let texts = LENGTHS.iter().map(|most| {
        let text = plain::json(&gradable(record, *most).to_string()) + "\n";
        (text.len() <= MAX_BYTES).then_some(text)
    });
    // A file without texts on checks is far smaller for any exam that exists.
    texts.flatten().next().unwrap_or_else(|| {
        let results = json!({ "gradable": true, "score": share(record), "tests": [] });
        results.to_string() + "\n"
    })
}

fn gradable(record: &Record, most: usize) -> Value {
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    let tests: Vec<Value> = checks.map(|check| test(record, check, most)).collect();
    json!({
        "gradable": true,
        "score": share(record),
        "message": summary(record),
        "tests": tests,
    })
}

/// Returns the share of the points, from 0 to 1.
fn share(record: &Record) -> f64 {
    let possible = record.score.possible.max(1) as f64;
    (record.score.earned as f64 / possible).min(1.0)
}

fn test(record: &Record, check: &CheckRecord, most: usize) -> Value {
    let text = if most == 0 { String::new() } else { message(record, check, most) };
    json!({
        "name": shown(&check.id),
        "description": if most == 0 { String::new() } else { shown(&check.about) },
        "points": points(check.earned),
        "max_points": points(check.possible),
        "message": text,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Finding, Verdict};
    use crate::report::sample::{self, HOSTILE};

    /// Returns a record of which all points are final.
    fn record() -> Record {
        let mut record = sample::record(HOSTILE);
        let checks = record.stages.iter_mut().flat_map(|stage| &mut stage.checks);
        for check in checks.filter(|check| check.verdict == Verdict::Ours) {
            check.verdict = Verdict::Fail;
        }
        record
    }

    fn read(record: &Record) -> Value {
        let text = to_string(record);
        assert!(text.len() <= MAX_BYTES);
        serde_json::from_str(&text).unwrap()
    }

    #[test]
    fn the_file_has_the_documented_fields() {
        let results = read(&record());
        assert_eq!(results["gradable"], true);
        let score = results["score"].as_f64().unwrap();
        assert!((score - 6.75 / 16.0).abs() < 1e-12);
        let known = ["gradable", "score", "message", "tests"];
        assert!(results.as_object().unwrap().keys().all(|key| known.contains(&key.as_str())));
        for test in results["tests"].as_array().unwrap() {
            assert!(test["points"].as_f64().unwrap() <= test["max_points"].as_f64().unwrap());
            for key in ["name", "description", "message"] {
                assert!(test[key].is_string(), "{test}");
            }
            assert_eq!(test.as_object().unwrap().len(), 5);
        }
    }

    #[test]
    fn what_is_not_gradable_costs_no_attempt() {
        let mut ours = record();
        ours.stages[0].checks[0].verdict = Verdict::Ours;
        let mut none = record();
        none.build.finding = Some(Finding::new(FindingKind::Submission, "it is a .7z archive"));
        let mut stopped = record();
        stopped.interrupted = true;
        for (record, words) in
            [(ours, "no fault"), (none, "it is a .7z archive"), (stopped, "not final")]
        {
            let results = read(&record);
            assert_eq!(results["gradable"], false);
            assert!(results["format_errors"][0].as_str().unwrap().contains(words), "{results}");
        }
    }

    #[test]
    fn a_long_file_loses_texts_and_no_points() {
        let mut record = record();
        let mut check = record.stages[0].checks[1].clone();
        check.finding = Some(Finding::new(FindingKind::Wrong, "long ".repeat(10_000)));
        record.stages[0].checks = vec![check; 600];
        let results = read(&record);
        assert_eq!(results["tests"].as_array().unwrap().len(), 600);
        assert!(results["tests"][0]["message"].as_str().unwrap().ends_with('…'));
    }
}
