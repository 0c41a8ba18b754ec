//! The calls to the operating system that std does not offer; the only unsafe code of the grader.
#![allow(unsafe_code)]

use std::io;
use std::os::fd::{AsFd, AsRawFd, BorrowedFd, OwnedFd};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rustix::process::{Pid, PidfdFlags, Signal};

use super::{Granted, Resource};

/// The end of a process that has been reaped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reaped {
    /// Exit code, or the signal that ended it.
    pub(super) end: Result<i32, i32>,
    /// User and system time of the process and of the children that it waited for.
    pub(super) cpu: Duration,
    /// Largest resident bytes; at least those of the launcher when it was forked.
    pub(super) max_resident: u64,
}

/// Forks this process. Returns the number of the child, or `None` in the child.
///
/// The child has this thread alone. If others held locks, they stay locked: code that runs in a
/// child of a process with several threads must not take one.
pub(super) fn fork() -> io::Result<Option<u32>> {
    // SAFETY: the C library readies its heap for use in the child. The callers keep to the above.
    match unsafe { libc::fork() } {
        0 => Ok(None),
        pid if pid > 0 => Ok(Some(pid.cast_unsigned())),
        _ => Err(io::Error::last_os_error()),
    }
}

/// Ends this process at once, without running destructors.
pub(super) fn exit(code: i32) -> ! {
    // SAFETY: ends the process.
    unsafe { libc::_exit(code) }
}

/// Lets the system forget children that end.
pub(super) fn forget_children() {
    // SAFETY: sets a disposition of the system.
    unsafe { libc::signal(libc::SIGCHLD, libc::SIG_IGN) };
}

/// Keeps children that end until they are reaped.
pub(super) fn await_children() {
    // SAFETY: sets a disposition of the system.
    unsafe { libc::signal(libc::SIGCHLD, libc::SIG_DFL) };
}

/// Closes all descriptors from 3 on, except for `kept`, which are in ascending order. The caller
/// must not use any of them again, nor let one be closed by its owner.
pub(super) fn close_all_but(kept: &[i32]) {
    let mut first = 3;
    for last in kept.iter().map(|fd| fd.cast_unsigned()).chain([u32::MAX]) {
        let until = if last == u32::MAX { last } else { last.saturating_sub(1) };
        if first <= until {
            // SAFETY: closes descriptors that nothing uses after this, as the caller has promised.
            unsafe { libc::syscall(libc::SYS_close_range, first, until, 0) };
        }
        first = last.saturating_add(1);
    }
}

/// Enters new namespaces of every kind.
pub(super) fn unshare() -> io::Result<()> {
    let all = libc::CLONE_NEWUSER
        | libc::CLONE_NEWPID
        | libc::CLONE_NEWNS
        | libc::CLONE_NEWNET
        | libc::CLONE_NEWIPC
        | libc::CLONE_NEWUTS;
    // SAFETY: changes the namespaces of a process with one thread; no memory or descriptor is
    // unshared.
    if unsafe { libc::unshare(all) } == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
}

/// Returns the system's numbers of limits, each with its soft and its hard value.
pub(super) fn numbers(granted: &[Granted]) -> Vec<(u32, u64, u64)> {
    let of = |granted: &Granted| (number(granted.resource), granted.allowed, granted.hard);
    std::iter::once((libc::RLIMIT_CORE, 0, 0)).chain(granted.iter().map(of)).collect()
}

/// Limits this process.
pub(super) fn limit(numbers: &[(u32, u64, u64)]) -> io::Result<()> {
    for (resource, soft, hard) in numbers {
        let limit = libc::rlimit { rlim_cur: *soft, rlim_max: *hard };
        // SAFETY: `limit` lives through the call.
        if unsafe { libc::setrlimit(*resource, &limit) } != 0 {
            return Err(io::Error::last_os_error());
        }
    }
    Ok(())
}

/// Returns the system's number of the limit on a resource.
fn number(resource: Resource) -> u32 {
    match resource {
        Resource::AddressSpace => libc::RLIMIT_AS,
        Resource::Cpu => libc::RLIMIT_CPU,
        Resource::FileSize => libc::RLIMIT_FSIZE,
        Resource::Descriptors => libc::RLIMIT_NOFILE,
    }
}

/// Waits for the end of a child.
pub(super) fn reap(pid: u32) -> io::Result<Reaped> {
    wait(pid.cast_signed()).map(|(_, reaped)| reaped)
}

/// Waits for the end of any child, and returns its number.
pub(super) fn reap_any() -> io::Result<(u32, Reaped)> {
    wait(-1)
}

fn wait(pid: libc::pid_t) -> io::Result<(u32, Reaped)> {
    let mut status = 0;
    // SAFETY: rusage is plain data, for which zeros are valid.
    let mut usage: libc::rusage = unsafe { std::mem::zeroed() };
    let pid = loop {
        // SAFETY: both places live through the call.
        let pid = unsafe { libc::wait4(pid, &mut status, 0, &mut usage) };
        if pid >= 0 {
            break pid.cast_unsigned();
        }
        let why = io::Error::last_os_error();
        if why.kind() != io::ErrorKind::Interrupted {
            return Err(why);
        }
    };
    let end = if libc::WIFEXITED(status) {
        Ok(libc::WEXITSTATUS(status))
    } else {
        Err(libc::WTERMSIG(status))
    };
    let max_resident = u64::try_from(usage.ru_maxrss).unwrap_or(0) * 1024;
    let cpu = duration(usage.ru_utime) + duration(usage.ru_stime);
    Ok((pid, Reaped { end, cpu, max_resident }))
}

fn duration(time: libc::timeval) -> Duration {
    let seconds = Duration::from_secs(u64::try_from(time.tv_sec).unwrap_or(0));
    seconds + Duration::from_micros(u64::try_from(time.tv_usec).unwrap_or(0))
}

/// Kills a process.
pub(super) fn kill(pid: u32) {
    // SAFETY: sends a signal. The caller knows that the number is still that of the process.
    unsafe { libc::kill(pid.cast_signed(), libc::SIGKILL) };
}

/// Kills the process group that a program led a moment ago.
pub(super) fn kill_group(group: u32) {
    // SAFETY: sends a signal to a group whose number is never 0 or 1.
    unsafe { libc::kill(-group.cast_signed(), libc::SIGKILL) };
}

/// A process that is not a child of this one. Its number may be that of another process once it has
/// ended; this is not.
#[derive(Debug)]
pub(super) struct ProcessHandle(Option<OwnedFd>);

impl ProcessHandle {
    /// Returns the process that has this number now. It is empty if there is none.
    pub(super) fn of(pid: u32) -> Self {
        let pid = Pid::from_raw(pid.cast_signed());
        Self(pid.and_then(|pid| rustix::process::pidfd_open(pid, PidfdFlags::empty()).ok()))
    }

    /// Returns whether the process has ended.
    pub(super) fn has_ended(&self) -> bool {
        self.0.as_ref().is_none_or(|fd| is_readable(fd.as_fd(), Duration::ZERO))
    }

    /// Kills the process, and waits until it and its namespace are gone.
    pub(super) fn kill(&self) {
        let Some(fd) = &self.0 else { return };
        let _ = rustix::process::pidfd_send_signal(fd, Signal::KILL);
        is_readable(fd.as_fd(), Duration::from_secs(10));
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

/// Waits at most `timeout` until something can be read, or the other side is gone. Returns whether
/// that is so.
pub(super) fn is_readable(fd: BorrowedFd<'_>, timeout: Duration) -> bool {
    let mut entry = libc::pollfd { fd: fd.as_raw_fd(), events: libc::POLLIN, revents: 0 };
    let end = Instant::now() + timeout;
    loop {
        let left = end.saturating_duration_since(Instant::now());
        let milliseconds = i32::try_from(left.as_millis()).unwrap_or(i32::MAX);
        // SAFETY: `entry` lives through the call; the descriptor is borrowed, so it is open.
        let n = unsafe { libc::poll(&mut entry, 1, milliseconds) };
        if n > 0 || (n == 0 && Instant::now() >= end) {
            return n > 0;
        }
    }
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
