//! `grader completions`, `grader man` and `grader schema`.

use cases::files::{self, WriteError};
use clap::CommandFactory;
use pages::shell;

use crate::cli::arguments::{Arguments, Completions, Man};
use crate::cli::exit::{self, Done, Outcome};
use crate::grade::GradeError;
use crate::record;

pub(crate) fn schema() -> Outcome {
    exit::print_raw(format!("{:#}\n", record::schema()).as_bytes())?;
    Ok(Done::Passed)
}

pub(crate) fn completions(arguments: &Completions) -> Outcome {
    exit::print_raw(&shell::completions(Arguments::command(), arguments.shell))?;
    Ok(Done::Passed)
}

pub(crate) fn man(arguments: &Man) -> Outcome {
    match shell::man(Arguments::command(), arguments.what.as_deref()).map_err(GradeError::Usage)? {
        shell::Man::Page(page) => exit::print_raw(&page)?,
        shell::Man::Folder(folder, pages) => {
            std::fs::create_dir_all(&folder)
                .map_err(|source| WriteError::untouched(&folder, source))?;
            for (name, page) in &pages {
                files::write(&folder.join(name), page)?;
            }
        }
    }
    Ok(Done::Passed)
}
