//! `grader grade`.

use grader::grade::{Bench, Options, grade};

use crate::arguments::Grade;
use crate::commands::publish;
use crate::exit::Outcome;
use crate::progress::{Bar, Talk};

pub(crate) fn run(arguments: &Grade, talk: &Talk) -> Outcome {
    publish::check(&arguments.reports)?;
    let options = arguments.selection.options(&arguments.submission);
    let jobs = arguments.jobs.map_or(options.jobs, usize::from);
    let graded = {
        let bar = Bar::new(talk);
        let allowance = arguments.limit.allowance();
        let bench = Bench { allowance, ..Bench::open(&arguments.selection.stages()?)? };
        grade(&bench, &Options { jobs, ..options }, &bar)?
    };
    publish::publish(&graded, &arguments.reports, talk)
}
