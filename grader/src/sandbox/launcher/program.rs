//! The last steps before a program runs, in its own process. None of them can be undone.

use std::io;
use std::os::unix::process::CommandExt;
use std::process::Command;

use landlock::{
    ABI, Access as _, AccessFs, AccessNet, BitFlags, CompatLevel, Compatible, PathBeneath, PathFd,
    Ruleset, RulesetAttr, RulesetCreatedAttr, RulesetError, Scope,
};

use rustix::process::Signal;

use super::filter::Filters;
use super::lines::Lines;
use super::wire::{self, Failure, Message, Request};
use crate::sandbox::access::{Access, Rights};
use crate::sandbox::sys;

/// The version of Landlock that is demanded: the first one that refuses TCP and signals.
const DEMANDED: ABI = ABI::V6;

/// Executes the program of `request` under its layers. Returns only if that fails, or if there is
/// no program and all layers are in force.
pub(super) fn become_program(
    lines: &Lines,
    request: &Request,
    filters: &Filters,
) -> Result<(), Failure> {
    let step = |name: &'static str| move |why: io::Error| Failure::of(name, &why);
    rustix::process::setpgid(None, None).map_err(|why| step("the process group")(why.into()))?;
    rustix::process::set_parent_process_death_signal(Some(Signal::KILL))
        .map_err(|why| step("the signal of the init's end")(why.into()))?;
    wire::send(&lines.status, &Message::Starting).map_err(step("the report"))?;
    streams(lines).map_err(step("the streams"))?;
    if let Some(start) = &request.program {
        sys::limit(&start.limits).map_err(step("the limits"))?;
    }
    rustix::thread::set_no_new_privs(true).map_err(|why| step("privileges")(why.into()))?;
    if request.layers.landlock {
        restrict(&request.access, request.layers.namespaces).map_err(step("landlock"))?;
    }
    if request.layers.seccomp {
        filters.apply().map_err(step("seccomp"))?;
    }
    let Some(start) = &request.program else { return Ok(()) };
    let why = Command::new(&start.program)
        .args(&start.args)
        .env_clear()
        .envs(start.environment.iter().cloned())
        .current_dir(&start.folder)
        .exec();
    Err(Failure::of_program(&why))
}

fn streams(lines: &Lines) -> io::Result<()> {
    let [stdin, stdout, stderr] = &lines.streams;
    rustix::stdio::dup2_stdin(stdin)?;
    rustix::stdio::dup2_stdout(stdout)?;
    rustix::stdio::dup2_stderr(stderr)?;
    Ok(())
}

/// Restricts this process to `access`. Its own processes, which `/proc` shows, are those of its
/// namespace; without one, it sees itself alone.
fn restrict(access: &[Access], has_namespaces: bool) -> io::Result<()> {
    let build = || -> Result<(), RulesetError> {
        let mut rules = Ruleset::default()
            .set_compatibility(CompatLevel::HardRequirement)
            .handle_access(AccessFs::from_all(DEMANDED))?
            .handle_access(AccessNet::from_all(DEMANDED))?
            .scope(Scope::from_all(DEMANDED))?
            .create()?;
        for Access { path, rights } in access {
            rules = allow(rules, path.as_os_str(), of(*rights, path.is_dir()))?;
        }
        let scratch = AccessFs::from_all(DEMANDED) & !AccessFs::Execute;
        let read = AccessFs::ReadFile | AccessFs::ReadDir;
        let own: &[(&str, BitFlags<AccessFs>)] = match has_namespaces {
            true => &[("/proc", read), ("/tmp", scratch), ("/dev/shm", scratch)],
            false => &[
                ("/proc/self", read),
                ("/proc/meminfo", AccessFs::ReadFile.into()),
                ("/proc/cpuinfo", AccessFs::ReadFile.into()),
                ("/proc/stat", AccessFs::ReadFile.into()),
            ],
        };
        for (path, rights) in own {
            rules = allow(rules, path.as_ref(), *rights)?;
        }
        rules.restrict_self().map(drop)
    };
    build().map_err(io::Error::other)
}

fn allow(
    rules: landlock::RulesetCreated,
    path: &std::ffi::OsStr,
    rights: BitFlags<AccessFs>,
) -> Result<landlock::RulesetCreated, RulesetError> {
    match PathFd::new(path) {
        Ok(fd) => rules.add_rule(PathBeneath::new(fd, rights)),
        Err(_) => Ok(rules), // a path that is not there
    }
}

fn of(rights: Rights, is_folder: bool) -> BitFlags<AccessFs> {
    let all = match rights {
        Rights::Read => AccessFs::ReadFile | AccessFs::ReadDir,
        Rights::Execute => AccessFs::from_read(DEMANDED),
        Rights::Write => AccessFs::from_all(DEMANDED),
        Rights::Device => AccessFs::ReadFile | AccessFs::WriteFile | AccessFs::IoctlDev,
    };
    if is_folder { all } else { all & AccessFs::from_file(DEMANDED) }
}
