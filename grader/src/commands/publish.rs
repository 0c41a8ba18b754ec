//! Writes the reports that were asked for, and prints the one for people.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use grader::files;
use grader::grade::{GradeError, Graded};
use grader::record::{Record, Verdict};
use grader::report::{html, junit, terminal};

use crate::arguments::Reports;
use crate::exit::{Done, Outcome};
use crate::progress::Talk;

pub(crate) fn publish(graded: &Graded, reports: &Reports, talk: &Talk) -> Outcome {
    let record = &graded.record;
    let is_stdout_taken = reports.json.as_deref().is_some_and(is_stdout);
    if let Some(path) = &reports.json {
        let text = serde_json::to_string_pretty(record).map_err(|why| GradeError::Machine(why.to_string()))? + "\n";
        written(path, if is_stdout(path) { print(&text) } else { files::write(path, text.as_bytes()) })?;
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
        let text = terminal::render(record, talk.is_verbose);
        let printed = write!(anstream::stdout(), "{text}");
        written(Path::new("standard output"), printed)?;
    }
    Ok(done(record))
}

fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

fn print(text: &str) -> std::io::Result<()> {
    std::io::stdout().write_all(text.as_bytes())
}

/// A reader that had enough (`grader … | head`) is no fault.
fn written(path: &Path, outcome: std::io::Result<()>) -> Result<(), GradeError> {
    match outcome {
        Err(why) if why.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(GradeError::Input(format!("cannot write {}: {why}", path.display())))
        }
        _ => Ok(()),
    }
}

fn open(path: &Path) -> Result<(), GradeError> {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut command = Command::new(opener);
    let started = command.arg(path).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    started.map(drop).map_err(|why| GradeError::Machine(format!("cannot run {opener} to show the page: {why}")))
}

/// How the command ends: a fault of the grader or the machine comes first, since no points are
/// final then.
fn done(record: &Record) -> Done {
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    let verdicts: Vec<Verdict> = checks.map(|check| check.verdict).chain([record.build.verdict]).collect();
    if verdicts.contains(&Verdict::Ours) {
        Done::Ours
    } else {
        Done::of(verdicts.iter().all(|verdict| *verdict == Verdict::Pass))
    }
}
