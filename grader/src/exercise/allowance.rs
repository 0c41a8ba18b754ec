//! The limits of a program that is graded.

use std::time::Duration;

use crate::build::Program;
use crate::sandbox::{Layers, Limits};

/// The limits for each kind of run of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Allowance {
    /// The limits for one picture.
    pub picture: Limits,
    /// The limits for the unit checks of a stage.
    pub questions: Limits,
    /// The limit on CPU time plus idle time of all runs of a submission. Its stages share it.
    pub whole: Duration,
}

impl Allowance {
    /// The default CPU time for a picture, and for the questions of a stage.
    pub const TIME: Duration = Duration::from_secs(10);
    /// The default limit on the time of all runs of a submission.
    pub const WHOLE: Duration = Duration::from_secs(600);
    /// The default limit on resident bytes.
    pub const MEMORY: u64 = 1 << 30;

    /// Returns an allowance of `time` of CPU time for each run, `memory` resident bytes, and
    /// [`Allowance::WHOLE`] for all runs. The other times follow from [`Limits::with_time`].
    pub fn new(time: Duration, memory: u64) -> Self {
        let limits = Limits {
            cpu: time,
            idle: time,
            wall: time,
            memory,
            file_size: 64 << 20,
            folder_size: 256 << 20,
            output: 16 << 20,
            processes: 64,
        };
        let limits = limits.with_time(time);
        Self { picture: limits, questions: limits, whole: Self::WHOLE }
    }

    /// Returns the limit on the idle time of all runs of a submission: twelve times that of one
    /// picture.
    pub fn most_idle(&self) -> Duration {
        self.picture.idle * N_IDLE
    }
}

/// The limit on the idle time of a submission, in units of the limit on one picture.
const N_IDLE: u32 = 12;

/// Number of time-outs of pictures or of questions in a stage after which the rest get [`reduced`]
/// limits.
pub const N_TIMEOUTS: usize = 2;

/// Returns the limits for runs that will most likely time out as well: a fifth of the time, but at
/// least a second.
pub fn reduced(limits: Limits) -> Limits {
    limits.with_time((limits.cpu / 5).max(Duration::from_secs(1)))
}

impl Default for Allowance {
    fn default() -> Self {
        Self::new(Self::TIME, Self::MEMORY)
    }
}

/// A program that is graded, and its allowance.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    /// The program.
    pub program: &'a Program,
    /// The allowance of the program.
    pub allowance: Allowance,
    /// The layers of protection around the program.
    pub layers: Layers,
}
