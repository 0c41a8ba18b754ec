//! The nanny and the init of a run.

use std::fs;
use std::io::{self, Read};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;

use rustix::process::{DumpableBehavior, Pid, Signal};

use super::filter::Filters;
use super::lines::Lines;
use super::wire::{self, Ended, Failure, Message, Request};
use super::{program, root};
use crate::sandbox::sys;

/// The number that users and groups have inside the namespaces. It is not that of root, so that a
/// program has no rights there once it is executed.
const USER: u32 = 1000;

/// Prepares a run, starts its program, and reports its end.
pub(super) fn run(lines: Lines, filters: &Filters) {
    sys::await_children();
    let Ok(request) = wire::receive::<Request>(&lines.status) else { return };
    let done = match request.layers.namespaces {
        true => apart(&lines, &request, filters),
        false => adopt().and_then(|()| init(&lines, &request, filters, None)),
    };
    if let Err(failure) = done {
        let _ = wire::send(fs::File::from(lines.failure), &failure);
    }
}

/// Runs an init in namespaces of its own, and waits for its end.
fn apart(lines: &Lines, request: &Request, filters: &Filters) -> Result<(), Failure> {
    let step = |why: &io::Error| Failure::of("namespaces", why);
    die_with_parent().map_err(|why| step(&why))?;
    enter().map_err(|why| step(&why))?;
    match sys::fork().map_err(|why| step(&why))? {
        None => {
            die_with_parent().map_err(|why| step(&why))?;
            let work = root::enter(request)?;
            init(lines, request, filters, work)
        }
        Some(init) => {
            // The init alone holds the lines now, so that its end closes them.
            sys::close_all_but(&[]);
            let _ = sys::reap(init);
            sys::exit(0)
        }
    }
}

/// Enters new namespaces of every kind. This process stays in the old namespace of processes; its
/// children are in the new one.
fn enter() -> io::Result<()> {
    let (user, group) = (rustix::process::getuid().as_raw(), rustix::process::getgid().as_raw());
    sys::unshare()?;
    // Without this, an ordinary user may not map a group.
    fs::write("/proc/self/setgroups", "deny")?;
    fs::write("/proc/self/uid_map", format!("{USER} {user} 1"))?;
    fs::write("/proc/self/gid_map", format!("{USER} {group} 1"))
}

/// Makes this process the parent of every process of the program whose own parent has ended.
fn adopt() -> Result<(), Failure> {
    let step = |why: io::Error| Failure::of("the parent of the program", &why);
    die_with_parent().map_err(step)?;
    rustix::process::set_child_subreaper(Pid::from_raw(1)).map_err(|why| step(why.into()))
}

/// Ends this process when its parent ends.
fn die_with_parent() -> io::Result<()> {
    Ok(rustix::process::set_parent_process_death_signal(Some(Signal::KILL))?)
}

/// Starts the program, waits for its end, and reports it. Then waits for the grader to close the
/// socket: until then, the processes that the program has left can be counted. The grader gets
/// `work`, the work folder in memory.
fn init(
    lines: &Lines,
    request: &Request,
    filters: &Filters,
    work: Option<OwnedFd>,
) -> Result<(), Failure> {
    let step = |why: &io::Error| Failure::of("the program", why);
    // Its memory holds the environment of the grader.
    rustix::process::set_dumpable_behavior(DumpableBehavior::NotDumpable)
        .map_err(|why| step(&why.into()))?;
    wire::send_with(&lines.status, &Message::Ready, work).map_err(|why| step(&why))?;
    let Some(program) = sys::fork().map_err(|why| step(&why))? else {
        let failure = program::become_program(lines, request, filters);
        if let Err(failure) = failure {
            let copy = lines.failure.try_clone();
            let _ = copy.and_then(|line| wire::send(fs::File::from(line), &failure));
        }
        sys::exit(0);
    };
    let status = lines.status.try_clone().map_err(|why| step(&why))?;
    sys::close_all_but(&[std::os::fd::AsRawFd::as_raw_fd(&status)]);
    report(&status, program);
    sys::exit(0)
}

fn report(mut status: &UnixStream, program: u32) {
    while let Ok((pid, reaped)) = sys::reap_any() {
        if pid == program {
            let (cpu, max_resident) = (reaped.cpu, reaped.max_resident);
            let ended = Message::Ended(Ended { end: reaped.end, cpu, max_resident });
            let _ = wire::send(status, &ended);
            let _ = status.read(&mut [0]);
            return;
        }
    }
}
