//! `grader batch`.

use cases::files::is_usage;
use grader::batch::{self, BatchError, OnBench, Options, Shown, Summary};
use grader::grade::{Bench, GradeError, Options as One};

use crate::arguments::{Batch, stages};
use crate::exit::{Done, Outcome};
use crate::progress::Talk;

pub(crate) fn run(arguments: &Batch, talk: &Talk) -> Outcome {
    let allowance = arguments.limit.allowance();
    let bench = Bench { allowance, ..Bench::open(&stages(arguments.cases.as_deref())?)? };
    // Done ahead so that the first wait is explained. Where it fails, the submissions that need the crates say so.
    let _ = bench.workshop.sdk(&|what| {
        if !talk.is_quiet {
            eprintln!("{what}");
        }
    });
    let grader = OnBench::new(&bench, &arguments.stage)?;
    let jobs = arguments.jobs.map_or_else(|| One::new(&arguments.folder).jobs, usize::from);
    let options = Options { folder: arguments.folder.clone(), out: arguments.out.clone(), jobs };
    let summary = batch::run(&grader, &options, &Shown::new(talk.is_quiet)).map_err(|why| match &why {
        BatchError::Folder { .. } | BatchError::Empty(_) => GradeError::Input(why.to_string()),
        BatchError::Out { why: cause, .. } if is_usage(cause) => GradeError::Input(why.to_string()),
        BatchError::Out { .. } => GradeError::Machine(why.to_string()),
    })?;
    if !talk.is_quiet {
        say(&summary, &options);
    }
    Ok(if summary.failed.is_empty() { Done::Passed } else { Done::Ours })
}

fn say(summary: &Summary, options: &Options) {
    for aside in &summary.left_aside {
        eprintln!("left aside: {} ({})", aside.name, aside.why);
    }
    let Summary { n_done, n_graded, n_left, .. } = summary;
    println!("{n_done} submissions have a record, {n_graded} of them graded in this run");
    if *n_left > 0 {
        println!("{n_left} are left, so there is no table yet: run the same command again to go on");
    } else {
        println!("table: {}", options.out.join("class.html").display());
    }
    if !summary.failed.is_empty() {
        println!("{} could not be graded, for no fault of the student's; run again:", summary.failed.len());
        summary.failed.iter().for_each(|(name, why)| println!("  {name}: {why}"));
    }
}
