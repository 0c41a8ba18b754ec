//! Writes programs, and starts programs, never both at once.
//!
//! The system refuses to start a file that is open for writing. A child that another thread forks
//! holds a copy of every open file until it runs its own program. If the grader writes an
//! executable file at that moment, the file cannot be started until then.

use std::fs::File;
use std::io::{self, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::sync::{PoisonError, RwLock};

use super::call::Call;
use super::launcher::wire::Failure;
use super::launcher::{self, Running};
use crate::leftovers;

static STARTING: RwLock<()> = RwLock::new(());

/// Removes whatever is at `path`, and writes an executable file there.
///
/// # Errors
/// Fails if the file system does.
pub fn place_program(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let _none_starts = STARTING.write().unwrap_or_else(PoisonError::into_inner);
    match leftovers::remove(path) {
        Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why),
        _ => {}
    }
    let mut file = File::create_new(path)?;
    file.write_all(bytes)?;
    file.set_permissions(PermissionsExt::from_mode(0o755))
}

/// Starts a program.
pub(super) fn start(call: &Call) -> Result<Running, Failure> {
    let _none_is_written = STARTING.read().unwrap_or_else(PoisonError::into_inner);
    launcher::start(call)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sandbox::tests::{SMALL, line};
    use crate::sandbox::{Outcome, Turn, run};

    #[test]
    fn programs_start_while_others_are_written() {
        let home = tempfile::tempdir().unwrap();
        let bytes = std::fs::read("/bin/true").unwrap();
        let write_and_start = |n: usize| {
            for turn in 0..20 {
                let path = home.path().join(format!("{n}-{turn}"));
                place_program(&path, &bytes).unwrap();
                let call = Call { program: path, args: vec![], ..line("", home.path(), SMALL) };
                assert_eq!(run(&call, Turn::Shared).0.outcome, Outcome::Exited(0));
            }
        };
        std::thread::scope(|scope| {
            (0..4).for_each(|n| drop(scope.spawn(move || write_and_start(n))))
        });
    }
}
