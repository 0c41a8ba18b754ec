//! Programs that answer the calls of the protocol.

use std::ffi::OsString;
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::entry::Entry;
use super::error::Fault;
use crate::sandbox::{self, Access, Folder};
use crate::submission::Language;

/// The name of the program's file in its entry of the store.
pub(super) const PROGRAM: &str = "program";

/// A program in the store, with the compiler's warnings as its description.
pub(super) type Stored = Entry<Vec<String>>;

/// A program, and the result of its build.
#[derive(Debug)]
pub struct Built {
    /// The program.
    pub program: Program,
    /// The language of the template that the program is made from, if it is made from one.
    pub template: Option<Language>,
    /// The compiler's warnings.
    pub warnings: Vec<String>,
    /// The wall time of the build, which is zero if a stored build was used.
    pub time: Duration,
}

/// The program of a submission.
///
/// A program that the grader has compiled runs from a private copy of the stored one. Whatever it
/// does to its own file, the store keeps the program, so it cannot make its failures look like the
/// machine's.
#[derive(Debug)]
pub struct Program {
    /// The executable file.
    pub path: PathBuf,
    /// Arguments before those of the protocol.
    pub args: Vec<OsString>,
    /// PATH of its environment.
    pub search: OsString,
    /// The folder of a private copy, which is removed with the program.
    folder: Option<Folder>,
    /// The source from which the private copy can be made again.
    source: Option<Source>,
}

#[derive(Debug)]
struct Source {
    stored: Stored,
    /// The identity of the private copy when it was made; `None` before that.
    made: Mutex<Option<Look>>,
}

/// The identity of a file, which shows whether it was changed.
///
/// The numbers are device, inode number, size, and the time of the last change (seconds and
/// nanoseconds), which no program can set back.
type Look = (u64, u64, u64, i64, i64);

impl Program {
    /// Returns a program whose file lies somewhere permanently.
    pub fn new(path: impl Into<PathBuf>, args: Vec<OsString>, search: impl Into<OsString>) -> Self {
        Self { path: path.into(), args, search: search.into(), folder: None, source: None }
    }

    /// Returns a program in a folder of its own, which is removed with it.
    pub(super) fn in_folder(
        path: PathBuf,
        args: Vec<OsString>,
        search: OsString,
        folder: Folder,
    ) -> Self {
        Self { folder: Some(folder), ..Self::new(path, args, search) }
    }

    /// Returns what must exist for the program to run, besides the programs and libraries of the
    /// system: its folder or its file, and interpreters that PATH names.
    pub fn access(&self) -> Vec<Access> {
        let own = match &self.folder {
            Some(folder) => Some(folder.path()),
            None => Some(self.path.as_path()).filter(|path| path.is_absolute()),
        };
        own.map(Access::execute).into_iter().chain(sandbox::interpreters(&self.search)).collect()
    }

    /// Returns a private copy of a stored program.
    ///
    /// # Errors
    /// Fails if the stored program was changed, or if the copy cannot be written.
    pub(super) fn of_stored(stored: Stored, search: &str) -> Result<Self, Fault> {
        let folder = Folder::new()?;
        let path = folder.path().join(PROGRAM);
        let source = Some(Source { stored, made: Mutex::new(None) });
        let program = Self { folder: Some(folder), source, ..Self::new(path, vec![], search) };
        program.restore()?;
        Ok(program)
    }

    /// Returns whether the private copy is as it was made; always true for a program that the
    /// grader has not compiled.
    pub fn is_intact(&self) -> bool {
        let Some(source) = &self.source else { return true };
        let made = source.made.lock().unwrap_or_else(PoisonError::into_inner);
        made.is_some() && *made == look(&self.path).ok()
    }

    /// Makes the private copy again.
    ///
    /// # Errors
    /// Fails if the stored program was changed, or if the copy cannot be written.
    pub fn restore(&self) -> Result<(), Fault> {
        let Some(source) = &self.source else { return Ok(()) };
        let bytes = source.stored.bytes(PROGRAM)?;
        let mut made = source.made.lock().unwrap_or_else(PoisonError::into_inner);
        let placed = sandbox::place_program(&self.path, &bytes).and_then(|()| look(&self.path));
        let path = self.path.clone();
        *made = Some(placed.map_err(|source| Fault::Write { path, source })?);
        Ok(())
    }
}

fn look(path: &Path) -> io::Result<Look> {
    let about = path.symlink_metadata()?;
    Ok((about.dev(), about.ino(), about.len(), about.ctime(), about.ctime_nsec()))
}

#[cfg(test)]
mod tests {
    use super::super::entry;
    use super::*;

    /// A stored program, and its private copy.
    fn program() -> (tempfile::TempDir, PathBuf, Program) {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("entry");
        let fill = |fresh: &Path| std::fs::write(fresh.join(PROGRAM), "#!/bin/sh\necho hello\n");
        entry::publish(&folder, &Vec::<String>::new(), fill).unwrap();
        let program = Program::of_stored(Stored::take(&folder).unwrap().unwrap(), "/bin").unwrap();
        (home, folder, program)
    }

    /// Checks that a change of the private copy is noticed, and that the copy is made again.
    fn check(what: &str, change: impl Fn(&Path)) {
        let (_home, _folder, program) = program();
        assert!(program.is_intact(), "{what}: before");
        change(&program.path);
        assert!(!program.is_intact(), "{what}: not noticed");
        program.restore().unwrap();
        assert!(program.is_intact(), "{what}: not restored");
        assert_eq!(std::fs::read(&program.path).unwrap(), b"#!/bin/sh\necho hello\n", "{what}");
    }

    #[test]
    fn a_program_that_harms_itself_is_noticed_and_made_again() {
        check("deleted", |path| std::fs::remove_file(path).unwrap());
        check("rewritten with the same bytes", |path| {
            std::fs::write(path, std::fs::read(path).unwrap()).unwrap()
        });
        check("replaced by a link", |path| {
            std::fs::remove_file(path).unwrap();
            std::os::unix::fs::symlink("/bin/true", path).unwrap();
        });
        check("replaced by a folder", |path| {
            std::fs::remove_file(path).unwrap();
            std::fs::create_dir_all(path.join("inner")).unwrap();
        });
    }

    #[test]
    fn what_is_stored_stays_as_it_is() {
        let (_home, folder, program) = program();
        std::fs::write(&program.path, "changed").unwrap();
        assert!(
            Stored::take(&folder).unwrap().is_some(),
            "the copy is no second name of what is stored"
        );
        std::fs::write(folder.join(PROGRAM), "changed").unwrap();
        assert!(matches!(program.restore(), Err(Fault::Store(_))));
    }

    #[test]
    fn a_program_of_another_kind_is_never_made_again() {
        let program = Program::new("/nowhere", vec![], "/bin");
        assert!(program.is_intact());
        program.restore().unwrap();
    }
}
