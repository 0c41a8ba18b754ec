//! The calls to the operating system that std does not offer; the only unsafe code of the grader.
#![allow(unsafe_code)]

use std::io;
use std::os::fd::{AsRawFd, BorrowedFd};
use std::os::unix::process::CommandExt;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::Limits;

/// How a reaped process ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reaped {
    /// Exit code, or the signal that ended it.
    pub(super) end: Result<i32, i32>,
    /// User and system time of it and of what it waited for.
    pub(super) cpu: Duration,
    /// Largest resident bytes; at least those of the grader when it forked.
    pub(super) max_resident: u64,
}

/// Makes the child lead a group of its own, die with us, and live under resource limits.
pub(super) fn limit(command: &mut Command, limits: &Limits) {
    let cpu = limits.cpu.as_secs().max(1);
    let all = [
        (libc::RLIMIT_AS, limits.memory.saturating_mul(4), limits.memory.saturating_mul(4)),
        (libc::RLIMIT_CPU, cpu, cpu + 1),
        (libc::RLIMIT_FSIZE, limits.file_size, limits.file_size),
        (libc::RLIMIT_CORE, 0, 0),
        (libc::RLIMIT_NOFILE, 256, 256),
    ];
    command.process_group(0);
    // SAFETY: the closure runs between fork and exec and makes system calls only: it neither allocates nor locks.
    unsafe {
        command.pre_exec(move || {
            #[cfg(target_os = "linux")]
            if libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL) != 0 {
                return Err(io::Error::last_os_error());
            }
            for (resource, soft, hard) in all {
                let limit = libc::rlimit { rlim_cur: soft, rlim_max: hard };
                if libc::setrlimit(resource, &limit) != 0 {
                    return Err(io::Error::last_os_error());
                }
            }
            Ok(())
        });
    }
}

/// Whether the process has ended; it stays a zombie, so that its number and its group's are not given away.
pub(super) fn has_ended(pid: u32) -> bool {
    // SAFETY: siginfo_t is plain data, for which zeros are valid.
    let mut info: libc::siginfo_t = unsafe { std::mem::zeroed() };
    let flags = libc::WEXITED | libc::WNOHANG | libc::WNOWAIT;
    // SAFETY: `info` lives through the call.
    let answer = unsafe { libc::waitid(libc::P_PID, pid, &mut info, flags) };
    // SAFETY: waitid filled `info`, or it still holds zeros.
    answer != 0 || unsafe { info.si_pid() } != 0
}

/// Waits for the process, whose group has been killed.
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
    let end = if libc::WIFEXITED(status) { Ok(libc::WEXITSTATUS(status)) } else { Err(libc::WTERMSIG(status)) };
    let unit = if cfg!(target_os = "macos") { 1 } else { 1024 };
    let max_resident = u64::try_from(usage.ru_maxrss).unwrap_or(0) * unit;
    Ok(Reaped { end, cpu: duration(usage.ru_utime) + duration(usage.ru_stime), max_resident })
}

fn duration(time: libc::timeval) -> Duration {
    let seconds = Duration::from_secs(u64::try_from(time.tv_sec).unwrap_or(0));
    seconds + Duration::from_micros(u64::try_from(time.tv_usec).unwrap_or(0))
}

/// Kills every process of the group, and its leader wherever that is: it may have moved to another group, ours for one.
pub(super) fn kill_group(group: u32) {
    let leader = group.cast_signed();
    // SAFETY: signals to a child that is not reaped yet, so that its number is still its own, and to the group that bears it.
    unsafe {
        libc::kill(leader, libc::SIGKILL);
        libc::kill(-leader, libc::SIGKILL);
    }
}

/// Bytes of a page of memory.
pub(super) fn page_bytes() -> u64 {
    // SAFETY: asks for a constant of the system.
    u64::try_from(unsafe { libc::sysconf(libc::_SC_PAGESIZE) }).unwrap_or(4096)
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
pub(super) fn wait_for(readers: &[BorrowedFd<'_>], writer: Option<BorrowedFd<'_>>, timeout: Duration) {
    let entry = |fd: &BorrowedFd<'_>, events| libc::pollfd { fd: fd.as_raw_fd(), events, revents: 0 };
    let mut all: Vec<libc::pollfd> = readers.iter().map(|fd| entry(fd, libc::POLLIN)).collect();
    all.extend(writer.iter().map(|fd| entry(fd, libc::POLLOUT)));
    let milliseconds = i32::try_from(timeout.as_millis()).unwrap_or(i32::MAX);
    // SAFETY: `all` lives through the call and its length is given; the descriptors are borrowed, so they are open.
    unsafe { libc::poll(all.as_mut_ptr(), all.len() as libc::nfds_t, milliseconds) };
}

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether the user has asked to stop (see [`catch_interrupts`]).
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

extern "C" fn remember_interrupt(signal: libc::c_int) {
    INTERRUPTED.store(true, Ordering::Relaxed);
    // SAFETY: resetting a handler is allowed within one; a second Ctrl-C then ends us at once.
    unsafe { libc::signal(signal, libc::SIG_DFL) };
}

/// From now on Ctrl-C and SIGTERM end the running programs and no others are started; a second one ends the grader.
pub fn catch_interrupts() {
    let handler = remember_interrupt as extern "C" fn(libc::c_int) as libc::sighandler_t;
    for signal in [libc::SIGINT, libc::SIGTERM] {
        // SAFETY: the handler stores to an atomic and calls signal(), both of which are allowed there.
        unsafe { libc::signal(signal, handler) };
    }
}
