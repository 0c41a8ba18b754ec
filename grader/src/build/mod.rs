//! From a submission to a program that can be run.

mod diagnostics;
mod own;
mod rustc;
mod sdk;
mod toolchain;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

pub use sdk::Sdk;
pub use toolchain::Toolchain;

use crate::sandbox::{Clock, Folder, Limits, Outcome};
use crate::submission::{Kind, Submission, Template};

/// A program that answers the calls of the protocol.
#[derive(Debug)]
pub struct Program {
    /// What is executed.
    pub path: PathBuf,
    /// Arguments before those of the protocol.
    pub args: Vec<OsString>,
    /// PATH of its environment.
    pub search: OsString,
    /// Where a private copy lies; goes away with this.
    folder: Option<Folder>,
}

impl Program {
    /// A program that lies somewhere for good.
    pub fn new(path: impl Into<PathBuf>, args: Vec<OsString>, search: impl Into<OsString>) -> Self {
        Self { path: path.into(), args, search: search.into(), folder: None }
    }

    /// Whether the submission says what is executed, and not the grader, which has compiled it.
    pub fn is_foreign(&self) -> bool {
        self.folder.is_some()
    }
}

/// A program, and what there is to say of its making.
#[derive(Debug)]
pub struct Built {
    /// It.
    pub program: Program,
    /// What the compiler warned of.
    pub warnings: Vec<String>,
    /// Time by the clock; none where a stored build was taken.
    pub time: Duration,
}

/// Why there is no program.
#[derive(Debug)]
pub enum BuildError {
    /// The submission is to blame; the text is for the student.
    Rejected(String),
    /// The machine or the grader is.
    Ours(String),
    /// The user stopped the grader.
    Interrupted,
}

/// What building needs, found once and shared by all submissions.
#[derive(Debug)]
pub struct Workshop {
    /// The workspace of the assignment.
    pub root: PathBuf,
    /// The assignment as it is handed out.
    pub template: Template,
    toolchain: OnceLock<Result<Toolchain, String>>,
    sdk: OnceLock<Result<Sdk, String>>,
}

impl Workshop {
    /// Finds the workspace from a folder of cases, from the running binary, or from where we are.
    ///
    /// # Errors
    /// Says what is missing.
    pub fn open(stages: &Path) -> Result<Self, String> {
        let here = std::env::current_dir().unwrap_or_default();
        let binary = std::env::current_exe().unwrap_or_default();
        let stages = stages.canonicalize().unwrap_or_default();
        let root = [stages.as_path(), &binary, &here].into_iter().find_map(root_above).ok_or(
            "the workspace of the assignment (with `student_template` and `cases`) is not above the cases, \
             the grader's binary, or the current folder: run from within it",
        )?;
        Ok(Self { root, template: Template::carried(), toolchain: OnceLock::new(), sdk: OnceLock::new() })
    }

    /// Where prepared things are stored between runs.
    pub fn store(&self) -> PathBuf {
        self.root.join("target/grader")
    }

    /// The compiler.
    ///
    /// # Errors
    /// Says how to get one.
    pub fn toolchain(&self) -> Result<&Toolchain, String> {
        self.toolchain.get_or_init(|| Toolchain::find(&self.root)).as_ref().map_err(Clone::clone)
    }

    /// The compiled crates that student code is linked with; made at the first call, which takes a while.
    ///
    /// # Errors
    /// What cargo says.
    pub fn sdk(&self, tell: &dyn Fn(&str)) -> Result<&Sdk, String> {
        let prepare = || Sdk::prepare(self.toolchain()?, self, tell);
        self.sdk.get_or_init(prepare).as_ref().map_err(Clone::clone)
    }
}

/// The nearest folder above `path` that holds the template and the cases.
fn root_above(path: &Path) -> Option<PathBuf> {
    let is_root = |folder: &&Path| {
        ["Cargo.lock", "cases/Cargo.toml", "student_template/Cargo.toml"].iter().all(|name| folder.join(name).is_file())
    };
    path.ancestors().find(is_root).map(Path::to_owned)
}

/// Builds `submission`; `tell` hears what takes a while.
///
/// # Errors
/// [`BuildError`].
pub fn build(submission: &Submission, workshop: &Workshop, tell: &dyn Fn(&str)) -> Result<Built, BuildError> {
    match &submission.kind {
        Kind::Rust(rust) => rustc::build(&rust.sources, &submission.digest, workshop, tell),
        Kind::Own(own) => own::build(own, tell),
    }
}

/// What a compiler may use.
const LIMITS: Limits = Limits {
    wall: Duration::from_secs(300),
    cpu: Duration::from_secs(300),
    memory: 4 << 30,
    file_size: 256 << 20,
    output: 16 << 20,
    processes: 128,
};

/// What a build that was stopped means.
fn stopped(outcome: Outcome, limits: &Limits) -> BuildError {
    let seconds = limits.wall.as_secs();
    match outcome {
        Outcome::Interrupted => BuildError::Interrupted,
        Outcome::CouldNotStart(why) | Outcome::NoProgram(why) => {
            BuildError::Ours(format!("the build cannot be started: {why}"))
        }
        Outcome::TimedOut(Clock::Wall | Clock::Cpu) => {
            BuildError::Rejected(format!("the build did not end within {seconds} s (a macro that calls itself?)"))
        }
        Outcome::OutOfMemory => BuildError::Rejected("the build takes more than 4 GiB of memory".to_owned()),
        Outcome::TooMuchOutput(stream) => BuildError::Rejected(format!("the build writes too much to {stream}")),
        Outcome::TooManyProcesses => BuildError::Rejected("the build starts too many processes".to_owned()),
        Outcome::Exited(code) => BuildError::Rejected(format!("the build ends with code {code}")),
        Outcome::Signalled(signal) => BuildError::Rejected(format!("the build ends with signal {signal}")),
    }
}
