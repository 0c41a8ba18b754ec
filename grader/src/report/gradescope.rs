//! `results.json` of a Gradescope autograder, which it reads from `/autograder/results`.
//!
//! `score` overrides the sum of the tests, so that every thousandth of a point is kept. Standard
//! output stays hidden, since it may name hidden cases.

use serde_json::{Value, json};

use super::{mistakes, words};
use crate::plain::{self, shown};
use crate::record::{CheckRecord, Finding, Record, Verdict};

/// Most characters of a text that goes into a results file.
const MAX_TEXT: usize = 4000;

/// Returns the text of the file.
pub fn to_string(record: &Record) -> String {
    let checks = || record.stages.iter().flat_map(|stage| &stage.checks);
    let seconds: f64 = checks().map(|check| check.time_s).filter(|time| time.is_finite()).sum();
    let tests: Vec<Value> = record
        .stages
        .iter()
        .flat_map(|stage| stage.checks.iter().map(|check| test(record, &stage.title, check)))
        .collect();
    let results = json!({
        "score": points(record.score.earned),
        "execution_time": seconds.clamp(0.0, 1e9).round() as u64,
        "output": summary(record),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "stdout_visibility": "hidden",
        "tests": tests,
        "extra_data": {
            "grader": shown(&record.grader),
            "epoch": shown(&record.epoch),
            "submission": shown(&record.submission.digest),
            "is_final": is_final(record),
        },
    });
    plain::json(&results.to_string()) + "\n"
}

fn test(record: &Record, stage: &str, check: &CheckRecord) -> Value {
    let status = if check.verdict == Verdict::Pass { "passed" } else { "failed" };
    json!({
        "name": shown(&check.id),
        "name_format": "text",
        "score": points(check.earned),
        "max_score": points(check.possible),
        "status": status,
        "output": message(record, check, MAX_TEXT),
        "output_format": "text",
        "tags": [shown(stage)],
        "visibility": "visible",
    })
}

/// Returns points as the number that JSON holds.
pub(super) fn points(thousandths: u64) -> f64 {
    thousandths as f64 / 1000.0
}

/// Returns whether the points are final: nothing was interrupted, and neither the grader nor the
/// machine failed.
pub(super) fn is_final(record: &Record) -> bool {
    let verdicts = record.stages.iter().flat_map(|stage| &stage.checks).map(|check| check.verdict);
    !record.interrupted && !verdicts.chain([record.build.verdict]).any(|one| one == Verdict::Ours)
}

/// Returns the points in words, and the fault of the build if there is one.
pub(super) fn summary(record: &Record) -> String {
    let mut text = format!("{} points", words::share(record.score.earned, record.score.possible));
    if !is_final(record) {
        text += "\nThe grader or the machine failed, or was stopped, so these points are not \
            final. This is no fault of the submission.";
    }
    if let Some(finding) = &record.build.finding {
        text += &format!("\n{}", of_finding(finding, MAX_TEXT));
    }
    text
}

/// Returns what a student should read about a check, of at most so many characters.
pub(super) fn message(record: &Record, check: &CheckRecord, most: usize) -> String {
    let Some(finding) = &check.finding else { return words::verdict(check.verdict).to_owned() };
    let likely = mistakes::says(record, finding.diagnosis.as_deref().unwrap_or_default());
    let mut text = format!("{}: {}", words::verdict(check.verdict), of_finding(finding, most));
    text.extend(likely.map(|(lead, says)| format!("\n{lead} {}", shown(says))));
    cut(&text, most)
}

fn of_finding(finding: &Finding, most: usize) -> String {
    cut(&format!("{}: {}", words::finding(finding.kind), shown(&finding.message)), most)
}

fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample::{self, HOSTILE};

    /// The documented fields of a test, each with a check of its value.
    fn expect_test(test: &Value) {
        let is_text = |value: &Value| value.is_string();
        for (key, value) in test.as_object().expect("an object") {
            let is_right = match key.as_str() {
                "score" | "max_score" => value.as_f64().is_some_and(|points| points >= 0.0),
                "status" => ["passed", "failed"].contains(&value.as_str().unwrap_or_default()),
                "name" | "output" | "number" => is_text(value),
                "name_format" | "output_format" => {
                    let formats = ["text", "html", "simple_format", "md", "ansi"];
                    formats.contains(&value.as_str().unwrap_or_default())
                }
                "tags" => value.as_array().is_some_and(|tags| tags.iter().all(is_text)),
                "visibility" => ["hidden", "after_due_date", "after_published", "visible"]
                    .contains(&value.as_str().unwrap_or_default()),
                _ => false,
            };
            assert!(is_right, "{key}: {value}");
        }
    }

    #[test]
    fn the_file_has_the_documented_fields() {
        let record = sample::record(HOSTILE);
        let results: Value = serde_json::from_str(&to_string(&record)).unwrap();
        assert_eq!(results["score"], 6.75);
        assert_eq!(results["stdout_visibility"], "hidden");
        let known = [
            "score",
            "execution_time",
            "output",
            "output_format",
            "test_output_format",
            "test_name_format",
            "stdout_visibility",
            "tests",
            "extra_data",
        ];
        let object = results.as_object().unwrap();
        assert!(object.keys().all(|key| known.contains(&key.as_str())), "{results}");
        assert!(results["execution_time"].is_u64());
        let tests = results["tests"].as_array().unwrap();
        assert_eq!(tests.len(), record.stages[0].checks.len());
        tests.iter().for_each(expect_test);
        let sum: f64 = tests.iter().map(|test| test["score"].as_f64().unwrap()).sum();
        let earned: u64 = record.stages[0].checks.iter().map(|check| check.earned).sum();
        assert!((sum - points(earned)).abs() < 1e-9);
        assert!(tests.iter().any(|test| test["output"].as_str().unwrap().contains("Most likely")));
    }

    #[test]
    fn points_that_are_not_final_say_so() {
        let mut record = sample::record("x");
        record.stages[0].checks.iter_mut().for_each(|check| check.verdict = Verdict::Pass);
        assert!(is_final(&record) && !summary(&record).contains("not final"));
        record.stages[0].checks[0].verdict = Verdict::Ours;
        assert!(!is_final(&record) && summary(&record).contains("no fault of the submission"));
    }

    #[test]
    fn long_texts_are_cut_between_characters() {
        assert_eq!((&*cut("éé", 1), &*cut("éé", 2)), ("é…", "éé"));
    }
}
