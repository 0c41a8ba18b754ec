//! Judges the judge: grades all variants of the solution, compares with other judges on the same
//! pictures, and writes `docs/judging.md`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use tests::bars::{self, Naming, VerdictCounts};
use tests::lab::{self, Lab, Trial};
use tests::{page, peers, variants, workspace};

/// Grades the variants of tests/mutants, and lists the correct ones that lost points and the wrong
/// ones that did not.
#[derive(Parser)]
struct Arguments {
    /// Only variants with this in their names
    only: Option<String>,
    /// Write the page here, with the verdicts of other judges (installed below target/peers)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Only every N-th of them, by name; the tests take every third
    #[arg(long, value_name = "N", default_value_t = 1)]
    every: usize,
    /// Programs that are built and graded at once [default: as many as there are cores]
    #[arg(long, short, value_name = "N")]
    jobs: Option<usize>,
    /// List the checks that each variant lost
    #[arg(long)]
    verbose: bool,
}

fn main() -> ExitCode {
    match judge(&Arguments::parse()) {
        Ok(faults) if faults.is_empty() => ExitCode::SUCCESS,
        Ok(faults) => {
            println!("{}", faults.join("\n"));
            ExitCode::FAILURE
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

/// Returns the faults that keep the grader from its bars.
fn judge(arguments: &Arguments) -> Result<Vec<String>, String> {
    let mut variants = variants::all()?;
    if let Some(only) = &arguments.only {
        variants.retain(|variant| variant.name.contains(only));
    }
    let variants: Vec<_> = variants.into_iter().step_by(arguments.every.max(1)).collect();
    let folder = workspace().join("target/peers");
    let lab = Lab::open(arguments.out.as_ref().map(|_| folder.join("pictures")))?;
    let bar = ProgressBar::new(variants.len() as u64);
    bar.set_style(
        ProgressStyle::with_template("{pos}/{len} {wide_bar} {eta} {msg}")
            .map_err(|why| why.to_string())?,
    );
    let trials = lab.try_all(&variants, arguments.jobs.unwrap_or_else(lab::cores), &|variant| {
        bar.set_message(variant.name.clone());
        bar.inc(1);
    });
    bar.finish_and_clear();
    let trials = trials.map_err(|faults| faults.join("\n"))?;
    if arguments.verbose {
        trials.iter().for_each(say);
    }
    let tally = VerdictCounts::of_this_grader(&trials);
    let naming = Naming::of(&trials);
    println!(
        "{} correct programs, {} failed; {} bugs, {} passed; {} of {} caught first in their own \
         stage; {} of {} named as their mistake",
        tally.n_right,
        tally.false_fails.len(),
        tally.n_wrong,
        tally.misses.len(),
        tally.n_in_right_stage(),
        tally.n_caught(),
        naming.n_named(),
        naming.n_known,
    );
    if let Some(out) = &arguments.out {
        let tools = peers::run_tools(&folder, &trials)?;
        let text = page::page(&trials, &tools);
        cases::files::write(out, text.as_bytes()).map_err(|why| why.to_string())?;
    }
    Ok([bars::faults(&trials), naming.faults()].concat())
}

fn say(trial: &Trial) {
    let lost: Vec<&str> = trial.lost().map(|check| check.id.as_str()).collect();
    let n_changed: usize = trial.shown.iter().map(|shown| shown.n_changed).sum();
    let named = trial.named_first().join(" or ");
    println!(
        "{}: {n_changed} pixels changed; named {named}; lost {}",
        trial.variant.name,
        lost.join(" ")
    );
}
