//! The command-line arguments of the grader.

mod batch;
mod confirm;

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand, ValueEnum};

pub(crate) use batch::Batch;
use confirm::Confirm;

use crate::cli::gradebook::Gradebook;
use crate::cli::limit::Limit;
use crate::cli::progress::Talk;
use crate::grade::{GradeError, Options};

const CODES: &str = "\
Exit codes:
  0    done, and everything passed
  1    done, something did not pass
  2    usage, or input that cannot be read
  3    the machine or the grader failed, even if something else did not pass: no points are final
  130  interrupted; finished work is kept";

/// Grades submissions of the ray-tracing assignment: builds them, runs them under limits, judges,
/// scores and reports.
#[derive(Debug, Parser)]
#[command(name = "grader", version, after_help = CODES, propagate_version = true)]
pub(crate) struct Arguments {
    /// When to colour the output
    #[arg(long, value_enum, default_value_t = Color::Auto, global = true, value_name = "WHEN")]
    pub(crate) color: Color,
    /// Print only the requested output
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Print more: compiler warnings, the output of programs, the subject of each check
    #[arg(short, long, global = true)]
    verbose: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Arguments {
    /// Returns how much is to be printed.
    pub(crate) fn talk(&self) -> Talk {
        Talk { is_quiet: self.quiet, is_verbose: self.verbose }
    }
}

/// The values of `--color`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Color {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

impl Color {
    pub(crate) fn write_global(self) {
        let choice = match self {
            Self::Auto => anstream::ColorChoice::Auto,
            Self::Always => anstream::ColorChoice::Always,
            Self::Never => anstream::ColorChoice::Never,
        };
        choice.write_global();
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Grade(Grade),
    Batch(Batch),
    Gradebook(Gradebook),
    Images(Images),
    Compare(Compare),
    Explain(Explain),
    Lint(Lint),
    Doctor(Doctor),
    Schema(Schema),
    Completions(Completions),
    Man(Man),
}

/// The options that select stages, cases and checks.
#[derive(Debug, Args)]
pub(crate) struct Selection {
    /// Folder of the stages [default: cases/stages here, else beside the binary]
    #[arg(long, value_name = "DIR")]
    cases: Option<PathBuf>,
    /// Only this stage, such as 02 or 02_shadows; may be repeated
    #[arg(long, value_name = "STAGE")]
    stage: Vec<String>,
    /// Only cases and checks whose id, or name without the stage, begins with ID, such as
    /// 01_ray_casting/sphere or sphere; may be repeated
    #[arg(long, value_name = "ID")]
    case: Vec<String>,
    /// Whether the program `reference` beside the grader confirms diagnoses
    ///
    /// It renders the named mistakes together, which shows wrong names and hidden mistakes. Points
    /// do not depend on it.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = Confirm::Never)]
    pub(crate) confirm: Confirm,
}

impl Selection {
    pub(crate) fn stages(&self) -> Result<PathBuf, GradeError> {
        stages(self.cases.as_deref())
    }

    /// Returns the options for grading `path` with this selection.
    pub(crate) fn options(&self, path: &Path) -> Options {
        Options { stages: self.stage.clone(), cases: self.case.clone(), ..Options::new(path) }
    }
}

/// Returns the folder of the stages: `given`, `cases/stages` in the current folder, or the
/// `cases/stages` nearest above the binary.
///
/// # Errors
/// Returns [`GradeError::Usage`] if `given` is `None` and neither folder exists.
pub(crate) fn stages(given: Option<&Path>) -> Result<PathBuf, GradeError> {
    if let Some(given) = given {
        return Ok(given.to_owned());
    }
    let binary = std::env::current_exe().unwrap_or_default();
    let beside =
        binary.ancestors().map(|folder| folder.join("cases/stages")).find(|stages| stages.is_dir());
    let here = Some(PathBuf::from("cases/stages")).filter(|stages| stages.is_dir());
    let none = "there are no cases: neither cases/stages here nor beside the binary; name \
        their folder with --cases DIR";
    here.or(beside).ok_or_else(|| GradeError::Usage(none.to_owned()))
}

/// The options that name report files.
#[derive(Debug, Args)]
pub(crate) struct Reports {
    /// Write the whole record as JSON; - is standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Write a page with pictures and differences; - is standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Write JUnit XML; - is standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    /// Write results.json as an autograder of Gradescope does; - is standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) gradescope: Option<PathBuf>,
    /// Write results.json as an external grader of PrairieLearn does; - is standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) prairielearn: Option<PathBuf>,
    /// Show the page in a browser
    #[arg(long, requires = "html")]
    pub(crate) open: bool,
}

/// Grade a submission: a folder or an archive
///
/// A submission is the template's folder, filled in; or a folder with a submission.toml that says
/// how it is built and run; or a .zip, .tar.gz or .tar of either.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader grade                                   the folder you are in
  grader grade handin.zip --html report.html --open
  grader grade --stage 02                          one stage
  grader grade --case 01_ray_casting/sphere        the checks of one function
  grader grade tests/solution --json record.json --junit junit.xml

Exit codes: 0 everything passed, 1 something did not, 2 usage or not a submission (an empty
folder, an archive that cannot be read), 3 the machine or the grader failed (whatever else did not
pass: no points are final), 130 interrupted")]
pub(crate) struct Grade {
    /// Folder or archive, not standard input
    #[arg(default_value = ".", value_parser = submission)]
    pub(crate) submission: PathBuf,
    #[command(flatten)]
    pub(crate) selection: Selection,
    #[command(flatten)]
    pub(crate) limit: Limit,
    #[command(flatten)]
    pub(crate) reports: Reports,
    /// Number of programs that run at once [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
}

/// Judge pictures that are rendered already: DIR/STAGE/CASE.png
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader images out                              judges out/01_ray_casting/boxes.png and so on
  grader images out --stage 02 --html report.html

Exit codes: 0 everything passed, 1 something did not, 2 usage or no such folder, 3 the machine or
the grader failed")]
pub(crate) struct Images {
    /// Folder of the pictures
    pub(crate) folder: PathBuf,
    #[command(flatten)]
    pub(crate) selection: Selection,
    #[command(flatten)]
    pub(crate) reports: Reports,
}

/// Compare two pictures, or a picture and a stored answer
///
/// A picture is a PNG, a PFM or an EXR file (R, G and B of its first part); its first bytes decide
/// which. Two pictures agree if no channel differs by more than the tolerance. The unit is an 8-bit
/// level: 255 times the difference of the light. The order of the two pictures does not matter.
/// Nothing is rounded or clamped: 16-bit and float samples count as they are, and so does light
/// below 0 and above 1. NaN and infinity differ from everything. A damaged file is an error.
///
/// With --answer, the picture is judged like that of a submission, by the range that correct
/// programs give for each pixel.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader compare mine.png theirs.png
  grader compare mine.pfm theirs.png --tolerance 0.5     an 8-bit PNG holds light to half a level
  grader compare - theirs.png < mine.png
  grader compare mine.png --answer cases/stages/02_shadows/two_lamps.answer.exr

Exit codes: 0 they agree, 1 they do not, 2 a picture cannot be read, 3 the machine failed, 130
interrupted")]
pub(crate) struct Compare {
    /// A picture; - is standard input
    pub(crate) a: PathBuf,
    /// The other picture; - is standard input
    #[arg(required_unless_present = "answer", conflicts_with = "answer")]
    pub(crate) b: Option<PathBuf>,
    /// 8-bit levels by which a channel may differ [default: 0, or the slack of the answer]
    #[arg(long, value_name = "LEVELS", value_parser = levels)]
    pub(crate) tolerance: Option<f64>,
    /// A stored answer instead of the second picture: STAGES/STAGE/CASE.answer.exr, with its case
    /// beside it
    #[arg(long, value_name = "FILE")]
    pub(crate) answer: Option<PathBuf>,
}

/// Print the tree of rays behind a pixel, as the submission traces it
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader explain . 04_refraction/prism 80 33     column 80 from the left, row 33 from the top

Exit codes: 0 printed, 1 the submission does not build or cannot explain, 2 usage, no such case or
pixel, or not a submission, 3 the machine or the grader failed, 130 interrupted")]
pub(crate) struct Explain {
    /// Folder or archive, not standard input
    #[arg(value_parser = submission)]
    pub(crate) submission: PathBuf,
    /// Id of an image case
    pub(crate) case: String,
    /// Column from the left
    pub(crate) x: u32,
    /// Row from the top
    pub(crate) y: u32,
    /// Folder of the stages [default: cases/stages here, else beside the binary]
    #[arg(long, value_name = "DIR")]
    pub(crate) cases: Option<PathBuf>,
}

/// Check case files and answers, and report everything that is wrong with them
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader lint                                    cases/stages
  grader lint my-course/stages -v

Exit codes: 0 nothing is wrong, 1 something is, 2 usage, no such folder, or no stages in it")]
pub(crate) struct Lint {
    /// Folder of the stages [default: cases/stages here, else beside the binary]
    pub(crate) folder: Option<PathBuf>,
}

/// Check that this machine has everything that grading needs
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader doctor                                  before the first `grader batch` on a machine
  grader doctor --cases my-course/stages

Exit codes: 0 nothing is missing, 3 something is missing")]
pub(crate) struct Doctor {
    /// Folder of the stages [default: cases/stages here, else beside the binary]
    #[arg(long, value_name = "DIR")]
    pub(crate) cases: Option<PathBuf>,
}

/// Print the JSON Schema of grade records
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  grader schema > grade-record.schema.json       the schema of what `grade --json` writes

Exit codes: 0 printed, 2 usage")]
pub(crate) struct Schema {}

/// Print completions for a shell
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  grader completions bash > ~/.local/share/bash-completion/completions/grader

Exit codes: 0 printed, 2 no such shell")]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

/// Print a man page, or write those of all commands into a folder
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  grader man grade | man -l -                    the page of a command
  grader man ~/.local/share/man/man1             writes one page for each command

Exit codes: 0 done, 2 no such command or folder, or a folder that cannot be written")]
pub(crate) struct Man {
    /// A command, or a folder for all pages [default: the page of grader itself]
    #[arg(value_name = "COMMAND|DIR")]
    pub(crate) what: Option<PathBuf>,
}

/// Parses the path of a submission. Refuses `-`, which would name a file but is never meant as one.
fn submission(text: &str) -> Result<PathBuf, String> {
    match text {
        "-" => {
            Err("a submission is a folder or an archive; none is read from standard input"
                .to_owned())
        }
        _ => Ok(PathBuf::from(text)),
    }
}

/// Parses a number of 8-bit levels, from 0 to 255.
fn levels(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|levels| (0.0..=255.0).contains(levels));
    number.ok_or_else(|| "a number from 0 to 255".to_owned())
}

#[cfg(test)]
mod tests;
