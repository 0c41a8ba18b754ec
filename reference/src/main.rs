//! The reference tracer's program; `reference --help` says what it does.

use std::process::ExitCode;

fn main() -> ExitCode {
    reference::cli::run()
}
