//! `grader batch`.

use pages::{lines, say};

use crate::batch::{self, Collect, Key, OnBench, Options, Shown, Summary};
use crate::cli::arguments::{Batch, stages};
use crate::cli::commands::grade::say_lowered;
use crate::cli::exit::{self, Done, Outcome};
use crate::cli::progress::Talk;
use crate::grade::{Bench, Options as One};
use crate::sandbox::{self, Layers, Level};

pub(crate) fn run(arguments: &Batch, talk: &Talk) -> Outcome {
    let collect = arguments.collecting.collect()?;
    say_unused(collect.as_ref(), talk);
    sandbox::clear_leftovers();
    let allowance = arguments.limit.allowance();
    say_lowered(&allowance, talk);
    let mut bench = Bench { allowance, ..Bench::open(&stages(arguments.cases.as_deref())?)? };
    bench.workshop.layers = arguments.limit.layers(Level::Full)?;
    bench.tracer = arguments.confirm.tracer()?;
    // The crates are compiled ahead, so that the first wait is explained. If that fails, the
    // submissions that need the crates report it.
    let _ = bench.workshop.sdk(&|what| {
        if !talk.is_quiet {
            say::err(what);
        }
    });
    let grader = OnBench::new(&bench, &arguments.stage)?;
    let jobs = arguments.jobs.map_or_else(|| One::new(&arguments.folder).jobs, usize::from);
    let key = Key::open(&arguments.key_file()?)?;
    let (folder, out) = (arguments.folder.clone(), arguments.out.clone());
    let options = Options { folder, out, jobs, key, collect };
    let summary = batch::run(&grader, &options, &Shown::new(talk.is_quiet))?;
    if !talk.is_quiet {
        for aside in &summary.left_aside {
            say::err(&format!("left aside: {} ({})", aside.name, aside.why));
        }
        exit::print(&closing(&summary, &options, bench.workshop.layers))?;
    }
    Ok(if summary.failed.is_empty() { Done::Passed } else { Done::Ours })
}

/// Names the columns of the roster that are not used, one of which may be misspelt.
fn say_unused(collect: Option<&Collect>, talk: &Talk) {
    let unused = collect.map_or(&[][..], |collect| &collect.roster.unused);
    if !unused.is_empty() && !talk.is_quiet {
        say::err(&format!("not used of the roster: {}", unused.join(", ")));
    }
}

/// Returns the last lines: how many records there are, where the table is, what is left to do.
fn closing(summary: &Summary, options: &Options, layers: Layers) -> String {
    let Summary { n_done, n_graded, n_left, failed, .. } = summary;
    let have = if *n_done == 1 { "has" } else { "have" };
    let submissions = lines::count(*n_done, "submission");
    let mut text =
        format!("{submissions} {have} a record, {n_graded} of them graded in this run\n");
    if *n_left > 0 {
        text += &format!(
            "{n_left} are left, so there is no table yet: run the same command again to continue\n"
        );
    } else {
        text += &format!("table: {}\n", options.out.join("class.html").display());
    }
    if summary.n_alike > 0 {
        let pairs = lines::count(summary.n_alike, "pair");
        text += &format!(
            "{pairs} of submissions have nearly equal sources: {}\n",
            options.out.join("alike.csv").display()
        );
    }
    if summary.n_decisions > 0 {
        let decisions = lines::count(summary.n_decisions, "question");
        let path = options.out.join("decisions.csv");
        text += &format!("{decisions} for you to decide: {}\n", path.display());
    }
    text += &format!("protection: {layers}\n");
    if !failed.is_empty() {
        text += &format!(
            "{} could not be graded, for no fault of the student's; run again:\n",
            failed.len()
        );
        text.extend(failed.iter().map(|(name, why)| format!("  {name}: {why}\n")));
    }
    text
}
