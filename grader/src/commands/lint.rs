//! `grader lint`.

use grader::grade::GradeError;
use grader::lint;

use crate::arguments::{Lint, stages};
use crate::exit::{Done, Outcome};
use crate::progress::Talk;

pub(crate) fn run(arguments: &Lint, talk: &Talk) -> Outcome {
    let folder = stages(arguments.folder.as_deref())?;
    if !folder.is_dir() {
        return Err(GradeError::Input(format!("{}: there is no such folder", folder.display())));
    }
    let found = lint::lint(&folder);
    found.problems.iter().for_each(|problem| anstream::println!("{problem}"));
    if !talk.is_quiet {
        found.summary.iter().for_each(|line| anstream::println!("{line}"));
    }
    Ok(Done::of(found.problems.is_empty()))
}
