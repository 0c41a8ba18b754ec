//! JUnit XML for CI systems. A wrong result is a failure, a crash or time-out is an error, and a
//! check that was not run is skipped.
//!
//! Every text goes through [`shown`], which leaves only characters that XML allows.

use std::time::Duration;

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{mistakes, words};
use crate::plain::shown;
use crate::record::{CheckRecord, FindingKind, Record, StageRecord, Verdict};

/// The reason why a record cannot be encoded as a JUnit document.
#[derive(Debug, thiserror::Error)]
#[error("the JUnit report cannot be encoded")]
pub struct JunitError(#[from] quick_junit::SerializeError);

/// Returns the record as a JUnit document. The build is a suite of its own.
///
/// # Errors
/// Returns the error of the encoder.
pub fn to_string(record: &Record) -> Result<String, JunitError> {
    let interrupted =
        if record.interrupted { " (interrupted: not everything was run)" } else { "" };
    let mut report =
        Report::new(format!("grade of {}{interrupted}", shown(&record.submission.path)));
    report.add_test_suite(build(record));
    report.add_test_suites(record.stages.iter().map(|stage| suite(record, stage)));
    Ok(report.to_string()?)
}

fn build(record: &Record) -> TestSuite {
    let status = match &record.build.finding {
        None => TestCaseStatus::success(),
        Some(finding) => bad(NonSuccessKind::Error, words::finding(finding.kind), &finding.message),
    };
    let mut suite = TestSuite::new("build");
    suite.add_test_case(TestCase::new("build", status));
    suite
}

fn suite(record: &Record, stage: &StageRecord) -> TestSuite {
    let mut suite = TestSuite::new(shown(&stage.id));
    suite.add_test_cases(stage.checks.iter().map(|check| case(record, &stage.id, check)));
    suite
}

fn case(record: &Record, stage: &str, check: &CheckRecord) -> TestCase {
    let mut case = TestCase::new(shown(&check.id), status(record, check));
    case.set_classname(shown(stage));
    // An invalid time (negative, not a number, longer than a duration can be) is left out.
    if let Ok(time) = Duration::try_from_secs_f64(check.time_s) {
        case.set_time(time);
    }
    if let Some(stderr) = check.finding.as_ref().and_then(|finding| finding.stderr.as_deref()) {
        case.set_system_err(shown(stderr));
    }
    if let (Verdict::Pass, Some(finding)) = (check.verdict, &check.finding) {
        case.set_system_out(format!(
            "{}: {}",
            words::finding(finding.kind),
            shown(&finding.message)
        ));
    }
    case
}

fn status(record: &Record, check: &CheckRecord) -> TestCaseStatus {
    let kind = check.finding.as_ref().map_or(FindingKind::Remark, |finding| finding.kind);
    let finding = check.finding.as_ref();
    let likely = finding.and_then(|finding| mistakes::says(record, finding.diagnosis.as_ref()?));
    let mut message = finding.map_or(String::new(), |finding| finding.message.clone());
    message.extend(likely.map(|(lead, says)| format!("; {} {says}", lead.to_lowercase())));
    let message = message.as_str();
    match (check.verdict, kind) {
        (Verdict::Pass, _) => TestCaseStatus::success(),
        (Verdict::NotRun, _) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(shown(message));
            status
        }
        (Verdict::Ours, _) => bad(NonSuccessKind::Error, words::finding(kind), message),
        (Verdict::Partial, _) => {
            let message =
                format!("{} points: {message}", words::share(check.earned, check.possible));
            bad(NonSuccessKind::Failure, words::finding(kind), &message)
        }
        (
            _,
            FindingKind::Wrong | FindingKind::Size | FindingKind::Missing | FindingKind::Unreadable,
        ) => bad(NonSuccessKind::Failure, words::finding(kind), message),
        _ => bad(NonSuccessKind::Error, words::finding(kind), message),
    }
}

fn bad(kind: NonSuccessKind, name: &str, message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(name).set_message(shown(message));
    status
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn holds_every_check_and_no_control_character() {
        let record = sample::record("some\u{1b}body");
        let xml = to_string(&record).unwrap();
        let n_checks = record.stages.iter().map(|stage| stage.checks.len()).sum::<usize>();
        assert_eq!(xml.matches("<testcase ").count(), n_checks + 1);
        assert!(xml.chars().all(|c| c == '\n' || !c.is_control()), "{xml:?}");
        assert!(xml.contains("; most likely the one is &lt;wrong&gt;"), "{xml}");
        for part in ["<failure", "<error", "<skipped"] {
            assert!(xml.contains(part), "no {part} in\n{xml}");
        }
    }
}
