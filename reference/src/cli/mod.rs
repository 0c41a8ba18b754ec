//! The command line: what was typed, what it means, and how it ended.

mod args;
mod cost;
mod cost_args;
mod cost_page;
mod cost_store;
mod course;
mod effects;
mod expect;
mod explain;
mod find;
mod interrupt;
mod probe;
mod progress;
mod render;
mod schema;
mod shell;
mod stats;
mod survey;
mod values;
mod vary;

use std::process::ExitCode;

use anstream::ColorChoice;
use cases::files::WriteError;
use cases::problem::Problems;
use pages::say;

use args::{Args, Colour, Command};

/// Why a command ended early, and with it the exit code.
#[derive(Debug)]
enum Stop {
    /// Done, but something did not pass: 1.
    NotPassed(String),
    /// A scene or case that cannot be read: 2.
    Problems(Problems),
    /// What was typed makes no sense, or an input cannot be read: 2.
    Usage(String),
    /// The machine failed: 3.
    Machine(String),
    /// The user has interrupted: 130.
    Interrupted(String),
}

impl From<Problems> for Stop {
    fn from(problems: Problems) -> Self {
        Self::Problems(problems)
    }
}

impl From<WriteError> for Stop {
    fn from(why: WriteError) -> Self {
        if why.is_usage() { Self::Usage(why.to_string()) } else { Self::Machine(why.to_string()) }
    }
}

/// How much is said on the error stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Talk {
    /// Errors alone.
    Quiet,
    /// What was written.
    Normal,
    /// Also what was done on the way.
    Verbose,
}

/// Carries out the command line; returns the exit code, of those that `--help` lists.
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
        Err(stop) => report(stop),
    }
}

fn dispatch(command: &Command, talk: Talk) -> Result<(), Stop> {
    match command {
        Command::Render(args) => render::run(args, talk),
        Command::Effects(args) => effects::run(args),
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

fn report(stop: Stop) -> ExitCode {
    let (text, code) = match stop {
        Stop::NotPassed(text) => (text, 1),
        Stop::Problems(problems) => (problems.render(true), 2),
        Stop::Usage(text) => (format!("error: {text}"), 2),
        Stop::Machine(text) => (format!("error: {text}"), 3),
        Stop::Interrupted(text) => (text, 130),
    };
    say::err(&text);
    ExitCode::from(code)
}

/// Writes bytes to the output stream as they are; a reader that has gone away is no error.
fn print(bytes: &[u8]) -> Result<(), Stop> {
    say::raw(bytes).map_err(|why| unprintable(&why))
}

/// Prints text for people to the output stream; a reader that has gone away is no error.
fn print_text(text: &str) -> Result<(), Stop> {
    say::out(text).map_err(|why| unprintable(&why))
}

fn unprintable(why: &std::io::Error) -> Stop {
    Stop::Machine(format!("cannot write to the output stream: {why}"))
}

fn print_json<T: serde::Serialize>(value: &T) -> Result<(), Stop> {
    let text = serde_json::to_string_pretty(value).map_err(|why| Stop::Machine(why.to_string()))?;
    print(format!("{text}\n").as_bytes())
}
