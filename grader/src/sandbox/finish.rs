//! Combines what the kernel, the streams and the watch report into the result of a run.

use std::time::Duration;

use super::call::Call;
use super::limits::Resource;
use super::outcome::{Clock, Finished, Outcome, Stream};
use super::pump::Pump;
use super::sys::Reaped;
use super::watch::Watch;
use super::work::Work;

/// Returns the result of `call` from what the kernel, the streams and the watch report.
pub(super) fn finish(
    call: &Call,
    reaped: Reaped,
    stopped: Option<Outcome>,
    pump: Pump,
    watch: &Watch,
    wall: Duration,
    left_behind: u32,
) -> Finished {
    let peak_bytes = if watch.peak == 0 { reaped.max_resident } else { watch.peak };
    let cpu = reaped.cpu.max(watch.cpu);
    let outcome = match stopped.unwrap_or_else(|| classify(call, &reaped, &pump.stderr)) {
        // CPU time that the watch did not see counts as well: that of a child, or of the moments
        // between two looks.
        Outcome::Exited(_) | Outcome::Signalled(_) if cpu > call.limits.cpu => {
            Outcome::TimedOut(Clock::Cpu)
        }
        Outcome::Exited(code) if code != 0 && holds_full_file(call, watch.work) => {
            Outcome::TooMuchOutput(Stream::File)
        }
        Outcome::Exited(_) | Outcome::Signalled(_) if watch.has_filled() => {
            Outcome::TooMuchOutput(Stream::Files)
        }
        outcome => outcome,
    };
    Finished {
        outcome,
        stdout: pump.stdout,
        stderr: pump.stderr,
        wall,
        cpu,
        idle: watch.idle,
        peak_bytes,
        left_behind,
        is_disturbed: watch.is_disturbed(),
        least: watch.least_room(),
        n_killed: watch.n_killed(),
    }
}

/// Returns the outcome of a process that the grader did not end. The kernel may have ended it at a
/// limit that the grader set.
fn classify(call: &Call, reaped: &Reaped, stderr: &[u8]) -> Outcome {
    match reaped.end {
        Ok(0) => Outcome::Exited(0),
        _ if says_out_of_memory(stderr) => Outcome::OutOfMemory,
        Ok(code) => Outcome::Exited(code),
        Err(libc::SIGXCPU) => Outcome::TimedOut(Clock::Cpu),
        // The kernel kills at the hard limit, which it compares with a clock of its own.
        Err(libc::SIGKILL)
            if reaped.cpu.as_millis() + 100 >= u128::from(allowed(call, Resource::Cpu)) * 1000 =>
        {
            Outcome::TimedOut(Clock::Cpu)
        }
        Err(libc::SIGXFSZ) => Outcome::TooMuchOutput(Stream::File),
        Err(signal) => Outcome::Signalled(signal),
    }
}

/// Returns the system limit on `resource` under which the program ran.
fn allowed(call: &Call, resource: Resource) -> u64 {
    let granted = call.limits.granted().into_iter().find(|granted| granted.resource == resource);
    granted.map_or(u64::MAX, |granted| granted.allowed)
}

/// Returns whether a file in the folder has grown to its limit: some runtimes turn the kernel's
/// signal into an error of their own.
fn holds_full_file(call: &Call, work: &Work) -> bool {
    let limit = allowed(call, Resource::FileSize);
    let entries = std::fs::read_dir(work.path()).into_iter().flatten().flatten();
    entries
        .filter_map(|entry| entry.metadata().ok())
        .any(|found| found.is_file() && found.len() >= limit)
}

/// Returns whether standard error holds the message of an allocator that failed. The limit on
/// address space shows in no other way.
fn says_out_of_memory(stderr: &[u8]) -> bool {
    let text = String::from_utf8_lossy(stderr);
    ["memory allocation of ", "std::bad_alloc", "MemoryError", "OutOfMemoryError", "out of memory"]
        .iter()
        .any(|sign| text.contains(sign))
}
