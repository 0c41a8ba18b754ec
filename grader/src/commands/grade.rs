//! `grader grade`.

use grader::grade::{Bench, Options, grade};

use grader::sandbox;

use crate::arguments::Grade;
use crate::commands::publish;
use crate::exit::Outcome;
use crate::progress::{Bar, Talk};

pub(crate) fn run(arguments: &Grade, talk: &Talk) -> Outcome {
    sandbox::clear_leftovers();
    let options = arguments.selection.options(&arguments.submission);
    let jobs = arguments.jobs.map_or(options.jobs, usize::from);
    let graded = {
        let bar = Bar::new(talk);
        let allowance = arguments.limit.allowance();
        if talk.is_verbose {
            allowance.picture.lowered().iter().for_each(|granted| eprintln!("programs get {granted}"));
        }
        let bench = Bench { allowance, ..Bench::open(&arguments.selection.stages()?)? };
        grade(&bench, &Options { jobs, ..options }, &bar)?
    };
    publish::publish(&graded, &arguments.reports, talk)
}
