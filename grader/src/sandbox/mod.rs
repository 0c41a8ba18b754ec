//! Runs one program under limits and reports how it ended. The sandbox knows nothing of cases,
//! images or scores.
//!
//! [`LEVEL`] names the protection that is in force: time and resource limits, a process group of
//! its own that is killed at any end, an environment built from nothing, a work folder of its own,
//! bounded streams. A program that may write files can still read those of the user who grades:
//! keep answers elsewhere, or grade as another user.

mod call;
mod finish;
mod folder;
mod group;
mod limits;
mod machine;
mod outcome;
mod place;
mod pump;
mod room;
mod shortage;
mod sys;
mod turns;
mod watch;

pub use call::Call;
pub use folder::{Folder, FolderError, clear_leftovers};
pub use limits::{Granted, Limits, Resource};
pub use machine::{blame, memory_left};
pub use outcome::{Clock, Finished, Outcome, Stream};
pub use place::place_program;
pub use room::Room;
pub use shortage::Shortage;
pub use sys::{catch_signals, interrupted};
pub use turns::Turn;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use pump::Pump;
use turns::Taken;
use watch::Watch;

/// The layers of protection that are in force, for the record.
pub const LEVEL: &str = "timeouts+rlimits+own process group";

/// Runs `call` until it ends or is stopped. Afterwards no process of its group is left.
///
/// A failure counts only after [`blame`] has looked at the machine.
pub fn run(call: &Call, turn: Turn) -> Finished {
    let turn = Taken::wait(turn);
    let start = Instant::now();
    let mut command = Command::new(&call.program);
    command
        .args(&call.args)
        .current_dir(&call.folder)
        .env_clear()
        .envs(call.environment.iter().cloned());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    sys::limit(&mut command, &call.limits.granted());
    let child = match place::spawn(&mut command) {
        Ok(child) => child,
        Err(why) => return Finished::not_started(&why),
    };
    let group = child.id();
    let mut pump = match Pump::new(child, &call.stdin, call.limits.output) {
        Ok(pump) => pump,
        Err(why) => {
            sys::kill_group(group);
            let _ = sys::reap(group);
            return Finished::not_started(&why);
        }
    };
    let mut watch = Watch::new(group, call, &turn);
    let stopped = attend(&mut pump, &mut watch, group, start + call.limits.wall);
    let left_behind = group::others(group);
    sys::kill_group(group);
    let reaped = sys::reap(group);
    pump.drain();
    finish::finish(call, reaped, stopped, pump, &watch, start.elapsed(), left_behind)
}

/// Returns whether this system shows the processes of a program, so that idle time is known.
pub fn sees_processes() -> bool {
    group::high_water(std::process::id()) > 0
}

/// Feeds and watches the group until its leader ends, or returns an outcome if a limit is exceeded.
fn attend(pump: &mut Pump, watch: &mut Watch, group: u32, deadline: Instant) -> Option<Outcome> {
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
