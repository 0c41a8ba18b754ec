//! Watches what a program uses while it runs: memory, CPU time, idle time, and room on the disk.

use std::time::{Duration, Instant};

use super::launcher::Running;
use super::room::{self, Room};
use super::turns::Taken;
use super::{Call, Clock, Outcome, Stream, Work, group, machine};

/// Time between two looks at the leader.
const EVERY: Duration = Duration::from_millis(10);
/// Time between two looks at all processes of the machine.
const GROUP_EVERY: Duration = Duration::from_millis(100);

/// Observations of a program and its processes.
pub(super) struct Watch<'a> {
    /// The init of the program.
    init: u32,
    /// The program itself.
    program: u32,
    call: &'a Call,
    /// The work folder.
    pub(super) work: &'a Work,
    turn: &'a Taken,
    next: Instant,
    last_group: Instant,
    /// The room on the file system of the work folder when the program began.
    room: Room,
    n_killed: u64,
    /// Largest resident size seen, in bytes; 0 if none was measured.
    pub(super) peak: u64,
    /// CPU time of all processes.
    pub(super) cpu: Duration,
    /// Time in which no process ran, was ready to run, or waited for a disk.
    pub(super) idle: Duration,
    /// Whether threads often had to wait for a processor; `None` if the system does not say.
    is_delayed: Option<bool>,
    /// Whether the CPU time was used up while nothing slowed the program down.
    is_sure: bool,
    /// The least room that was seen.
    least: Room,
}

impl<'a> Watch<'a> {
    pub(super) fn new(running: &Running, call: &'a Call, work: &'a Work, turn: &'a Taken) -> Self {
        let now = Instant::now();
        let room = room::left(work.path());
        Self {
            init: running.init,
            program: running.program,
            call,
            work,
            turn,
            next: now,
            last_group: now,
            room,
            n_killed: machine::n_killed(),
            peak: 0,
            cpu: Duration::ZERO,
            idle: Duration::ZERO,
            is_delayed: None,
            is_sure: false,
            least: room,
        }
    }

    /// Inspects the program if it is time to, and returns an outcome if the program exceeds a
    /// limit.
    pub(super) fn look(&mut self) -> Option<Outcome> {
        let now = Instant::now();
        if now < self.next {
            return None;
        }
        self.next = now + EVERY;
        self.peak = self.peak.max(group::high_water(self.program));
        let since = now - self.last_group;
        let n_processes = if since >= GROUP_EVERY { self.look_at_group(now, since) } else { 1 };
        let limits = &self.call.limits;
        match () {
            () if self.peak > limits.memory => Some(Outcome::OutOfMemory),
            () if n_processes > limits.processes as usize => Some(Outcome::TooManyProcesses),
            () if self.is_out_of_cpu() => Some(Outcome::TimedOut(Clock::Cpu)),
            () if self.idle > limits.idle => Some(Outcome::TimedOut(Clock::Idle)),
            () if self.fills_folder() => Some(Outcome::TooMuchOutput(Stream::Files)),
            () => None,
        }
    }

    /// Records what the processes did since the last look, and returns their number.
    fn look_at_group(&mut self, now: Instant, since: Duration) -> usize {
        self.last_group = now;
        self.least = self.least.min(room::left(self.work.path()));
        let seen = group::look(self.init);
        self.peak = self.peak.max(seen.resident);
        let computed = seen.cpu.saturating_sub(self.cpu);
        if seen.n_processes > 0 && !seen.is_active && computed < since / 2 {
            // If a look comes late, the grader itself had to wait, and not all of that time is
            // known to be idle.
            self.idle += since.min(GROUP_EVERY * 2);
        }
        self.cpu = self.cpu.max(seen.cpu);
        self.is_delayed = seen.is_delayed.or(self.is_delayed);
        seen.n_processes
    }

    /// Returns whether the CPU time is used up. A program that others slow down gets twice as much.
    fn is_out_of_cpu(&mut self) -> bool {
        let limits = &self.call.limits;
        if self.cpu > limits.cpu && (self.turn.is_alone() || !self.is_disturbed()) {
            // Others that begin from now on make no difference.
            self.is_sure = true;
        }
        self.is_sure || self.cpu >= limits.cpu_at_most()
    }

    /// Returns whether the program takes more of the disk than it may. The folder is walked only
    /// while the disk fills.
    fn fills_folder(&self) -> bool {
        let limit = self.call.limits.folder_size;
        let is_filling = self.room.bytes.saturating_sub(self.least.bytes) > limit;
        is_filling && room::taken(self.work.path()).exceeds(limit)
    }

    /// Returns the least room on the file system of the work folder that was seen. A folder of a
    /// fixed size always has its own room.
    pub(super) fn least_room(&self) -> Room {
        match self.work.has_fixed_size() {
            true => Room::ALL,
            false => self.least.min(room::left(self.work.path())),
        }
    }

    /// Returns whether the program has filled a folder of a fixed size.
    pub(super) fn has_filled(&self) -> bool {
        let limit = self.call.limits.folder_size;
        self.work.has_fixed_size() && room::taken(self.work.path()).exceeds(limit)
    }

    /// Returns whether other programs may have slowed this one down.
    pub(super) fn is_disturbed(&self) -> bool {
        !self.is_sure && (self.turn.has_overlap() || self.is_delayed.unwrap_or(false))
    }

    /// Returns the number of processes that the system has killed during the run because memory ran
    /// out.
    pub(super) fn n_killed(&self) -> u64 {
        machine::n_killed().saturating_sub(self.n_killed)
    }
}
