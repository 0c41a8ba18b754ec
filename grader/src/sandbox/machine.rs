//! Decides whether a failure may be the machine's, by what the machine had left.
//!
//! [`blame`] is the only place that decides this: [`Machine::look`] measures, and
//! [`Machine::cause`] decides.

use std::fs::File;
use std::io;
use std::path::PathBuf;

use super::limits::{Granted, Resource};
use super::room::{self, Room};
use super::shortage::{SPARE, Shortage};
use super::{Call, Clock, Finished, Limits, Outcome, Stream};

/// The cause of a failure that is not what it seems to be.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Cause {
    /// The machine.
    Machine(Shortage),
    /// The program filled the disk.
    FilledDisk,
}

/// The state of the machine when a program has ended.
#[derive(Clone, Debug)]
struct Machine {
    /// The work folder, for messages.
    place: PathBuf,
    /// The least room on the file system of the work folder during the run.
    least: Room,
    /// The room that the program's files take in the folder.
    taken: Room,
    /// Whether the files that the step needs still fit.
    fits: Result<(), String>,
    can_open: Result<(), String>,
    can_start: Result<(), String>,
    /// Bytes of memory that are available; `None` if the system does not say.
    memory: Option<u64>,
    /// Number of processes that the system killed during the run because memory ran out.
    n_killed: u64,
    /// The limits of this process that leave a program less than it should have.
    lowered: Vec<Granted>,
}

/// Inspects the machine after a run that failed, and blames the machine if it lacked something.
///
/// The work folder must still exist. The outcome is [`Outcome::Machine`] if the failure says
/// nothing about the program, [`Outcome::TooMuchOutput`] if the program itself filled the disk, and
/// otherwise stays as it is.
pub fn blame(call: &Call, finished: Finished) -> Finished {
    if matches!(finished.outcome, Outcome::Machine(_) | Outcome::Interrupted) {
        return finished;
    }
    let cause = Machine::look(call, &finished).cause(&finished, &call.limits, call.needed);
    match cause {
        Some(Cause::Machine(shortage)) => {
            Finished { outcome: Outcome::Machine(shortage), ..finished }
        }
        Some(Cause::FilledDisk) => {
            Finished { outcome: Outcome::TooMuchOutput(Stream::Files), ..finished }
        }
        None => finished,
    }
}

impl Machine {
    fn look(call: &Call, finished: &Finished) -> Self {
        let taken = room::taken(&call.folder);
        // The program may have removed or closed its own folder; the one above is ours.
        let place = call.folder.parent().unwrap_or(&call.folder);
        let text = |why: io::Error| why.to_string();
        Self {
            place: place.to_owned(),
            least: finished.least,
            taken,
            fits: room::fits(place, call.needed.saturating_sub(taken.bytes)).map_err(text),
            can_open: can_open().map_err(text),
            can_start: can_start().map_err(text),
            memory: memory_left(),
            n_killed: finished.n_killed,
            lowered: call.limits.lowered(),
        }
    }

    /// Returns the cause of a failure, or `None` if the machine had enough of everything.
    fn cause(&self, finished: &Finished, limits: &Limits, needed: u64) -> Option<Cause> {
        self.limit(finished, limits)
            .or_else(|| self.no_room(needed, limits))
            .or_else(|| self.other(finished, limits))
    }

    /// Returns a limit of this process that stopped the program earlier than its own limits would
    /// have.
    fn limit(&self, finished: &Finished, limits: &Limits) -> Option<Cause> {
        let is_to_blame = |granted: &&Granted| match (&finished.outcome, granted.resource) {
            (Outcome::TimedOut(Clock::Cpu), Resource::Cpu) => finished.cpu < limits.cpu,
            (Outcome::TooMuchOutput(Stream::File), Resource::FileSize) => true,
            (Outcome::OutOfMemory, Resource::AddressSpace) => finished.peak_bytes <= limits.memory,
            (
                Outcome::Exited(_) | Outcome::Signalled(_),
                Resource::AddressSpace | Resource::Descriptors,
            ) => !granted.is_enough,
            _ => false,
        };
        let granted = self.lowered.iter().find(is_to_blame)?;
        Some(Cause::Machine(Shortage::Limit(*granted)))
    }

    fn no_room(&self, needed: u64, limits: &Limits) -> Option<Cause> {
        let bytes = self.least.bytes.saturating_add(self.taken.bytes);
        let why = match &self.fits {
            Err(why) => why.clone(),
            Ok(()) if bytes < needed => format!("{bytes} were left"),
            Ok(()) if self.least.files == 0 => "no more files could be made".to_owned(),
            Ok(()) => return None,
        };
        if self.taken.exceeds(limits.folder_size) {
            return Some(Cause::FilledDisk);
        }
        Some(Cause::Machine(Shortage::Room { place: self.place.clone(), needed, why }))
    }

    fn other(&self, finished: &Finished, limits: &Limits) -> Option<Cause> {
        let shortage = match (&self.can_open, &self.can_start, self.memory) {
            (Err(why), _, _) => Shortage::Descriptors(why.clone()),
            (_, Err(why), _) => Shortage::Processes(why.clone()),
            _ if self.n_killed > 0 && finished.outcome == Outcome::Signalled(libc::SIGKILL) => {
                Shortage::Killed
            }
            (_, _, Some(left)) if self.lacks_memory(left, finished, limits) => {
                Shortage::Memory { left, needed: limits.memory }
            }
            _ => return None,
        };
        Some(Cause::Machine(shortage))
    }

    /// Returns whether the program ran out of memory below its own limit, because less than that
    /// limit was left.
    fn lacks_memory(&self, left: u64, finished: &Finished, limits: &Limits) -> bool {
        let is_within = finished.peak_bytes <= limits.memory;
        finished.outcome == Outcome::OutOfMemory && is_within && left < limits.memory
    }
}

/// Checks that [`SPARE`] more files can be opened, and closes them again.
fn can_open() -> io::Result<()> {
    let open = |_| File::open("/dev/null");
    (0..SPARE).map(open).collect::<io::Result<Vec<_>>>().map(drop)
}

/// Checks that [`SPARE`] more threads can be started, and ends them again. The system counts
/// threads as processes, and threads cost less.
fn can_start() -> io::Result<()> {
    std::thread::scope(|scope| {
        let start = |_| {
            std::thread::Builder::new().stack_size(64 << 10).spawn_scoped(scope, std::thread::park)
        };
        let mut threads = vec![];
        let started = (0..SPARE).try_for_each(|n| start(n).map(|thread| threads.push(thread)));
        threads.iter().for_each(|thread| thread.thread().unpark());
        started
    })
}

/// Returns the bytes of memory that programs can still take, swap included, or `None` if the system
/// does not say.
pub fn memory_left() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let kib = |name: &str| {
        let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
        rest.trim().trim_end_matches(" kB").parse::<u64>().ok()
    };
    Some((kib("MemAvailable:")? + kib("SwapFree:").unwrap_or(0)) << 10)
}

/// Returns the number of processes that the system has killed since it started because memory ran
/// out, or 0 if it does not say.
pub(super) fn n_killed() -> u64 {
    let text = std::fs::read_to_string("/proc/vmstat").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("oom_kill "));
    line.and_then(|n| n.trim().parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests;
