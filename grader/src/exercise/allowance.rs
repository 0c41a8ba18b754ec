//! What a program may use while it is examined.

use std::time::Duration;

use crate::build::Program;
use crate::sandbox::Limits;

/// The limits of what a program may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Allowance {
    /// The limits for one picture.
    pub picture: Limits,
    /// The limits for the unit checks of a stage.
    pub questions: Limits,
}

impl Allowance {
    /// CPU time for a picture, and for the questions of a stage, unless the course says otherwise.
    pub const TIME: Duration = Duration::from_secs(10);
    /// Resident bytes unless the course says otherwise.
    pub const MEMORY: u64 = 1 << 30;

    /// Returns an allowance of `time` of CPU time, the other times that follow from it, and
    /// `memory` resident bytes.
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
        Self { picture: limits, questions: limits }
    }

    /// Returns the idle time that all runs of a submission may take together: twelve times that of
    /// one picture.
    pub fn most_idle(&self) -> Duration {
        self.picture.idle * N_IDLE
    }
}

/// Number of runs of a submission that may be idle for as long as one may.
const N_IDLE: u32 = 12;

/// Number of time-outs within a stage, of pictures or of questions, after which the rest gets
/// [`reduced`] limits.
pub const N_TIMEOUTS: usize = 2;

/// Returns the limits for what most likely is not done in time either: a fifth of the time, but at
/// least a second.
pub fn reduced(limits: Limits) -> Limits {
    limits.with_time((limits.cpu / 5).max(Duration::from_secs(1)))
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
    /// The allowance of the program.
    pub allowance: Allowance,
}
