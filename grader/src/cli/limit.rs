//! The arguments that limit and protect programs.

use std::time::Duration;

use clap::Args;

use crate::exercise::Allowance;
use crate::grade::GradeError;
use crate::sandbox::{Layers, Level};

/// The limits of programs.
#[derive(Debug, Args)]
pub(crate) struct Limit {
    /// Seconds of CPU time that a program has for a picture, or for the unit checks of a stage
    ///
    /// The CPU time of all processes of the program counts. A program is also stopped if it is idle
    /// for half as long, but at least 1 s. The limit by the clock is six times as long plus 10 s,
    /// so that other programs on the machine do not matter.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 10,
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    time_limit: u16,
    /// Seconds of CPU time and idle time that all runs of a submission have together
    ///
    /// The stages share it: each has at least its part, and what earlier stages leave. Checks that
    /// are left when the time of their stage is over are not run.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 600,
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    total_time_limit: u32,
    /// Mebibytes of memory that a program may use
    #[arg(
        long,
        value_name = "MIB",
        default_value_t = 1024,
        value_parser = clap::value_parser!(u32).range(16..)
    )]
    memory_limit: u32,
    /// Protection around compilers and programs [default: basic; of a batch: full]
    ///
    /// `full` demands namespaces, Landlock and a filter of system calls, and stops where the
    /// machine lacks one of them; `basic` takes those that the machine has; `none` leaves only
    /// limits on time and memory. `grader doctor` lists what this machine has.
    #[arg(long, value_name = "LEVEL")]
    sandbox: Option<Level>,
}

impl Limit {
    /// Returns the layers of protection: those of `default`, unless the user selects a level.
    ///
    /// # Errors
    /// Fails if this machine lacks a layer that is demanded.
    pub(crate) fn layers(&self, default: Level) -> Result<Layers, GradeError> {
        Ok(self.sandbox.unwrap_or(default).layers()?)
    }

    pub(crate) fn allowance(&self) -> Allowance {
        let time = Duration::from_secs(self.time_limit.into());
        let whole = Duration::from_secs(self.total_time_limit.into());
        Allowance { whole, ..Allowance::new(time, u64::from(self.memory_limit) << 20) }
    }
}
