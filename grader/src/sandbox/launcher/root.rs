//! The root folder of a program: a file system in memory, in which only what the program needs is
//! bound.

use std::ffi::CString;
use std::fs::{self, File};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use rustix::fs::StatVfsMountFlags;
use rustix::mount::{
    MountFlags, MountPropagationFlags, UnmountFlags, mount, mount_bind_recursive, mount_change,
    mount_remount, unmount,
};

use super::wire::{Failure, Request};
use crate::sandbox::access::{Access, Rights};

/// The folder on which the new root is built. What lies below it in the old root cannot be bound,
/// and nothing is.
const BASE: &str = "/proc";
/// Folders for files that programs share or throw away. Each is a file system in memory.
const SCRATCH: [&str; 2] = ["dev/shm", "tmp"];
/// The size of one of them, and of the root folder.
const SCRATCH_OPTIONS: &std::ffi::CStr = c"size=64m,mode=1777";
const ROOT_OPTIONS: &std::ffi::CStr = c"size=1m,mode=755";
/// The number of files that a work folder in memory can hold, which is more than any honest program
/// makes.
const MOST_FILES: u64 = 100_000;
/// Names in the root folder that are links on most systems.
const LINKS: [&str; 6] = ["bin", "lib", "lib32", "lib64", "libx32", "sbin"];
const DEVICE_LINKS: [(&str, &str); 4] = [
    ("dev/fd", "/proc/self/fd"),
    ("dev/stderr", "/proc/self/fd/2"),
    ("dev/stdin", "/proc/self/fd/0"),
    ("dev/stdout", "/proc/self/fd/1"),
];

/// Makes a root folder with the paths of `request` alone, and enters it. The old one is out of
/// reach then. Returns the work folder, if it is in memory.
pub(super) fn enter(request: &Request) -> Result<Option<OwnedFd>, Failure> {
    let step = |what: &'static str| move |why: io::Error| Failure::of(what, &why);
    let work = build(request)?;
    pivot().map_err(step("the new root folder"))?;
    Ok(work)
}

fn build(request: &Request) -> Result<Option<OwnedFd>, Failure> {
    let step = |what: &'static str| move |why: io::Error| Failure::of(what, &why);
    let base = Path::new(BASE);
    let private = MountPropagationFlags::PRIVATE | MountPropagationFlags::REC;
    mount_change("/", private).map_err(|why| step("the mounts")(why.into()))?;
    let in_memory = |at: &Path, options: &std::ffi::CStr| -> io::Result<()> {
        fs::create_dir_all(at)?;
        Ok(mount("tmpfs", at, "tmpfs", MountFlags::NOSUID | MountFlags::NODEV, options)?)
    };
    in_memory(base, ROOT_OPTIONS).map_err(step("a file system in memory"))?;
    for name in SCRATCH {
        in_memory(&base.join(name), SCRATCH_OPTIONS).map_err(step("a file system in memory"))?;
    }
    let work = request.in_memory.as_ref().map(|(path, size)| work_folder(base, path, *size));
    let work = work.transpose().map_err(step("the work folder"))?;
    for one in &request.access {
        let path = request.in_memory.as_ref().map(|(path, _)| path);
        bind(base, one, path.filter(|_| one.rights == Rights::Write))
            .map_err(|why| Failure::of(format!("binding {}", one.path.display()), &why))?;
    }
    links(base).map_err(step("links"))?;
    let proc = base.join("proc");
    let flags = MountFlags::NOSUID | MountFlags::NODEV | MountFlags::NOEXEC;
    fs::create_dir(&proc).map_err(step("/proc"))?;
    // The init is hidden, with the command line of the grader.
    mount("proc", &proc, "proc", flags, c"hidepid=4").map_err(|why| step("/proc")(why.into()))?;
    let read_only = MountFlags::BIND | MountFlags::RDONLY | MountFlags::NOSUID | MountFlags::NODEV;
    mount_remount(base, read_only, "").map_err(|why| step("the new root folder")(why.into()))?;
    Ok(work)
}

/// Mounts a file system in memory of `size` bytes where the program finds the folder `path`, with
/// copies of the files in that folder, and opens it.
fn work_folder(base: &Path, path: &Path, size: u64) -> io::Result<OwnedFd> {
    let at = below(base, path);
    fs::create_dir_all(&at)?;
    let options = CString::new(format!("size={size},nr_inodes={MOST_FILES},mode=700"))?;
    mount("tmpfs", &at, "tmpfs", MountFlags::NOSUID | MountFlags::NODEV, &*options)?;
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            fs::copy(entry.path(), at.join(entry.file_name()))?;
        }
    }
    Ok(File::open(&at)?.into())
}

/// Binds a path at the same place below `base`, read-only unless the program may write there. The
/// folder `in_memory` is there already; another name of it leads to it as well.
fn bind(base: &Path, one: &Access, in_memory: Option<&PathBuf>) -> io::Result<()> {
    let Access { path, rights } = one;
    let at = below(base, path);
    let made = in_memory.filter(|work| path.canonicalize().is_ok_and(|path| path == **work));
    if let Some(work) = made {
        let from = below(base, work);
        if from != at {
            fs::create_dir_all(&at)?;
            mount_bind_recursive(from, &at)?;
        }
        return Ok(());
    }
    if path.is_dir() {
        fs::create_dir_all(&at)?;
    } else if !at.exists() {
        fs::create_dir_all(at.parent().unwrap_or(base))?;
        File::create(&at)?;
    }
    mount_bind_recursive(path, &at)?;
    if matches!(rights, Rights::Read | Rights::Execute) {
        mount_remount(&at, MountFlags::BIND | MountFlags::RDONLY | kept(&at)?, "")?;
    }
    Ok(())
}

fn below(base: &Path, path: &Path) -> PathBuf {
    base.join(path.strip_prefix("/").unwrap_or(path))
}

/// Returns the flags of a mount that a user namespace may not remove.
fn kept(at: &Path) -> io::Result<MountFlags> {
    let found = rustix::fs::statvfs(at)?.f_flag;
    let pairs = [
        (StatVfsMountFlags::NOSUID, MountFlags::NOSUID),
        (StatVfsMountFlags::NODEV, MountFlags::NODEV),
        (StatVfsMountFlags::NOEXEC, MountFlags::NOEXEC),
        (StatVfsMountFlags::NOATIME, MountFlags::NOATIME),
        (StatVfsMountFlags::NODIRATIME, MountFlags::NODIRATIME),
        (StatVfsMountFlags::RELATIME, MountFlags::RELATIME),
    ];
    let is_set = |(of, _): &&(StatVfsMountFlags, MountFlags)| found.contains(*of);
    Ok(pairs.iter().filter(is_set).fold(MountFlags::empty(), |all, (_, flag)| all | *flag))
}

fn links(base: &Path) -> io::Result<()> {
    for name in LINKS {
        if let Ok(to) = fs::read_link(Path::new("/").join(name)) {
            symlink(to, base.join(name))?;
        }
    }
    DEVICE_LINKS.iter().try_for_each(|(name, to)| symlink(to, base.join(name)))
}

fn pivot() -> io::Result<()> {
    rustix::process::chdir(BASE)?;
    rustix::process::pivot_root(".", ".")?;
    unmount(".", UnmountFlags::DETACH)?;
    Ok(rustix::process::chdir("/")?)
}
