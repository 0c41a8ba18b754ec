//! `grader`: grades submissions of the ray-tracing assignment.

use std::process::ExitCode;

fn main() -> ExitCode {
    grader::cli::run()
}
