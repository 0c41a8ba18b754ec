//! Measures what grading costs a machine, and writes `docs/load.md`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use tests::load::{Load, batch, page, script};
use tests::performance::report::Machine;

/// Measures what grading costs a machine, beside the scripts that courses use
#[derive(Parser)]
struct Arguments {
    /// The grader, built with --release
    #[arg(long, value_name = "FILE", default_value = "target/release/grader")]
    grader: PathBuf,
    /// Number of submissions whose processor time is measured
    #[arg(long, value_name = "N", default_value_t = 20)]
    submissions: u16,
    /// Number of submissions that the scripts grade
    #[arg(long, value_name = "N", default_value_t = 3)]
    scripted: u16,
    /// Sizes of the classes whose memory is measured
    #[arg(long, value_name = "N", value_delimiter = ',', default_values_t = [10, 100, 500])]
    classes: Vec<u16>,
    /// Write the page here [default: the page goes to the output]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

fn main() -> ExitCode {
    match act(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

fn act(arguments: &Arguments) -> Result<(), String> {
    let grader = arguments.grader.canonicalize();
    let grader = grader.map_err(|why| {
        format!("{}: {why}: cargo build --release -p grader", arguments.grader.display())
    })?;
    let scenes = script::Scenes::write()?;
    // The first batch compiles the crates that all submissions share.
    batch::of_solutions(&grader, 1)?;
    let n_graded = usize::from(arguments.submissions);
    let graded = batch::of_solutions(&grader, n_graded)?;
    let n_scripted = usize::from(arguments.scripted);
    let shared = tempfile::tempdir().map_err(|why| why.to_string())?;
    let fresh = script::measure(&scenes, n_scripted, None)?;
    let warm = script::measure(&scenes, n_scripted, Some(shared.path()))?;
    let memory = arguments.classes.iter().map(|n| usize::from(*n));
    let memory = memory.map(|n| Ok((n, batch::memory(&grader, n)?)));
    let machine = Machine::this();
    let load = Load {
        machine: format!("{}, {} threads", machine.processor, machine.n_threads),
        n_graded,
        n_cases: scenes.len(),
        graded,
        fresh,
        warm,
        memory: memory.collect::<Result<_, String>>()?,
    };
    let text = page::page(&load);
    match &arguments.out {
        Some(path) => cases::files::write(path, text.as_bytes()).map_err(|why| why.to_string()),
        None => {
            print!("{text}");
            Ok(())
        }
    }
}
