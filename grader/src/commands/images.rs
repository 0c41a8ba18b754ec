//! `grader images`.

use grader::grade::{Bench, GradeError, images};

use crate::arguments::Images;
use crate::commands::publish;
use crate::exit::Outcome;
use crate::progress::Talk;

pub(crate) fn run(arguments: &Images, talk: &Talk) -> Outcome {
    let folder = &arguments.folder;
    if !folder.is_dir() {
        return Err(GradeError::Input(format!("{}: there is no such folder", folder.display())));
    }
    let bench = Bench::open(&arguments.selection.stages()?)?;
    let graded = images(&bench, folder, &arguments.selection.options(folder))?;
    publish::publish(&graded, &arguments.reports, talk)
}
