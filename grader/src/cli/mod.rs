//! The command line: arguments, commands and exit codes. Each command is a module of `commands`.

mod arguments;
mod collecting;
mod commands;
mod exit;
mod gradebook;
mod limit;
mod progress;

use std::process::ExitCode;

use pages::shell;

use crate::grade::GradeError;
use crate::sandbox;
use crate::workers::guarded;
use arguments::{Arguments, Command};

/// Runs the command of the command line. Returns one of the exit codes that `--help` lists.
pub fn run() -> ExitCode {
    // While this process is small. If it fails, the first start of a program reports the reason.
    let _ = sandbox::prepare();
    let arguments: Arguments = match shell::arguments() {
        Ok(arguments) => arguments,
        Err(code) => return code,
    };
    arguments.color.write_global();
    sandbox::catch_signals();
    let outcome = guarded(|| dispatch(&arguments));
    exit::code(outcome.unwrap_or_else(|panicked| Err(GradeError::from(panicked))))
}

fn dispatch(arguments: &Arguments) -> exit::Outcome {
    let talk = arguments.talk();
    match &arguments.command {
        Command::Grade(options) => commands::grade::run(options, &talk),
        Command::Images(options) => commands::images::run(options, &talk),
        Command::Batch(options) => commands::batch::run(options, &talk),
        Command::Gradebook(options) => commands::gradebook::run(options, &talk),
        Command::Compare(options) => commands::compare::run(options),
        Command::Explain(options) => commands::explain::run(options, &talk),
        Command::Lint(options) => commands::lint::run(options, &talk),
        Command::Doctor(options) => commands::doctor::run(options),
        Command::Schema(_) => commands::shell::schema(),
        Command::Completions(options) => commands::shell::completions(options),
        Command::Man(options) => commands::shell::man(options),
    }
}
