//! The arguments of `grader gradebook`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::report::gradebook::Format;

/// Give the points of a class back to its platform
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  grader gradebook export results --format csv -o points.csv

Exit codes: 0 written, 2 usage, no roll, or a file that cannot be filled, 3 the machine failed")]
pub(crate) struct Gradebook {
    #[command(subcommand)]
    pub(crate) action: Action,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Action {
    Export(Export),
}

/// Write the points of a class into a file that its platform imports
///
/// The batch has to be one with a roster. The points are those after the deduction. Students
/// without a total keep what the platform has: those who handed in nothing, and those with an open
/// decision.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader gradebook export results --format csv -o points.csv
  grader gradebook export results --format canvas --into canvas.csv -o filled.csv
  grader gradebook export results --format canvas --into canvas.csv --column 'Ray tracing' -o -
  grader gradebook export results --format moodle --into worksheet.csv -o filled.csv
  grader gradebook export results --format gradescope -o gradescope

Exit codes: 0 written, 2 usage, no roll, or a file that cannot be filled, 3 the machine failed")]
pub(crate) struct Export {
    /// Folder of the results of a batch with a roster
    #[arg(value_name = "OUT")]
    pub(crate) results: PathBuf,
    /// Platform that takes the file
    #[arg(long, value_enum)]
    pub(crate) format: Format,
    /// File that the platform exported: the gradebook of Canvas, or the grading worksheet of Moodle
    ///
    /// One column of it is filled, and no other byte changes.
    #[arg(long, value_name = "FILE")]
    pub(crate) into: Option<PathBuf>,
    /// Column to fill, by its name with or without the number behind it [default: the only one of
    /// an assignment]
    #[arg(long, value_name = "NAME", requires = "into")]
    pub(crate) column: Option<String>,
    /// File to write, or the folder for --format gradescope; - is standard output
    #[arg(short, long, value_name = "FILE")]
    pub(crate) out: PathBuf,
}
