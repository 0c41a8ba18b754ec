//! Decides whether a failed system call is the fault of the machine or of the file it was about.

use std::error::Error;
use std::io;

use cases::problem::Problems;

/// The party to blame for an I/O error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blame {
    /// The machine that grades: it lacks room, memory or handles, or a device fails. Another try
    /// may succeed.
    Machine,
    /// The file or folder that the call named: it is missing, unreadable, of another kind, or
    /// broken.
    File,
}

/// Returns the party to blame for `error`: the machine, if any I/O error in its chain of causes is
/// the machine's.
///
/// Call this only for an error about a file that is handed to the grader. An error about one of the
/// grader's own folders, such as a missing TMPDIR, is always [`Blame::Machine`]. An error without
/// an I/O error in its chain is about content, which is [`Blame::File`].
pub fn of(error: &(dyn Error + 'static)) -> Blame {
    let mut next = Some(error);
    while let Some(error) = next {
        let io = error.downcast_ref::<io::Error>();
        if io.is_some_and(is_of_machine) {
            return Blame::Machine;
        }
        // `source` of an I/O error that wraps another error skips the wrapped error.
        next = match io.and_then(io::Error::get_ref) {
            Some(inner) => Some(inner),
            None => error.source(),
        };
    }
    Blame::File
}

/// Returns the party to blame for problems in files that people write. Problems with content are
/// [`Blame::File`].
pub fn of_problems(problems: &Problems) -> Blame {
    match problems.os_error() {
        Some(code) if OF_MACHINE.contains(&code) => Blame::Machine,
        _ => Blame::File,
    }
}

fn is_of_machine(error: &io::Error) -> bool {
    match error.raw_os_error() {
        Some(code) => OF_MACHINE.contains(&code),
        None => KINDS_OF_MACHINE.contains(&error.kind()),
    }
}

/// The error codes that say nothing about the file that the call named.
const OF_MACHINE: [i32; 18] = [
    libc::ENOSPC,
    libc::EDQUOT,
    libc::EFBIG, // a limit is set on the grader, whose own limits are lower
    libc::EMFILE,
    libc::ENFILE,
    libc::ENOMEM,
    libc::ENOBUFS,
    libc::EIO,
    libc::EROFS,
    libc::EAGAIN,
    libc::EINTR,
    libc::EBUSY,
    libc::ETXTBSY, // another thread forked while a program was written
    libc::ENOLCK,
    libc::ESTALE, // a network file system lost the file
    libc::ENOTCONN,
    libc::ETIMEDOUT,
    libc::EHOSTDOWN,
];

/// The error kinds that match [`OF_MACHINE`], for errors that a library has wrapped without the
/// code.
const KINDS_OF_MACHINE: [io::ErrorKind; 12] = [
    io::ErrorKind::StorageFull,
    io::ErrorKind::QuotaExceeded,
    io::ErrorKind::FileTooLarge,
    io::ErrorKind::OutOfMemory,
    io::ErrorKind::ReadOnlyFilesystem,
    io::ErrorKind::WouldBlock,
    io::ErrorKind::Interrupted,
    io::ErrorKind::ResourceBusy,
    io::ErrorKind::ExecutableFileBusy,
    io::ErrorKind::StaleNetworkFileHandle,
    io::ErrorKind::NotConnected,
    io::ErrorKind::TimedOut,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// An error of a library that keeps its cause, as `tar` and `tempfile` do.
    #[derive(Debug, thiserror::Error)]
    #[error("cannot read the entry")]
    struct Wrapped(#[source] io::Error);

    fn check(code: i32, expected: Blame) {
        let bare = || io::Error::from_raw_os_error(code);
        assert_eq!(of(&bare()), expected, "{}", bare());
        assert_eq!(of(&Wrapped(bare())), expected, "{} as a cause", bare());
        let twice = io::Error::other(Wrapped(io::Error::other(Wrapped(bare()))));
        assert_eq!(of(&twice), expected, "{} as the cause of a cause", bare());
    }

    #[test]
    fn a_lack_of_room_memory_or_handles_is_the_machines() {
        for code in OF_MACHINE {
            check(code, Blame::Machine);
        }
    }

    #[test]
    fn what_says_something_of_the_file_is_the_files() {
        let of_file = [
            libc::ENOENT,
            libc::EACCES,
            libc::EPERM,
            libc::ENOTDIR,
            libc::EISDIR,
            libc::ELOOP,
            libc::ENAMETOOLONG,
            libc::ENXIO,
            libc::EINVAL,
            libc::EEXIST,
            libc::ENOEXEC,
        ];
        for code in of_file {
            check(code, Blame::File);
        }
    }

    #[test]
    fn a_kind_without_a_code_is_judged_too() {
        for kind in KINDS_OF_MACHINE {
            assert_eq!(of(&io::Error::new(kind, "wrapped")), Blame::Machine, "{kind}");
        }
        for kind in [io::ErrorKind::InvalidData, io::ErrorKind::UnexpectedEof, io::ErrorKind::Other]
        {
            assert_eq!(of(&io::Error::new(kind, "broken")), Blame::File, "{kind}");
        }
        assert_eq!(of(&std::fmt::Error), Blame::File, "an error that is no I/O error");
    }
}
