//! Memory and number of the processes of a group, from /proc where there is one.

use std::time::{Duration, Instant};

use super::{Limits, Outcome, sys};

/// The leader is looked at this often.
const EVERY: Duration = Duration::from_millis(10);
/// All processes of the machine are gone through this often.
const GROUP_EVERY: Duration = Duration::from_millis(100);

/// What has been seen of a group.
pub(super) struct Watch {
    group: u32,
    limits: Limits,
    next: Instant,
    next_group: Instant,
    /// Largest resident bytes seen; 0 where nobody looked.
    pub(super) peak: u64,
}

impl Watch {
    pub(super) fn new(group: u32, limits: Limits) -> Self {
        let now = Instant::now();
        Self { group, limits, next: now, next_group: now + GROUP_EVERY, peak: 0 }
    }

    /// Looks if it is time to; an outcome where the group is over its budget.
    pub(super) fn look(&mut self) -> Option<Outcome> {
        let now = Instant::now();
        if now < self.next {
            return None;
        }
        self.next = now + EVERY;
        self.peak = self.peak.max(high_water(self.group));
        let mut n_processes = 1;
        if now >= self.next_group {
            self.next_group = now + GROUP_EVERY;
            let members = members(self.group);
            n_processes = members.len();
            self.peak = self.peak.max(members.iter().map(|member| member.resident).sum());
        }
        match () {
            () if self.peak > self.limits.memory => Some(Outcome::OutOfMemory),
            () if n_processes > self.limits.processes as usize => Some(Outcome::TooManyProcesses),
            () => None,
        }
    }

    /// CPU time that one process may use.
    pub(super) fn cpu_limit(&self) -> Duration {
        self.limits.cpu
    }

    /// Processes of the group besides its leader that still run.
    pub(super) fn others(&self) -> u32 {
        members(self.group).iter().filter(|member| member.pid != self.group).count() as u32
    }
}

struct Member {
    pid: u32,
    resident: u64,
}

/// The living processes of a group; empty where there is no /proc.
fn members(group: u32) -> Vec<Member> {
    let Ok(entries) = std::fs::read_dir("/proc") else { return vec![] };
    let pids = entries.flatten().filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    pids.filter_map(|pid| member(pid, group)).collect()
}

/// Reads /proc/PID/stat: behind the name in parentheses come state, parent, group, ..., and as the 22nd the resident pages.
fn member(pid: u32, group: u32) -> Option<Member> {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let is_alive = !matches!(*fields.first()?, "Z" | "X");
    let is_member = fields.get(2)?.parse() == Ok(group);
    let pages: u64 = fields.get(21)?.parse().ok()?;
    (is_alive && is_member).then_some(Member { pid, resident: pages * sys::page_bytes() })
}

/// The largest resident size that one process has had, in bytes; 0 where that cannot be read.
fn high_water(pid: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib: u64 = line.and_then(|rest| rest.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0);
    kib * 1024
}
