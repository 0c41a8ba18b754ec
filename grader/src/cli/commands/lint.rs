//! `grader lint`.

use std::path::Path;

use crate::blame::Blame;
use crate::cli::arguments::{Lint, stages};
use crate::cli::exit::{self, Done, Outcome};
use crate::cli::progress::Talk;
use crate::grade::GradeError;
use crate::lint;

pub(crate) fn run(arguments: &Lint, talk: &Talk) -> Outcome {
    let folder = stages(arguments.folder.as_deref())?;
    if !folder.is_dir() {
        return Err(GradeError::Usage(format!("{}: there is no such folder", folder.display())));
    }
    if !has_stage(&folder) {
        let help = "a stage is a folder such as 01_ray_casting with a stage.toml";
        return Err(GradeError::Usage(format!(
            "{}: there are no stages in it; {help}",
            folder.display()
        )));
    }
    let found = lint::lint(&folder);
    let summary = found.summary.iter().filter(|_| !talk.is_quiet);
    exit::print(
        &found.problems.iter().chain(summary).map(|line| format!("{line}\n")).collect::<String>(),
    )?;
    Ok(if found.blame == Blame::Machine { Done::Ours } else { Done::of(found.problems.is_empty()) })
}

/// Returns whether `folder` holds a stage. The answer is `true` for a folder that cannot be listed,
/// which the reader of the stages then reports.
fn has_stage(folder: &Path) -> bool {
    std::fs::read_dir(folder)
        .map_or(true, |entries| entries.flatten().any(|it| it.path().join("stage.toml").is_file()))
}
