//! The files that exist for a program: its own, its work folder, and what programs need of the
//! system.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// What a program may do with a file, or with everything in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Rights {
    /// Read, and list folders.
    Read,
    /// Read, and execute.
    Execute,
    /// Everything.
    Write,
    /// Read and write the device.
    Device,
}

/// A path that exists for a program.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Access {
    /// The path.
    pub path: PathBuf,
    /// The rights on it and on everything below.
    pub rights: Rights,
}

impl Access {
    /// Returns the right to read and to execute.
    pub fn execute(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), rights: Rights::Execute }
    }
}

/// Programs, libraries and interpreters of the system.
const PROGRAMS: [&str; 10] = [
    "/bin",
    "/gnu/store",
    "/lib",
    "/lib32",
    "/lib64",
    "/libx32",
    "/nix/store",
    "/opt",
    "/sbin",
    "/usr",
];
/// What the dynamic linker, C libraries and runtimes read. `/etc` as a whole names users and
/// machines.
const SETTINGS: [&str; 10] = [
    "/etc/alternatives",
    "/etc/ld.so.cache",
    "/etc/ld.so.conf",
    "/etc/ld.so.conf.d",
    "/etc/localtime",
    "/etc/ssl/openssl.cnf",
    "/sys/devices/system/cpu",
    "/sys/devices/system/node",
    "/sys/fs/cgroup",
    "/sys/kernel/mm/transparent_hugepage",
];
/// Beginnings of names in `/etc` of the settings of runtimes, whose names have a version.
const VERSIONED: [&str; 2] = ["java", "python3"];
const DEVICES: [&str; 5] = ["/dev/full", "/dev/null", "/dev/random", "/dev/urandom", "/dev/zero"];

/// Returns the paths of the system, those of `own`, and `folder` with the right to write. Paths
/// that do not exist are left out. Links in paths of the system are resolved; the new root has the
/// usual ones itself. A path of `own` is listed as it is given too, since programs use it so.
pub(super) fn list(own: &[Access], folder: &Path) -> Vec<Access> {
    let of = |rights| move |path: &&str| Access { path: path.into(), rights };
    let versioned = std::fs::read_dir("/etc").into_iter().flatten().flatten();
    let versioned = versioned.filter(|entry| {
        VERSIONED
            .iter()
            .any(|begin| entry.file_name().as_encoded_bytes().starts_with(begin.as_bytes()))
    });
    let of_system = PROGRAMS
        .iter()
        .map(of(Rights::Execute))
        .chain(SETTINGS.iter().map(of(Rights::Read)))
        .chain(versioned.map(|entry| Access { path: entry.path(), rights: Rights::Read }))
        .chain(DEVICES.iter().map(of(Rights::Device)));
    let work = Access { path: folder.to_owned(), rights: Rights::Write };
    let given: Vec<Access> = own.iter().cloned().chain([work]).collect();
    let as_given = given.iter().filter(|one| one.path.is_absolute() && one.path.exists()).cloned();
    let resolved =
        |Access { path, rights }: Access| Some(Access { path: path.canonicalize().ok()?, rights });
    let mut found: Vec<Access> =
        of_system.chain(given.iter().cloned()).filter_map(resolved).chain(as_given).collect();
    found.sort();
    found.dedup();
    found
}

/// Names beside `bin` or `shims` of what interpreters read. Other files there may be secrets, such
/// as the credentials in `~/.cargo`.
const BESIDE: [&str; 12] = [
    "bin", "conf", "include", "installs", "lib", "lib32", "lib64", "libexec", "plugins", "shims",
    "version", "versions",
];

/// Returns the folders of `search`, a value of PATH, in which interpreters lie that are not the
/// system's, such as those of pyenv or nvm. Beside `X/bin` and `X/shims`, the libraries in X are
/// listed too, unless X is the root folder or the user's home.
///
/// A folder that holds the grader is left out: the reference may lie beside it.
pub fn interpreters(search: &OsStr) -> Vec<Access> {
    let home = std::env::var_os("HOME").and_then(|home| Path::new(&home).canonicalize().ok());
    let grader = std::env::current_exe().and_then(|path| path.canonicalize()).ok();
    interpreters_but(search, home.as_deref(), grader.as_deref())
}

fn interpreters_but(search: &OsStr, home: Option<&Path>, grader: Option<&Path>) -> Vec<Access> {
    let is_of_system = |path: &Path| PROGRAMS.iter().any(|known| path.starts_with(known));
    std::env::split_paths(search)
        .filter_map(|path| path.canonicalize().ok().filter(|path| path.is_dir()))
        .filter(|path| !is_of_system(path))
        .flat_map(|path| match path.parent() {
            Some(above)
                if (path.ends_with("bin") || path.ends_with("shims"))
                    && above != Path::new("/")
                    && Some(above) != home =>
            {
                BESIDE.iter().map(|name| above.join(name)).filter(|path| path.exists()).collect()
            }
            _ => vec![path],
        })
        .filter(|path| !grader.is_some_and(|grader| grader.starts_with(path)))
        .map(Access::execute)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_users_is_on_the_list() {
        let folder = tempfile::tempdir().unwrap();
        let all = list(&[Access::execute("/nowhere")], folder.path());
        let is_open = |path: &str| all.iter().any(|one| Path::new(path).starts_with(&one.path));
        assert!(is_open("/usr/bin/env") && is_open("/dev/null"));
        for path in ["/etc/passwd", "/srv/x", "/proc/1", "/var/log", "/tmp/other", "/nowhere"] {
            assert!(!is_open(path), "{path}");
        }
        let writes = all.iter().filter(|one| one.rights == Rights::Write);
        let path = folder.path().canonicalize().unwrap();
        assert_eq!(writes.map(|one| &one.path).collect::<Vec<_>>(), [&path]);
    }

    #[test]
    fn interpreters_bring_their_libraries_and_no_secret_home_or_grader() {
        let home = tempfile::tempdir().unwrap();
        let home = home.path().canonicalize().unwrap();
        for folder in ["bin", "py/bin", "py/lib", "py/share", "tools", "work/target/bin"] {
            std::fs::create_dir_all(home.join(folder)).unwrap();
        }
        std::fs::write(home.join("py/credentials.toml"), "a secret").unwrap();
        let search = ["bin", "py/bin", "tools", "work/target/bin", "missing"];
        let search = std::env::join_paths(
            search.iter().map(|name| home.join(name)).chain(["/usr/bin".into()]),
        );
        let grader = home.join("work/target/bin/grader");
        let found = interpreters_but(&search.unwrap(), Some(&home), Some(&grader));
        let paths: Vec<PathBuf> = found.into_iter().map(|one| one.path).collect();
        assert_eq!(paths, ["bin", "py/bin", "py/lib", "tools"].map(|name| home.join(name)));
    }
}
