//! Inspects the processes of a program through /proc. Without /proc, no process is seen.
//!
//! The processes are the descendants of the program's init. The init adopts every process whose own
//! parent has ended, so that none of them leaves, whatever its group or session.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::sys;

/// A program's processes at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Seen {
    /// Number of live processes.
    pub(super) n_processes: usize,
    /// Sum of their resident sizes, in bytes.
    pub(super) resident: u64,
    /// CPU time of the processes, including the children that they have waited for.
    pub(super) cpu: Duration,
    /// Whether a thread runs, is ready to run, or waits for a disk.
    pub(super) is_active: bool,
    /// Whether the threads have waited for a processor for more than a tenth of their running time;
    /// `None` if the system does not say.
    pub(super) is_delayed: Option<bool>,
}

/// Inspects the processes below `init`. Its own CPU time counts, which includes that of processes
/// that have ended.
pub(super) fn look(init: u32) -> Seen {
    let mut seen = Seen::default();
    let (mut run, mut wait, mut n_schedules) = (0, 0, 0);
    for process in members(init) {
        if process.pid == init {
            seen.cpu += process.cpu;
            continue;
        }
        seen.n_processes += usize::from(process.is_alive);
        seen.resident += process.resident;
        seen.cpu += process.cpu;
        for thread in threads(process.pid, process.n_threads) {
            seen.is_active |= stat(&thread).is_some_and(|stat| stat.is_active);
            if let Some((ran, waited)) = schedule(&thread) {
                (run, wait, n_schedules) = (run + ran, wait + waited, n_schedules + 1);
            }
        }
    }
    seen.is_delayed = (n_schedules > 0).then_some(wait > run / 10);
    seen
}

/// Returns the numbers of the processes below `init` that still run.
pub(super) fn below(init: u32) -> Vec<u32> {
    let all = members(init);
    all.iter().filter(|one| one.is_alive && one.pid != init).map(|one| one.pid).collect()
}

/// Returns the largest resident size that a process has had, in bytes, or 0 if that cannot be read.
pub(super) fn high_water(pid: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib: u64 =
        line.and_then(|rest| rest.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0);
    kib * 1024
}

/// The content of `/proc/PID/stat`, for a process or a thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stat {
    pid: u32,
    parent: u32,
    is_alive: bool,
    is_active: bool,
    /// CPU time of the process, and of the children that it has waited for.
    cpu: Duration,
    n_threads: u64,
    resident: u64,
}

fn members(init: u32) -> Vec<Stat> {
    let entries = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let processes =
        entries.filter(|entry| entry.file_name().as_encoded_bytes().iter().all(u8::is_ascii_digit));
    family(processes.filter_map(|entry| stat(&entry.path())).collect(), init)
}

/// Returns `init` and the processes of `all` that descend from it.
fn family(all: Vec<Stat>, init: u32) -> Vec<Stat> {
    let (mut members, mut others): (Vec<Stat>, Vec<Stat>) =
        all.into_iter().partition(|process| process.pid == init);
    loop {
        let is_child = |process: &Stat| members.iter().any(|member| member.pid == process.parent);
        let (children, rest): (Vec<Stat>, Vec<Stat>) = others.into_iter().partition(is_child);
        if children.is_empty() {
            return members;
        }
        members.extend(children);
        others = rest;
    }
}

/// Largest number of threads of a process that are inspected.
const MAX_THREADS: usize = 256;

/// Returns the /proc folders of a process's threads.
fn threads(pid: u32, n_threads: u64) -> Vec<PathBuf> {
    let process = PathBuf::from(format!("/proc/{pid}"));
    if n_threads <= 1 {
        return vec![process];
    }
    let entries = std::fs::read_dir(process.join("task")).into_iter().flatten().flatten();
    entries.take(MAX_THREADS).map(|entry| entry.path()).collect()
}

fn stat(process: &Path) -> Option<Stat> {
    parse(&std::fs::read_to_string(process.join("stat")).ok()?)
}

/// Parses the line of `stat`. The name in parentheses may contain any characters.
fn parse(line: &str) -> Option<Stat> {
    let (pid, rest) = (line.split_once(' ')?.0, line.rsplit_once(')')?.1);
    let fields: Vec<&str> = rest.split_whitespace().collect();
    let number = |at: usize| fields.get(at)?.parse::<u64>().ok();
    let state = *fields.first()?;
    let is_alive = !matches!(state, "Z" | "X");
    let ticks: u64 = (11..=14).map(number).sum::<Option<u64>>()?;
    Some(Stat {
        pid: pid.parse().ok()?,
        parent: fields.get(1)?.parse().ok()?,
        is_alive,
        is_active: matches!(state, "R" | "D"),
        cpu: Duration::from_millis(ticks * 1000 / sys::ticks_per_second()),
        n_threads: number(17)?,
        resident: if is_alive { number(21)? * sys::page_bytes() } else { 0 },
    })
}

/// Returns the nanoseconds for which a thread ran, and for which it was ready but did not run.
fn schedule(thread: &Path) -> Option<(u64, u64)> {
    let text = std::fs::read_to_string(thread.join("schedstat")).ok()?;
    let mut numbers = text.split_whitespace().map(|number| number.parse().ok());
    Some((numbers.next()??, numbers.next()??))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_stat_is_read_whatever_the_name() {
        let line = |state: &str| {
            format!(
                "42 (a) R 7 (b) {state} 1 40 40 0 -1 4194304 5 6 7 8 100 20 30 50 20 0 3 0 99 \
                    8192 2 18446744073709551615"
            )
        };
        let stat = parse(&line("S")).unwrap();
        assert_eq!((stat.pid, stat.parent, stat.n_threads), (42, 1, 3));
        assert_eq!(stat.cpu, Duration::from_millis(200 * 1000 / sys::ticks_per_second()));
        assert_eq!(stat.resident, 2 * sys::page_bytes());
        for (state, is_alive, is_active) in
            [("R", true, true), ("D", true, true), ("T", true, false), ("Z", false, false)]
        {
            let stat = parse(&line(state)).unwrap();
            assert_eq!((stat.is_alive, stat.is_active), (is_alive, is_active), "{state}");
        }
        assert_eq!(parse("42 (a) R 1"), None);
    }

    #[test]
    fn descendants_are_seen_and_no_one_else() {
        let line = |pid: u32, parent: u32| {
            parse(&format!("{pid} (x) S {parent} 7 1 0 -1 0 0 0 0 0 0 0 0 0 20 0 1 0 99 8192 2 0"))
                .unwrap()
        };
        // 42 is a child of the init 40, and 43 of 42; 41 has been adopted; 50 is unrelated.
        let all = [(43, 42), (40, 7), (41, 40), (42, 40), (50, 7), (7, 1)];
        let found = family(all.iter().map(|(pid, parent)| line(*pid, *parent)).collect(), 40);
        let mut pids: Vec<u32> = found.iter().map(|member| member.pid).collect();
        pids.sort();
        assert_eq!(pids, [40, 41, 42, 43]);
    }

    #[test]
    fn this_process_is_seen_at_work() {
        let me = stat(Path::new("/proc/self")).unwrap();
        let seen = look(me.parent);
        assert!(seen.n_processes >= 1 && seen.resident > 0 && seen.is_active, "{seen:?}");
        assert!(below(me.parent).contains(&me.pid));
        assert!(high_water(me.pid) > 0);
        assert_eq!(look(u32::MAX), Seen::default());
    }
}
