//! Writes the reports that the command line names, and prints the report for people.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use cases::files::{self, Place, is_stdout};
use pages::lines;

use crate::cli::arguments::Reports;
use crate::cli::exit::{self, Done, Outcome};
use crate::cli::progress::Talk;
use crate::grade::GradeError;
use crate::graded::Graded;
use crate::record::{FindingKind, Record, Verdict};
use crate::report::{gradescope, html, junit, prairielearn, terminal};

/// Checks that the reports can be written. This comes before any program runs, since grading takes
/// minutes.
///
/// # Errors
/// Fails if a name cannot be written, if two reports would be the same file, or if `--open` names a
/// stream.
pub(crate) fn check(reports: &Reports) -> Result<(), GradeError> {
    let Reports { html, open, .. } = reports;
    let named: Vec<&PathBuf> = files_of(reports).into_iter().flatten().collect();
    named.iter().try_for_each(|path| files::check(path))?;
    let places: Vec<Option<PathBuf>> = named.iter().map(|path| place(path)).collect();
    let is_twice =
        |(n, _): (usize, &&PathBuf)| places[n].is_some() && places[..n].contains(&places[n]);
    if named.iter().filter(|path| is_stdout(path)).count() > 1 {
        let text = "only one report can go to standard output";
        return Err(GradeError::Usage(text.to_owned()));
    }
    if let Some((_, path)) = named.iter().enumerate().find(|named| is_twice(*named)) {
        let text = format!("{}: two reports cannot be the same file", path.display());
        return Err(GradeError::Usage(text));
    }
    if *open && html.as_deref().is_some_and(files::is_stream) {
        return Err(GradeError::Usage("--open shows a file: name one with --html".to_owned()));
    }
    Ok(())
}

/// Returns the files of all reports.
fn files_of(reports: &Reports) -> [&Option<PathBuf>; 5] {
    let Reports { json, html, junit, gradescope, prairielearn, open: _ } = reports;
    [json, html, junit, gradescope, prairielearn]
}

/// Returns the same path for all names of a regular file, such as `a` and `./a`; `None` for
/// anything else.
fn place(name: &Path) -> Option<PathBuf> {
    let (Place::File(path) | Place::Free(path)) = Place::of(name).ok()? else { return None };
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    Some(folder.canonicalize().ok()?.join(path.file_name()?))
}

/// Writes every report, and prints the report for people unless another one goes to standard
/// output.
///
/// # Errors
/// Fails if a report cannot be written. The error is that of the first one; the others are written.
pub(crate) fn publish(graded: &Graded, reports: &Reports, talk: &Talk) -> Outcome {
    let record = &graded.record;
    let Reports { json, html, junit, gradescope, prairielearn, open: is_shown } = reports;
    let mut written: Result<(), GradeError> = Ok(());
    let write =
        |path: &Path, text: &str| files::write(path, text.as_bytes()).map_err(GradeError::from);
    if let Some(path) = json {
        written = written.and(write(path, &record.to_json()));
    }
    if let Some(path) = junit {
        let text = junit::to_string(record).map_err(GradeError::from);
        written = written.and(text.and_then(|text| write(path, &text)));
    }
    if let Some(path) = gradescope {
        written = written.and(write(path, &gradescope::to_string(record)));
    }
    if let Some(path) = prairielearn {
        written = written.and(write(path, &prairielearn::to_string(record)));
    }
    if let Some(path) = html {
        written = written.and(write(path, &html::render(graded)));
    }
    let is_taken = files_of(reports).into_iter().flatten().any(|path| is_stdout(path));
    if !is_taken && !talk.is_quiet {
        let look = terminal::Look { is_verbose: talk.is_verbose, columns: lines::columns() };
        written = written.and(exit::print(&terminal::render(record, look)));
    }
    written?;
    if let (Some(path), true) = (html, is_shown) {
        open(path)?;
    }
    Ok(done(record))
}

fn open(path: &Path) -> Result<(), GradeError> {
    let program = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let mut command = Command::new(program);
    let started =
        command.arg(path).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    started.map(drop).map_err(|source| GradeError::Open { program, source })
}

/// Returns the result of the command.
///
/// An interrupt, and a hand-in that is no submission, come first, since hardly anything was run
/// then. A fault of the grader or the machine comes next, since no points are final then.
fn done(record: &Record) -> Done {
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    let verdicts: Vec<Verdict> =
        checks.map(|check| check.verdict).chain([record.build.verdict]).collect();
    let is_no_submission =
        record.build.finding.as_ref().is_some_and(|it| it.kind == FindingKind::Submission);
    if record.interrupted {
        Done::Interrupted
    } else if is_no_submission {
        Done::NoSubmission
    } else if verdicts.contains(&Verdict::Ours) {
        Done::Ours
    } else {
        Done::of(verdicts.iter().all(|verdict| *verdict == Verdict::Pass))
    }
}
