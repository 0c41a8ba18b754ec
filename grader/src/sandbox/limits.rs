//! Limits of programs, and how far the limits of the grader's own process lower them.

use std::fmt;
use std::time::Duration;

use rustix::process::{Resource as System, getrlimit};

/// Open files that a program may have.
const DESCRIPTORS: u64 = 256;

/// Open files that are enough for any honest program. With fewer, a failure may be the machine's.
const FEWEST_DESCRIPTORS: u64 = 64;

/// The limits of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// CPU time, summed over all processes of the program.
    pub cpu: Duration,
    /// Time during which no process of the program runs, is ready to run, or waits for a disk.
    pub idle: Duration,
    /// Wall time. Only programs that neither of the other two limits stops run into it.
    pub wall: Duration,
    /// Resident bytes of the whole group; the address space is bounded to four times as much.
    pub memory: u64,
    /// Bytes of one file.
    pub file_size: u64,
    /// Bytes of all files that the program leaves in its work folder.
    pub folder_size: u64,
    /// Bytes on standard output, and as many on standard error.
    pub output: u64,
    /// Processes of the group, threads not counted.
    pub processes: u32,
}

impl Limits {
    /// Returns these limits with `cpu` of CPU time, and idle and wall time derived from it.
    ///
    /// The idle time is half of `cpu`, but at least 1 s. The wall time is 10 s more than six times
    /// `cpu`.
    pub fn with_time(self, cpu: Duration) -> Self {
        Self {
            cpu,
            idle: (cpu / 2).max(Duration::from_secs(1)),
            wall: cpu * 6 + Duration::from_secs(10),
            ..self
        }
    }

    /// Returns the CPU time after which a program is stopped even where others slow it down, in
    /// whole seconds.
    ///
    /// Programs that run side by side share caches and the units of a core, so the same work takes
    /// more CPU time there: up to twice as much, as measured. Between [`Limits::cpu`] and this
    /// time, only a run without others decides.
    pub fn cpu_at_most(&self) -> Duration {
        Duration::from_secs((self.cpu * 2).as_secs_f64().ceil().max(1.0) as u64)
    }

    /// Returns the system's limits for a program. None exceeds the hard limit of this process,
    /// which `hard` returns.
    ///
    /// The limit of CPU time is a second line of defence. The system compares it with a clock that
    /// runs up to a tenth fast on a busy machine, so the grader stops programs itself.
    fn within(&self, hard: impl Fn(Resource) -> Option<u64>) -> Vec<Granted> {
        let wanted = [
            (Resource::AddressSpace, self.memory.saturating_mul(4), self.memory),
            (Resource::Cpu, self.cpu_at_most().as_secs() * 5 / 4 + 1, self.cpu.as_secs()),
            (Resource::FileSize, self.file_size, self.file_size),
            (Resource::Descriptors, DESCRIPTORS, FEWEST_DESCRIPTORS),
        ];
        wanted
            .map(|(resource, wanted, least)| Granted::new(resource, wanted, least, hard(resource)))
            .to_vec()
    }

    /// Returns the system's limits for a program that this process starts.
    pub(super) fn granted(&self) -> Vec<Granted> {
        self.within(hard_limit)
    }

    /// Returns the limits of this process that leave a program less than it may use.
    pub fn lowered(&self) -> Vec<Granted> {
        self.granted().into_iter().filter(Granted::is_lowered).collect()
    }
}

/// A resource that the system limits for each process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resource {
    /// Bytes of address space.
    AddressSpace,
    /// Seconds of CPU time.
    Cpu,
    /// Bytes of one file.
    FileSize,
    /// Open files.
    Descriptors,
}

/// The amount of a resource that a program is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Granted {
    /// The resource.
    pub resource: Resource,
    /// The amount that the program should be given.
    pub wanted: u64,
    /// The amount that it is given, which is no more than the hard limit of this process.
    pub allowed: u64,
    /// Whether the allowed amount is enough for a program that keeps to its limits.
    pub is_enough: bool,
    /// The amount at which the system kills the program, rather than sends a signal that names the
    /// reason.
    pub(super) hard: u64,
}

impl Granted {
    fn new(resource: Resource, wanted: u64, least: u64, hard: Option<u64>) -> Self {
        let most = hard.unwrap_or(u64::MAX);
        let allowed = wanted.min(most);
        // At the soft limit of CPU time a signal says why the program ends; a second later it is
        // killed.
        let grace = u64::from(resource == Resource::Cpu);
        Self {
            resource,
            wanted,
            allowed,
            is_enough: allowed >= least,
            hard: (wanted + grace).min(most),
        }
    }

    fn is_lowered(&self) -> bool {
        self.allowed < self.wanted
    }
}

impl fmt::Display for Granted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { wanted, allowed, .. } = self;
        match self.resource {
            Resource::AddressSpace => {
                let (wanted, allowed) = (wanted >> 20, allowed >> 20);
                write!(f, "{allowed} MiB of address space, not {wanted} (ulimit -v)")
            }
            Resource::Cpu => write!(f, "{allowed} s of CPU time, not {wanted} (ulimit -t)"),
            Resource::FileSize => {
                let (wanted, allowed) = (wanted >> 10, allowed >> 10);
                write!(f, "{allowed} KiB in a file, not {wanted} (ulimit -f)")
            }
            Resource::Descriptors => write!(f, "{allowed} open files, not {wanted} (ulimit -n)"),
        }
    }
}

/// Returns the hard limit of this process, or `None` if there is none.
fn hard_limit(resource: Resource) -> Option<u64> {
    let system = match resource {
        Resource::AddressSpace => System::As,
        Resource::Cpu => System::Cpu,
        Resource::FileSize => System::Fsize,
        Resource::Descriptors => System::Nofile,
    };
    getrlimit(system).maximum
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        cpu: Duration::from_secs(10),
        idle: Duration::from_secs(5),
        wall: Duration::from_secs(40),
        memory: 1 << 30,
        file_size: 64 << 20,
        folder_size: 256 << 20,
        output: 1 << 20,
        processes: 4,
    };

    /// Checks the soft and hard limit of programs if `hard` is the hard limit of this process on
    /// `resource`.
    fn check(resource: Resource, hard: Option<u64>, soft_and_hard: (u64, u64), is_enough: bool) {
        let all = LIMITS.within(|other| hard.filter(|_| other == resource));
        let granted = all.iter().find(|granted| granted.resource == resource).unwrap();
        assert_eq!((granted.allowed, granted.hard), soft_and_hard, "{resource:?} {hard:?}");
        assert_eq!(granted.is_enough, is_enough, "{resource:?} {hard:?}");
        let lowered = all.iter().filter(|granted| granted.is_lowered()).count();
        assert_eq!(lowered, usize::from(granted.allowed < granted.wanted), "{resource:?} {hard:?}");
    }

    #[test]
    fn no_limit_is_above_the_hard_one() {
        check(Resource::AddressSpace, None, (4 << 30, 4 << 30), true);
        check(Resource::AddressSpace, Some(3 << 30), (3 << 30, 3 << 30), true);
        check(Resource::AddressSpace, Some(1 << 29), (1 << 29, 1 << 29), false);
        check(Resource::Cpu, None, (26, 27), true);
        check(Resource::Cpu, Some(15), (15, 15), true);
        check(Resource::Cpu, Some(12), (12, 12), true);
        check(Resource::Cpu, Some(9), (9, 9), false);
        check(Resource::FileSize, Some(1 << 40), (64 << 20, 64 << 20), true);
        check(Resource::FileSize, Some(1 << 20), (1 << 20, 1 << 20), false);
        check(Resource::Descriptors, Some(20_000), (256, 256), true);
        check(Resource::Descriptors, Some(200), (200, 200), true);
        check(Resource::Descriptors, Some(20), (20, 20), false);
    }

    #[test]
    fn times_follow_from_cpu_time() {
        for (cpu, at_most, idle, wall) in
            [(1, 2, 1, 16), (2, 4, 1, 22), (10, 20, 5, 70), (300, 600, 150, 1810)]
        {
            let limits = LIMITS.with_time(Duration::from_secs(cpu));
            let found = [limits.cpu_at_most(), limits.idle, limits.wall].map(|time| time.as_secs());
            assert_eq!(found, [at_most, idle, wall], "{cpu} s");
        }
    }

    #[test]
    fn a_lowered_limit_says_how_to_raise_it() {
        let text = Granted::new(Resource::Descriptors, 256, 64, Some(200)).to_string();
        assert_eq!(text, "200 open files, not 256 (ulimit -n)");
    }
}
