//! The command line: arguments, commands and exit codes.

mod args;
mod cost;
mod cost_args;
mod cost_check;
mod cost_page;
mod cost_session;
mod cost_store;
mod course;
mod effects;
mod effects_args;
mod effects_measured;
mod expect;
mod explain;
mod find;
mod interrupt;
mod output;
mod probe;
mod progress;
mod render;
mod schema;
mod shell;
mod stats;
mod stop;
mod survey;
mod values;
mod vary;

use std::process::ExitCode;

use anstream::ColorChoice;
use pages::say;

use args::{Args, Colour, Command};
use output::Talk;
use stop::Stop;

/// Runs the command of the command line. Returns one of the exit codes that `--help` lists.
pub fn run() -> ExitCode {
    let args: Args = match pages::shell::arguments() {
        Ok(args) => args,
        Err(code) => return code,
    };
    match args.color {
        Colour::Auto => ColorChoice::Auto,
        Colour::Always => ColorChoice::Always,
        Colour::Never => ColorChoice::Never,
    }
    .write_global();
    let talk = match (args.quiet, args.verbose) {
        (true, _) => Talk::Quiet,
        (_, true) => Talk::Verbose,
        _ => Talk::Normal,
    };
    match dispatch(&args.command, talk) {
        Ok(()) => ExitCode::SUCCESS,
        Err(stop) => {
            let (code, text) = stop.code_and_text();
            say::err(&text);
            ExitCode::from(code)
        }
    }
}

fn dispatch(command: &Command, talk: Talk) -> Result<(), Stop> {
    match command {
        Command::Render(args) => render::run(args, talk),
        Command::Effects(args) => effects::run(args, talk),
        Command::Cost(args) => cost::run(args, talk),
        Command::Explain(args) => explain::run(args),
        Command::Probe(args) => probe::run(args),
        Command::Expect(args) => expect::run(args, talk),
        Command::Vary(args) => vary::run(args, talk),
        Command::Course(args) => course::run(args),
        Command::Schema(args) => schema::run(args),
        Command::Completions { shell } => shell::completions(*shell),
        Command::Man { what } => shell::man(what.as_deref()),
    }
}
