//! `grader images`.

use std::io::ErrorKind;

use crate::cli::arguments::Images;
use crate::cli::commands::grade::say_selected;
use crate::cli::commands::publish;
use crate::cli::exit::Outcome;
use crate::cli::progress::Talk;
use crate::grade::{Bench, GradeError, images};

pub(crate) fn run(arguments: &Images, talk: &Talk) -> Outcome {
    let folder = &arguments.folder;
    match std::fs::metadata(folder) {
        Ok(found) if found.is_dir() => {}
        Ok(_) => {
            return Err(GradeError::Usage(format!("{}: it is not a folder", folder.display())));
        }
        Err(why) if why.kind() == ErrorKind::NotFound => {
            return Err(GradeError::Usage(format!(
                "{}: there is no such folder",
                folder.display()
            )));
        }
        Err(why) => {
            return Err(GradeError::Usage(format!(
                "{}: it cannot be read: {why}",
                folder.display()
            )));
        }
    }
    publish::check(&arguments.reports)?;
    let mut bench = Bench::open(&arguments.selection.stages()?)?;
    bench.tracer = arguments.selection.confirm.tracer()?;
    let options = arguments.selection.options(folder);
    say_selected(&bench, &options, talk)?;
    let graded = images(&bench, folder, &options)?;
    publish::publish(&graded, &arguments.reports, talk)
}
