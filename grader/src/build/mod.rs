//! From a submission to a program that can be run.

mod diagnostics;
mod entry;
mod own;
mod program;
mod rustc;
mod sdk;
mod toolchain;

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

pub use entry::StoreError;
pub use program::Program;
pub use sdk::{Sdk, SdkError};
pub use toolchain::Toolchain;

use crate::sandbox::{Clock, FolderError, Limits, Outcome, Shortage};
use crate::submission::{Kind, Submission, Template};

/// A program, and what there is to say of its making.
#[derive(Debug)]
pub struct Built {
    /// The program.
    pub program: Program,
    /// The compiler's warnings.
    pub warnings: Vec<String>,
    /// Wall time, which is zero where a stored build was taken.
    pub time: Duration,
}

/// Why there is no program.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// The submission is to blame; the text is for the student.
    #[error("{0}")]
    Rejected(String),
    /// The machine or the grader is to blame.
    #[error(transparent)]
    Ours(#[from] Fault),
    /// The user stopped the grader.
    #[error("the grader was interrupted while building")]
    Interrupted,
}

/// A fault of the machine or the grader that keeps a submission from being built.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The machine fell short.
    #[error(transparent)]
    Machine(#[from] Shortage),
    /// There is no temporary folder.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// What the grader stored cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Anything else; the text is for the one who grades.
    #[error("{0}")]
    Other(String),
}

/// What building needs, found once and shared by all submissions.
#[derive(Debug)]
pub struct Workshop {
    /// The workspace of the assignment.
    pub root: PathBuf,
    /// The assignment as it is handed out.
    pub template: Template,
    toolchain: OnceLock<Result<Toolchain, String>>,
    sdk: OnceLock<Result<Sdk, SdkError>>,
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
    pub fn toolchain(&self) -> Result<&Toolchain, Fault> {
        let found = self.toolchain.get_or_init(|| Toolchain::find(&self.root));
        found.as_ref().map_err(|why| Fault::Other(why.clone()))
    }

    /// The compiled crates that student code is linked with; made at the first call, which takes a while.
    ///
    /// # Errors
    /// What cargo says, and a store that cannot be used. The error stays the same while this process runs.
    pub fn sdk(&self, tell: &dyn Fn(&str)) -> Result<&Sdk, Fault> {
        let prepare = || {
            let toolchain = self.toolchain().map_err(|why| SdkError::Toolchain(why.to_string()))?;
            Sdk::prepare(toolchain, self, tell)
        };
        self.sdk.get_or_init(prepare).as_ref().map_err(|why| Fault::Other(why.to_string()))
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
    cpu: Duration::from_secs(600),
    idle: Duration::from_secs(120),
    wall: Duration::from_secs(1800),
    memory: 4 << 30,
    file_size: 256 << 20,
    folder_size: 2 << 30,
    output: 16 << 20,
    processes: 128,
};

/// What a build that was stopped means.
fn stopped(outcome: Outcome, limits: &Limits) -> BuildError {
    let rejected = |why: &str| BuildError::Rejected(format!("the build {why}"));
    match outcome {
        Outcome::Interrupted => BuildError::Interrupted,
        Outcome::Machine(shortage) => Fault::Machine(shortage).into(),
        Outcome::NoProgram(why) => Fault::Other(format!("the build cannot be started: {why}")).into(),
        Outcome::TimedOut(Clock::Cpu) => {
            let seconds = limits.cpu.as_secs();
            rejected(&format!("takes more than {seconds} s of CPU time (a macro that calls itself?)"))
        }
        Outcome::TimedOut(Clock::Idle) => {
            rejected(&format!("waited for more than {} s without computing anything", limits.idle.as_secs()))
        }
        Outcome::TimedOut(Clock::Wall) => rejected(&format!("did not end within {} s", limits.wall.as_secs())),
        Outcome::OutOfMemory => rejected("takes more than 4 GiB of memory"),
        Outcome::TooMuchOutput(stream) => rejected(&format!("writes too much to {stream}")),
        Outcome::TooManyProcesses => rejected("starts too many processes"),
        Outcome::Exited(code) => rejected(&format!("ends with code {code}")),
        Outcome::Signalled(signal) => rejected(&format!("ends with signal {signal}")),
    }
}
