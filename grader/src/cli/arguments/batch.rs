//! The arguments of `grader batch`.

use std::path::PathBuf;

use clap::Args;

use super::confirm::Confirm;
use crate::cli::collecting::Collecting;
use crate::cli::limit::Limit;
use crate::grade::GradeError;

/// Grade a class: every folder and archive in DIR
///
/// Writes a record and a report for each submission, and the table of the class as CSV and HTML. A
/// submission that was graded before and has not changed is not graded again, so a run that was
/// interrupted or killed continues where it stopped.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader batch handins -o results
  grader batch handins -o results --stage 02 --jobs 4
  grader batch assignment_7_export -o results --roster roster.csv --policy late.toml

Exit codes: 0 all are graded (with any score), 2 usage or no submissions, 3 some could not be
graded, 130 interrupted")]
pub(crate) struct Batch {
    /// Folder of the submissions
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Folder of the results
    #[arg(short, long, value_name = "OUT")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) collecting: Collecting,
    #[command(flatten)]
    pub(crate) limit: Limit,
    /// Whether the program `reference` beside the grader confirms diagnoses
    ///
    /// It renders the named mistakes together, which shows wrong names and hidden mistakes. Points
    /// do not depend on it.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = Confirm::Auto)]
    pub(crate) confirm: Confirm,
    /// Number of submissions that are graded at once [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
    /// Folder of the stages [default: cases/stages here, else beside the binary]
    #[arg(long, value_name = "STAGES")]
    pub(crate) cases: Option<PathBuf>,
    /// Only this stage, such as 02 or 02_shadows; may be repeated
    #[arg(long, value_name = "STAGE")]
    pub(crate) stage: Vec<String>,
    /// File with the key of the results, which is made if there is none
    /// [default: grader/key in $XDG_STATE_HOME, else ~/.local/state/grader/key]
    ///
    /// Results are sealed with it, so that a planted or changed one is refused and graded again.
    /// Machines that share a folder of results need the same key.
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
}

impl Batch {
    /// Returns the file of the key.
    ///
    /// # Errors
    /// Returns [`GradeError::Usage`] if none is named and the user has no home folder.
    pub(crate) fn key_file(&self) -> Result<PathBuf, GradeError> {
        let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
        let state = || {
            let home = || Some(PathBuf::from(variable("HOME")?).join(".local/state"));
            Some(variable("XDG_STATE_HOME").map(PathBuf::from).or_else(home)?.join("grader/key"))
        };
        let none = "there is no place for the key of the results, because neither HOME nor \
            XDG_STATE_HOME is set; name a file with --key FILE";
        self.key.clone().or_else(state).ok_or_else(|| GradeError::Usage(none.to_owned()))
    }
}
