//! Writes the reports that were asked for, and prints the one for people.

use std::path::Path;
use std::process::{Command, Stdio};

use grader::files;
use grader::grade::{GradeError, Graded};
use grader::record::{CheckRecord, FindingKind, Record, Verdict};
use grader::report::{html, junit, terminal};
use pages::lines;

use crate::arguments::Reports;
use crate::exit::{self, Done, Outcome};
use crate::progress::Talk;

pub(crate) fn publish(graded: &Graded, reports: &Reports, talk: &Talk) -> Outcome {
    let record = &graded.record;
    let is_stdout_taken = reports.json.as_deref().is_some_and(is_stdout);
    if let Some(path) = &reports.json {
        let text = record.to_json();
        if is_stdout(path) {
            exit::print_raw(text.as_bytes())?;
        } else {
            written(path, files::write(path, text.as_bytes()))?;
        }
    }
    if let Some(path) = &reports.junit {
        let text = junit::to_string(record).map_err(GradeError::Machine)?;
        written(path, files::write(path, text.as_bytes()))?;
    }
    if let Some(path) = &reports.html {
        written(path, html::write(path, graded))?;
        if reports.open {
            open(path)?;
        }
    }
    if !is_stdout_taken && !talk.is_quiet {
        let look = terminal::Look { is_verbose: talk.is_verbose, columns: lines::columns() };
        exit::print(&terminal::render(record, look))?;
    }
    Ok(done(record))
}

fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

fn written(path: &Path, outcome: std::io::Result<()>) -> Result<(), GradeError> {
    outcome.map_err(|why| GradeError::Input(format!("cannot write {}: {why}", path.display())))
}

fn open(path: &Path) -> Result<(), GradeError> {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut command = Command::new(opener);
    let started = command.arg(path).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    started.map(drop).map_err(|why| GradeError::Machine(format!("cannot run {opener} to show the page: {why}")))
}

/// Everything passed, or something did not; where only our own faults are in the way, that. An interrupt and
/// what is no submission come first, since then hardly anything was run.
fn done(record: &Record) -> Done {
    let verdicts = || record.stages.iter().flat_map(|stage| &stage.checks).map(|check: &CheckRecord| check.verdict);
    let is_bad = |verdict| matches!(verdict, Verdict::Partial | Verdict::Fail | Verdict::NotRun);
    let is_no_submission = record.build.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Submission);
    if record.interrupted {
        Done::Interrupted
    } else if is_no_submission {
        Done::NoSubmission
    } else if record.build.verdict != Verdict::Pass || verdicts().any(is_bad) {
        Done::NotPassed
    } else if verdicts().any(|verdict| verdict == Verdict::Ours) {
        Done::Ours
    } else {
        Done::Passed
    }
}
