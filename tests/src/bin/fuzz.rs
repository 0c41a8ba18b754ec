//! Fuzzes every parser of foreign bytes for a given time.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser as _;
use rayon::prelude::*;
use tests::fuzz::{Parser, parsers, session};

/// Reads mutations of good files with every parser of foreign bytes, in processes with limits.
#[derive(clap::Parser)]
#[command(after_help = "\
Examples:
  cargo run --release -p tests --bin fuzz                        a minute, as the gate does
  cargo run --release -p tests --bin fuzz -- --seconds 3600 --seed 7
  cargo run --release -p tests --bin fuzz -- --only obj --input target/fuzz/obj-0

Exit codes: 0 every input was read or refused, 1 a parser failed at one, 2 usage")]
struct Arguments {
    /// Seconds for all parsers together
    #[arg(long, value_name = "N", default_value_t = 60.0)]
    seconds: f64,
    /// The seed of the mutations
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// One parser
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Reads this file and no mutations
    #[arg(long, value_name = "FILE", requires = "only")]
    input: Option<PathBuf>,
    /// Reads in this process, which gets limits, and writes its report here
    #[arg(long, value_name = "FOLDER", requires = "only", hide = true)]
    into: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match fuzz(&arguments) {
        Ok(failures) if failures.is_empty() => ExitCode::SUCCESS,
        Ok(failures) => {
            eprintln!("{}", failures.join("\n\n"));
            ExitCode::FAILURE
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

/// Returns the failures of the parsers.
fn fuzz(arguments: &Arguments) -> Result<Vec<String>, String> {
    let parsers = chosen(arguments.only.as_deref())?;
    let time = |n: usize| {
        Duration::try_from_secs_f64(arguments.seconds / n as f64).map_err(|why| why.to_string())
    };
    if let Some(input) = &arguments.input {
        println!("{:?}", session::read_one(&parsers[0], input)?);
        return Ok(vec![]);
    }
    if let Some(folder) = &arguments.into {
        session::read_for(&parsers[0], time(1)?, arguments.seed, folder);
        return Ok(vec![]);
    }
    let at_once = rayon::current_num_threads();
    let each = time(parsers.len().div_ceil(at_once))?;
    println!(
        "{:<14} {:>9} {:>9} {:>9} {:>11} {:>9}",
        "parser", "inputs", "accepted", "refused", "slowest", "peak"
    );
    let failures =
        parsers.par_iter().with_max_len(1).map(|parser| of_one(parser, each, arguments.seed));
    Ok(failures.collect::<Vec<_>>().into_iter().flatten().collect())
}

/// Prints a row on a parser, and returns its failure, if any.
fn of_one(parser: &Parser, time: Duration, seed: u64) -> Option<String> {
    match session::run(parser, time, seed) {
        Ok(session::Report { counts, slowest_s, peak_bytes }) => {
            println!(
                "{:<14} {:>9} {:>9} {:>9} {:>8.1} ms {:>5} MiB",
                parser.name,
                counts.n(),
                counts.n_accepted,
                counts.n_refused,
                1e3 * slowest_s,
                peak_bytes >> 20
            );
            None
        }
        Err(why) => {
            println!("{:<14} failed", parser.name);
            Some(why)
        }
    }
}

fn chosen(only: Option<&str>) -> Result<Vec<Parser>, String> {
    let all = parsers::all();
    let Some(only) = only else { return Ok(all.into()) };
    match all.iter().find(|parser| parser.name == only) {
        Some(parser) => Ok(vec![*parser]),
        None => {
            let names = all.map(|parser| parser.name).join(", ");
            Err(format!("there is no parser `{only}`; there are {names}"))
        }
    }
}
