//! `grader explain`.

use crate::cli::arguments::{Explain, stages};
use crate::cli::exit::{self, Done, Outcome};
use crate::cli::progress::{Bar, Talk};
use crate::grade::{Bench, explain};
use crate::sandbox;

pub(crate) fn run(arguments: &Explain, talk: &Talk) -> Outcome {
    sandbox::clear_leftovers();
    let bench = Bench::open(&stages(arguments.cases.as_deref())?)?;
    let pixel = [arguments.x, arguments.y];
    let explained = {
        let bar = Bar::new(talk);
        explain(&bench, &arguments.submission, &arguments.case, pixel, &bar)?
    };
    match &explained {
        Ok(tree) => exit::print(tree.trim_end())?,
        Err(why) => pages::say::err(why.trim_end()),
    }
    Ok(Done::of(explained.is_ok()))
}
