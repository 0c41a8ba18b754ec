//! `grader completions`, `grader man` and `grader schema`.

use crate::files;
use crate::grade::GradeError;
use crate::record;
use cases::files::WriteError;
use clap::CommandFactory;
use pages::shell;

use crate::cli::arguments::{Arguments, Completions, Man};
use crate::cli::exit::{self, Done, Outcome};

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
            for (name, page) in &pages {
                let path = folder.join(name);
                files::write(&path, page).map_err(|source| WriteError::untouched(&path, source))?;
            }
        }
    }
    Ok(Done::Passed)
}
