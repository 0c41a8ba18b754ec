//! Runs one program under limits and reports how it ended. The sandbox knows nothing of cases,
//! images or scores.
//!
//! A program runs in processes of its own (`launcher`), under limits on time and resources, in an
//! environment built from nothing and a work folder of its own, with bounded streams. The
//! [`Layers`] of protection keep every other file, process and machine out of its reach, where the
//! kernel allows. A layer that cannot be set up is never left out: the run fails instead.

mod access;
mod call;
mod finish;
mod folder;
mod group;
mod launcher;
mod layers;
mod level;
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
mod work;

pub use access::{Access, Rights, interpreters};
pub use call::Call;
pub use folder::{Folder, FolderError, clear_leftovers};
pub use launcher::prepare;
pub use layers::Layers;
pub use level::{Available, Level, MissingLayers, available};
pub use limits::{Granted, Limits, Resource};
pub use machine::{blame, memory_left};
pub use outcome::{Clock, Finished, Outcome, Stream};
pub use place::place_program;
pub use room::Room;
pub use shortage::Shortage;
pub use sys::{catch_signals, interrupted};
pub use turns::Turn;
pub use work::Work;

use std::time::{Duration, Instant};

use launcher::{News, Running};
use pump::Pump;
use sys::Reaped;
use turns::Taken;
use watch::Watch;

/// Runs `call` until it ends or is stopped. Afterwards no process of it is left. Returns the end of
/// the program, and its work folder.
///
/// A failure counts only after [`blame`] has looked at the machine.
pub fn run(call: &Call, turn: Turn) -> (Finished, Work) {
    let mut work = Work::new(&call.folder, None);
    let finished = run_in(call, turn, &mut work);
    (finished, work)
}

/// Runs `call` in `work`, which is replaced if the work folder is in memory.
fn run_in(call: &Call, turn: Turn, work: &mut Work) -> Finished {
    let turn = Taken::wait(turn);
    let start = Instant::now();
    let mut running = match place::start(call) {
        Ok(running) => running,
        Err(failure) => return Finished::not_started(&failure.error()),
    };
    if let Some(in_memory) = running.work.take() {
        *work = Work::new(&call.folder, Some(in_memory));
    }
    let mut pump = match Pump::new(&mut running, &call.stdin, call.limits.output) {
        Ok(pump) => pump,
        Err(why) => {
            running.end();
            return Finished::not_started(&why);
        }
    };
    let mut watch = Watch::new(&running, call, work, &turn);
    let stopped = attend(&mut pump, &mut watch, &running, start + call.limits.wall);
    let left = running.end();
    let (reaped, stopped) = match stopped {
        Ok(reaped) => (reaped, None),
        Err(outcome) => {
            let end = Err(libc::SIGKILL);
            (Reaped { end, cpu: watch.cpu, max_resident: watch.peak }, Some(outcome))
        }
    };
    // The program itself is among them if it was stopped.
    let left_behind = left.saturating_sub(u32::from(stopped.is_some()));
    pump.drain();
    finish::finish(call, reaped, stopped, pump, &watch, start.elapsed(), left_behind)
}

/// Returns whether this system shows the processes of a program, so that idle time is known.
pub fn sees_processes() -> bool {
    group::high_water(std::process::id()) > 0
}

/// Feeds and watches the program until it ends. Returns an outcome if a limit is exceeded.
fn attend(
    pump: &mut Pump,
    watch: &mut Watch,
    running: &Running,
    deadline: Instant,
) -> Result<Reaped, Outcome> {
    let mut pause = Duration::from_millis(1);
    loop {
        match running.news() {
            News::None => {}
            News::Ended(ended) => return Ok(ended.into()),
            // Something outside the grader has killed it.
            News::Lost => return Err(Outcome::Signalled(libc::SIGKILL)),
        }
        if sys::interrupted() {
            return Err(Outcome::Interrupted);
        }
        if Instant::now() >= deadline {
            return Err(Outcome::TimedOut(Clock::Wall));
        }
        if let Some(outcome) = watch.look().or_else(|| pump.turn(pause, running)) {
            return Err(outcome);
        }
        pause = (pause * 2).min(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests;
