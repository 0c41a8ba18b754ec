//! Judges the diagnosis: draws combinations of known mistakes, renders them, and prints how many
//! parts are named by number of mistakes, with and without unit checks.

use std::process::ExitCode;

use clap::Parser;
use rayon::prelude::*;
use reference::rules::misconceptions::Misconception;
use reference::trace::answers::answer;
use tests::diagnosis::{Desk, NUISANCES, Names, combinations, names, parts};
use tests::public_stages;

/// Names the mistakes of programs with several known mistakes, and of right programs whose pictures
/// are changed as a whole.
#[derive(Parser)]
struct Arguments {
    /// Combinations of each size
    #[arg(long, value_name = "N", default_value_t = 40)]
    runs: usize,
    /// Greatest number of mistakes in one program
    #[arg(long, value_name = "N", default_value_t = 5)]
    most: usize,
    /// Seed of the combinations
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Without unit checks
    #[arg(long)]
    pictures_only: bool,
    /// Render the named mistakes together, as `grader batch` does beside the reference
    #[arg(long)]
    confirm: bool,
    /// List the names of each run that lacks a part or has a wrong name
    #[arg(long)]
    verbose: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match Desk::open(&public_stages()) {
        Ok(desk) => {
            nuisances(&desk);
            (1..=arguments.most).for_each(|size| of_size(&desk, &arguments, size));
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

/// Prints the names that right pictures get after a change.
fn nuisances(desk: &Desk) {
    for nuisance in NUISANCES {
        let pictures: Vec<_> =
            desk.cases().map(|(_, answer)| nuisance.of(&answer.expected)).collect();
        let explanation = desk.explain(&pictures, |_, right| Some(right.answer.clone()));
        println!("{}: {:?}", nuisance.name, names(&explanation));
    }
}

/// Prints the line on all combinations of one size. Single mistakes are all tried.
fn of_size(desk: &Desk, arguments: &Arguments, size: usize) {
    let drawn = match size {
        1 => reference::rules::misconceptions::of(&reference::rules::Rules::LECTURE)
            .into_iter()
            .map(|one| vec![one])
            .collect(),
        _ => combinations(arguments.seed + size as u64, arguments.runs, size),
    };
    let counts: Vec<Names> =
        drawn.par_iter().map(|mistakes| of_one(desk, arguments, mistakes)).collect();
    let n_wrong = counts.iter().filter(|one| one.wrong > 0).count();
    let all = counts.into_iter().fold(Names::default(), Names::plus);
    println!("{size} of {}: {all}; {n_wrong} runs with a wrong name", drawn.len());
}

/// Diagnoses one combination.
fn of_one(desk: &Desk, arguments: &Arguments, mistakes: &[&'static Misconception]) -> Names {
    let rules = parts(mistakes);
    let pictures = desk.render(&rules);
    let explanation = desk.explain(&pictures, |check, _| {
        (!arguments.pictures_only).then(|| answer(&rules, &check.ask))
    });
    let explanation =
        if arguments.confirm { desk.confirm(&pictures, explanation) } else { explanation };
    let named = names(&explanation);
    let counts = Names::of(mistakes, &named);
    if arguments.verbose && (counts.found < counts.parts || counts.near + counts.wrong > 0) {
        let ids: Vec<&str> = mistakes.iter().map(|one| one.id).collect();
        println!("  {} of {}: {ids:?} named {named:?}", counts.found, counts.parts);
    }
    counts
}
