//! `grader images`.

use grader::grade::{Bench, GradeError, images};

use crate::arguments::Images;
use crate::commands::grade::say_selected;
use crate::commands::publish;
use crate::exit::Outcome;
use crate::progress::Talk;

pub(crate) fn run(arguments: &Images, talk: &Talk) -> Outcome {
    let folder = &arguments.folder;
    if !folder.is_dir() {
        return Err(GradeError::Input(format!("{}: there is no such folder", folder.display())));
    }
    let bench = Bench::open(&arguments.selection.stages()?)?;
    let options = arguments.selection.options(folder);
    say_selected(&bench, &options, talk)?;
    let graded = images(&bench, folder, &options)?;
    publish::publish(&graded, &arguments.reports, talk)
}
