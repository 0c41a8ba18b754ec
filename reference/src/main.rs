//! The program `reference`; `reference --help` describes it.

use std::process::ExitCode;

fn main() -> ExitCode {
    reference::cli::run()
}
