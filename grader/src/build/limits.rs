//! The limits of compilers, and the errors of builds that exceed them.

use std::time::Duration;

use super::error::{BuildError, Fault};
use crate::sandbox::{Clock, Limits, Outcome};

/// The limits of a compiler.
pub(super) const LIMITS: Limits = Limits {
    cpu: Duration::from_secs(600),
    idle: Duration::from_secs(120),
    wall: Duration::from_secs(1800),
    memory: 4 << 30,
    file_size: 256 << 20,
    folder_size: 2 << 30,
    output: 16 << 20,
    processes: 128,
};

/// Returns the error for a build that `outcome` has ended, under these limits.
pub(super) fn stopped(outcome: Outcome, limits: &Limits) -> BuildError {
    let rejected = |why: &str| BuildError::Rejected(format!("the build {why}"));
    match outcome {
        Outcome::Interrupted => BuildError::Interrupted,
        Outcome::Machine(shortage) => Fault::Machine(shortage).into(),
        Outcome::NoProgram(why) => Fault::NotStarted(why).into(),
        Outcome::TimedOut(Clock::Cpu) => {
            let seconds = limits.cpu.as_secs();
            rejected(&format!(
                "takes more than {seconds} s of CPU time (a macro that calls itself?)"
            ))
        }
        Outcome::TimedOut(Clock::Idle) => rejected(&format!(
            "waited for more than {} s without computing anything",
            limits.idle.as_secs()
        )),
        Outcome::TimedOut(Clock::Wall) => {
            rejected(&format!("did not end within {} s", limits.wall.as_secs()))
        }
        Outcome::OutOfMemory => rejected("takes more than 4 GiB of memory"),
        Outcome::TooMuchOutput(stream) => rejected(&format!("writes too much to {stream}")),
        Outcome::TooManyProcesses => rejected("starts too many processes"),
        Outcome::Exited(code) => rejected(&format!("ends with code {code}")),
        Outcome::Signalled(signal) => rejected(&format!("ends with signal {signal}")),
    }
}
