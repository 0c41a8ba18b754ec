//! Runs one program under limits and tells how it ended. Knows nothing of cases, images or scores.
//!
//! What is in force is named by [`LEVEL`]: wall clock, resource limits, an own process group that is killed on any end, an
//! environment built from nothing, a work folder of its own, bounded streams. Whoever may write files can still read those
//! of the user who grades: keep answers elsewhere, or grade as another user.

mod folder;
mod outcome;
mod pump;
mod sys;
mod watch;

pub use folder::Folder;
pub use outcome::{Clock, Finished, Outcome, Stream};
pub use sys::{catch_interrupts, interrupted};

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The layers of protection that are in force, for the record.
pub const LEVEL: &str = "timeouts+rlimits+own process group";

/// What a program may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Time by the clock.
    pub wall: Duration,
    /// CPU time of one process, in whole seconds.
    pub cpu: Duration,
    /// Resident bytes of the whole group; address space is bounded to four times as much.
    pub memory: u64,
    /// Bytes of one file.
    pub file_size: u64,
    /// Bytes on standard output, and the same on standard error.
    pub output: u64,
    /// Processes of the group, threads not counted.
    pub processes: u32,
}

/// What to run.
#[derive(Clone, Debug)]
pub struct Call {
    /// The program, and its arguments.
    pub program: PathBuf,
    /// Arguments.
    pub args: Vec<OsString>,
    /// Where it starts; meant to be fresh and its own.
    pub folder: PathBuf,
    /// Its whole environment.
    pub environment: Vec<(OsString, OsString)>,
    /// What it reads on standard input.
    pub stdin: Vec<u8>,
    /// What it may use.
    pub limits: Limits,
}

/// Runs `call` to its end, natural or not; afterwards no process of its group is left.
pub fn run(call: &Call) -> Finished {
    let start = Instant::now();
    let mut command = Command::new(&call.program);
    command.args(&call.args).current_dir(&call.folder).env_clear().envs(call.environment.iter().cloned());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    sys::limit(&mut command, &call.limits);
    let child = match command.spawn() {
        Ok(child) => child,
        Err(why) => return Finished::not_started(&why),
    };
    let group = child.id();
    let mut pump = match pump::Pump::new(child, &call.stdin, call.limits.output) {
        Ok(pump) => pump,
        Err(why) => {
            sys::kill_group(group);
            return Finished::not_started(&why);
        }
    };
    let mut watch = watch::Watch::new(group, call.limits);
    let stopped = attend(&mut pump, &mut watch, group, start + call.limits.wall);
    let left_behind = watch.others();
    sys::kill_group(group);
    let reaped = sys::reap(group);
    pump.drain();
    outcome::finish(call, reaped, stopped, pump, &watch, start.elapsed(), left_behind)
}

/// Feeds and watches the group until its leader ends (`None`) or a limit is passed.
fn attend(pump: &mut pump::Pump, watch: &mut watch::Watch, group: u32, deadline: Instant) -> Option<Outcome> {
    let mut pause = Duration::from_millis(1);
    loop {
        if sys::has_ended(group) {
            return None;
        }
        if sys::interrupted() {
            return Some(Outcome::Interrupted);
        }
        if Instant::now() >= deadline {
            return Some(Outcome::TimedOut(Clock::Wall));
        }
        if let Some(outcome) = watch.look().or_else(|| pump.turn(pause)) {
            return Some(outcome);
        }
        pause = (pause * 2).min(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests;
