//! Asks a program what the cases ask: each picture in a process and folder of its own, the unit checks of a stage in one
//! process where it holds out.

mod explain;
mod pictures;
mod probes;
mod replies;

use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

use crate::build::Program;
use crate::sandbox::{self, Call, Finished, Limits, Outcome};

pub use explain::explain;
pub use pictures::{NoPicture, Shot, read, shoot};
pub use probes::{Probed, probe};
pub use replies::Got;

/// What a program may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Allowance {
    /// For one picture.
    pub picture: Limits,
    /// For the unit checks of a stage.
    pub questions: Limits,
}

impl Allowance {
    /// Wall clock for a picture, and for the questions of a stage, unless the course says otherwise.
    pub const TIME: Duration = Duration::from_secs(10);
    /// Resident bytes unless the course says otherwise.
    pub const MEMORY: u64 = 1 << 30;

    /// `time` by the clock, twice that in CPU time, `memory` in resident bytes.
    pub fn new(time: Duration, memory: u64) -> Self {
        let limits = Limits { wall: time, cpu: time * 2, memory, file_size: 64 << 20, output: 16 << 20, processes: 64 };
        Self { picture: limits, questions: limits }
    }
}

impl Default for Allowance {
    fn default() -> Self {
        Self::new(Self::TIME, Self::MEMORY)
    }
}

/// A program that is examined, and what it may use.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    /// The program.
    pub program: &'a Program,
    /// What it may use.
    pub allowance: Allowance,
}

/// Runs the program with more arguments in `folder`; once again where the machine kept it from starting.
fn run(program: &Program, args: &[OsString], folder: &Path, stdin: Vec<u8>, limits: Limits) -> Finished {
    let environment = [
        ("PATH", program.search.clone()),
        ("HOME", folder.into()),
        ("TMPDIR", folder.into()),
        ("LANG", "C.UTF-8".into()),
    ];
    let call = Call {
        program: program.path.clone(),
        args: program.args.iter().chain(args).cloned().collect(),
        folder: folder.to_owned(),
        environment: environment.map(|(name, value)| (name.into(), value)).to_vec(),
        stdin,
        limits,
    };
    let mut finished = sandbox::run(&call);
    if matches!(finished.outcome, Outcome::CouldNotStart(_)) {
        finished = sandbox::run(&call);
    }
    match finished.outcome {
        Outcome::NoProgram(why) if !program.is_foreign() => {
            Finished { outcome: Outcome::CouldNotStart(why), ..finished } // what we have built ourselves has gone
        }
        _ => finished,
    }
}

#[cfg(test)]
mod tests;
