//! `grader grade`.

use pages::say;

use crate::cli::arguments::Grade;
use crate::cli::commands::publish;
use crate::cli::exit::Outcome;
use crate::cli::progress::{Bar, Talk};
use crate::exercise::Allowance;
use crate::grade::{Bench, GradeError, Options, grade};
use crate::sandbox::{self, Level};

/// Prints what the options select, before anything is run.
pub(crate) fn say_selected(
    bench: &Bench,
    options: &Options,
    talk: &Talk,
) -> Result<(), GradeError> {
    let selected = bench.selected(&options.stages, &options.cases)?;
    selected.iter().filter(|_| !talk.is_quiet).for_each(|line| say::err(line));
    Ok(())
}

pub(crate) fn run(arguments: &Grade, talk: &Talk) -> Outcome {
    publish::check(&arguments.reports)?;
    sandbox::clear_leftovers();
    let options = arguments.selection.options(&arguments.submission);
    let jobs = arguments.jobs.map_or(options.jobs, usize::from);
    let graded = {
        let allowance = arguments.limit.allowance();
        say_lowered(&allowance, talk);
        let mut bench = Bench { allowance, ..Bench::open(&arguments.selection.stages()?)? };
        bench.workshop.layers = arguments.limit.layers(Level::Basic)?;
        bench.tracer = arguments.selection.confirm.tracer()?;
        say_selected(&bench, &options, talk)?;
        let bar = Bar::new(talk);
        grade(&bench, &Options { jobs, ..options }, &bar)?
    };
    publish::publish(&graded, &arguments.reports, talk)
}

/// Prints which limits of programs this process lowers, if the output is to be verbose.
pub(crate) fn say_lowered(allowance: &Allowance, talk: &Talk) {
    if talk.is_verbose {
        allowance
            .picture
            .lowered()
            .iter()
            .for_each(|granted| say::err(&format!("programs get {granted}")));
    }
}
