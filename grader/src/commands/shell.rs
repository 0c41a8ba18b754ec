//! `grader completions` and `grader man`: made from the command line itself.

use clap::CommandFactory;
use grader::files;
use grader::grade::GradeError;

use crate::arguments::{Arguments, Completions, Man};
use crate::exit::{Done, Outcome};

pub(crate) fn completions(arguments: &Completions) -> Outcome {
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "grader", &mut std::io::stdout());
    Ok(Done::Passed)
}

pub(crate) fn man(arguments: &Man) -> Outcome {
    let unwritable = |why| GradeError::Input(format!("cannot write to {}: {why}", arguments.folder.display()));
    let mut all = Arguments::command();
    all.build();
    for command in std::iter::once(&all).chain(all.get_subcommands()) {
        let name = command.get_display_name().unwrap_or(command.get_name()).replace(' ', "-");
        let mut page = vec![];
        clap_mangen::Man::new(command.clone()).render(&mut page).map_err(unwritable)?;
        files::write(&arguments.folder.join(format!("{name}.1")), &page).map_err(unwritable)?;
    }
    Ok(Done::Passed)
}
