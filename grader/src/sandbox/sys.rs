//! The calls to the operating system that std does not offer; the only unsafe code of the grader.
#![allow(unsafe_code)]

use std::io;
use std::os::fd::{AsRawFd, BorrowedFd};
use std::os::unix::process::CommandExt;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::{Granted, Resource};

/// The end of a process that has been reaped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reaped {
    /// Exit code, or the signal that ended it.
    pub(super) end: Result<i32, i32>,
    /// User and system time of the process and of the children that it waited for.
    pub(super) cpu: Duration,
    /// Largest resident bytes; at least those of the grader when it forked.
    pub(super) max_resident: u64,
}

/// Makes the child lead a process group of its own, die with the grader, and run under resource
/// limits.
pub(super) fn limit(command: &mut Command, granted: &[Granted]) {
    let mut all = vec![(libc::RLIMIT_CORE, 0, 0)];
    all.extend(
        granted.iter().map(|granted| (number(granted.resource), granted.allowed, granted.hard)),
    );
    command.process_group(0);
    // SAFETY: the closure runs between fork and exec and makes system calls only: it neither
    // allocates nor locks.
    unsafe {
        command.pre_exec(move || {
            #[cfg(target_os = "linux")]
            if libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL) != 0 {
                return Err(io::Error::last_os_error());
            }
            for (resource, soft, hard) in &all {
                let limit = libc::rlimit { rlim_cur: *soft, rlim_max: *hard };
                if libc::setrlimit(*resource, &limit) != 0 {
                    return Err(io::Error::last_os_error());
                }
            }
            Ok(())
        });
    }
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
type LimitNumber = libc::__rlimit_resource_t;
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
type LimitNumber = libc::c_int;

/// Returns the system's number of the limit on a resource.
fn number(resource: Resource) -> LimitNumber {
    match resource {
        Resource::AddressSpace => libc::RLIMIT_AS,
        Resource::Cpu => libc::RLIMIT_CPU,
        Resource::FileSize => libc::RLIMIT_FSIZE,
        Resource::Descriptors => libc::RLIMIT_NOFILE,
    }
}

/// Returns whether the process has ended. It stays a zombie, so that its number and that of its
/// group are not reused.
pub(super) fn has_ended(pid: u32) -> bool {
    // SAFETY: siginfo_t is plain data, for which zeros are valid.
    let mut info: libc::siginfo_t = unsafe { std::mem::zeroed() };
    let flags = libc::WEXITED | libc::WNOHANG | libc::WNOWAIT;
    // SAFETY: `info` lives through the call.
    let answer = unsafe { libc::waitid(libc::P_PID, pid, &mut info, flags) };
    // SAFETY: waitid filled `info`, or it still holds zeros.
    answer != 0 || unsafe { info.si_pid() } != 0
}

/// Waits for the process, whose group has been killed, and releases its number.
pub(super) fn reap(pid: u32) -> io::Result<Reaped> {
    let mut status = 0;
    // SAFETY: rusage is plain data, for which zeros are valid.
    let mut usage: libc::rusage = unsafe { std::mem::zeroed() };
    loop {
        // SAFETY: both places live through the call.
        if unsafe { libc::wait4(pid.cast_signed(), &mut status, 0, &mut usage) } >= 0 {
            break;
        }
        let why = io::Error::last_os_error();
        if why.kind() != io::ErrorKind::Interrupted {
            return Err(why);
        }
    }
    let end = if libc::WIFEXITED(status) {
        Ok(libc::WEXITSTATUS(status))
    } else {
        Err(libc::WTERMSIG(status))
    };
    let unit = if cfg!(target_os = "macos") { 1 } else { 1024 };
    let max_resident = u64::try_from(usage.ru_maxrss).unwrap_or(0) * unit;
    Ok(Reaped { end, cpu: duration(usage.ru_utime) + duration(usage.ru_stime), max_resident })
}

fn duration(time: libc::timeval) -> Duration {
    let seconds = Duration::from_secs(u64::try_from(time.tv_sec).unwrap_or(0));
    seconds + Duration::from_micros(u64::try_from(time.tv_usec).unwrap_or(0))
}

/// Kills every process of the group, and its leader, which may have moved to another group, such as
/// that of the grader.
pub(super) fn kill_group(group: u32) {
    let leader = group.cast_signed();
    // SAFETY: signals to a child that is not reaped yet, so that its number is still its own, and
    // to the group that bears it.
    unsafe {
        libc::kill(leader, libc::SIGKILL);
        libc::kill(-leader, libc::SIGKILL);
    }
}

/// Returns the size of a page of memory, in bytes.
pub(super) fn page_bytes() -> u64 {
    // SAFETY: the call reads a constant of the system.
    u64::try_from(unsafe { libc::sysconf(libc::_SC_PAGESIZE) }).unwrap_or(4096)
}

/// Returns the number of units in a second in which /proc counts CPU time.
pub(super) fn ticks_per_second() -> u64 {
    // SAFETY: the call reads a constant of the system.
    u64::try_from(unsafe { libc::sysconf(libc::_SC_CLK_TCK) })
        .ok()
        .filter(|ticks| *ticks > 0)
        .unwrap_or(100)
}

/// Makes reads and writes return at once.
pub(super) fn set_nonblocking(fd: &impl AsRawFd) -> io::Result<()> {
    // SAFETY: changes a flag of an open descriptor.
    let done = unsafe {
        let flags = libc::fcntl(fd.as_raw_fd(), libc::F_GETFL);
        libc::fcntl(fd.as_raw_fd(), libc::F_SETFL, flags | libc::O_NONBLOCK)
    };
    if done < 0 { Err(io::Error::last_os_error()) } else { Ok(()) }
}

/// Waits until something can be read from `readers`, written to `writer`, or `timeout` is over.
pub(super) fn wait_for(
    readers: &[BorrowedFd<'_>],
    writer: Option<BorrowedFd<'_>>,
    timeout: Duration,
) {
    let entry =
        |fd: &BorrowedFd<'_>, events| libc::pollfd { fd: fd.as_raw_fd(), events, revents: 0 };
    let mut all: Vec<libc::pollfd> = readers.iter().map(|fd| entry(fd, libc::POLLIN)).collect();
    all.extend(writer.iter().map(|fd| entry(fd, libc::POLLOUT)));
    let milliseconds = i32::try_from(timeout.as_millis()).unwrap_or(i32::MAX);
    // SAFETY: `all` lives through the call and its length is given; the descriptors are borrowed,
    // so they are open.
    unsafe { libc::poll(all.as_mut_ptr(), all.len() as libc::nfds_t, milliseconds) };
}

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Returns whether the user has interrupted the grader. Always `false` before [`catch_signals`].
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

extern "C" fn remember_interrupt(signal: libc::c_int) {
    INTERRUPTED.store(true, Ordering::Relaxed);
    // SAFETY: resetting a handler is allowed within one; a second Ctrl-C then ends us at once.
    unsafe { libc::signal(signal, libc::SIG_DFL) };
}

extern "C" fn go_on(_: libc::c_int) {}

/// Installs the signal handlers. After that, Ctrl-C and SIGTERM end the running programs, and no
/// others are started; a second one ends the grader.
///
/// A write beyond `ulimit -f` then returns an error, and does not end the grader.
pub fn catch_signals() {
    let handlers: [(extern "C" fn(libc::c_int), &[libc::c_int]); 2] =
        [(remember_interrupt, &[libc::SIGINT, libc::SIGTERM]), (go_on, &[libc::SIGXFSZ])];
    for (handler, signals) in handlers {
        for signal in signals {
            // SAFETY: the handlers make calls that are allowed there, or none. Programs that we
            // start do not inherit them.
            unsafe { libc::signal(*signal, handler as libc::sighandler_t) };
        }
    }
}
