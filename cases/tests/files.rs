//! Tests that `cases::files::write` replaces a file whole, and that it replaces regular files only.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::os::fd::AsRawFd;
use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use cases::files::{Place, WriteError, check, is_stdout, is_stream, is_usage, write};

/// A folder with the file `old`, which holds "old".
struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        let home = Self(tempfile::tempdir().unwrap());
        fs::write(home.at("old"), "old").unwrap();
        home
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap()
    }

    /// Returns the names in the folder, which would include parts that were not removed.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|one| one.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn fifo(&self, name: &str) {
        assert!(Command::new("mkfifo").arg(self.at(name)).status().unwrap().success());
    }
}

#[test]
fn a_file_is_made_or_replaced_and_keeps_its_permissions() {
    let home = Home::new();
    fs::set_permissions(home.at("old"), fs::Permissions::from_mode(0o640)).unwrap();
    let before = fs::metadata(home.at("old")).unwrap();
    write(&home.at("old"), b"new").unwrap();
    write(&home.at("made"), b"made").unwrap();
    let after = fs::metadata(home.at("old")).unwrap();
    assert_eq!((home.text("old"), home.text("made")), ("new".to_owned(), "made".to_owned()));
    assert_eq!(after.mode() & 0o777, 0o640);
    assert_ne!(
        after.ino(),
        before.ino(),
        "the old file was written over, so that a reader sees a part"
    );
    assert_eq!(home.names(), ["made", "old"]);
}

#[test]
fn a_link_is_followed_and_stays() {
    let home = Home::new();
    symlink("old", home.at("one")).unwrap();
    symlink(home.at("one"), home.at("two")).unwrap();
    symlink("nothing_yet", home.at("dangling")).unwrap();
    write(&home.at("two"), b"by two links").unwrap();
    write(&home.at("dangling"), b"made").unwrap();
    assert_eq!(
        (home.text("old"), home.text("nothing_yet")),
        ("by two links".to_owned(), "made".to_owned())
    );
    for link in ["one", "two", "dangling"] {
        assert!(fs::symlink_metadata(home.at(link)).unwrap().is_symlink(), "{link} was replaced");
    }
}

/// Checks that writing to `name` is an error of usage that says `says`, and changes nothing.
fn check_refused(home: &Home, name: &str, says: &str) {
    let before = home.names();
    let path = home.at(name);
    for refused in [check(&path).unwrap_err(), write(&path, b"new").unwrap_err()] {
        assert_refused(&path, &refused, says);
    }
    assert_eq!((home.names(), home.text("old")), (before, "old".to_owned()), "{name}");
}

fn assert_refused(path: &Path, refused: &WriteError, says: &str) {
    let text = refused.to_string();
    assert!(refused.is_usage() && refused.is_untouched, "{text}");
    assert!(text.starts_with(&format!("cannot write {}: ", path.display())), "{text}");
    assert!(text.contains(says) && text.ends_with("; nothing was changed"), "{text}");
}

#[test]
fn a_name_that_can_be_no_file_is_an_error_of_usage() {
    let home = Home::new();
    fs::create_dir(home.at("folder")).unwrap();
    symlink("here", home.at("there")).unwrap();
    symlink("there", home.at("here")).unwrap();
    symlink("no/such", home.at("astray")).unwrap();
    home.fifo("pipe");
    let _socket = std::os::unix::net::UnixListener::bind(home.at("socket")).unwrap();
    for (name, says) in [
        ("no/such/file", "there is no folder `"),
        ("astray", "there is no folder `"),
        ("old/file", "there is no folder `"),
        ("folder", "it is a folder"),
        ("folder/", "it is a folder"),
        ("old/", "the name of a folder"),
        ("new/", "the name of a folder"),
        ("here", "lead in a circle"),
        ("socket", "neither a file nor a pipe"),
    ] {
        check_refused(&home, name, says);
    }
    assert_refused(
        &home.at("pipe"),
        &write(&home.at("pipe"), b"new").unwrap_err(),
        "nobody reads from this pipe",
    );
    assert!(fs::symlink_metadata(home.at("pipe")).unwrap().file_type().is_fifo());
    let own = std::env::current_exe().unwrap();
    assert_eq!(write(&own, b"").unwrap_err().source.kind(), ErrorKind::ExecutableFileBusy);
}

#[test]
fn what_is_no_regular_file_is_written_to_and_stays() {
    for (device, fails) in [("/dev/null", false), ("/dev/full", true)] {
        let written = write(Path::new(device), b"x");
        assert!(
            fs::metadata(device).unwrap().file_type().is_char_device(),
            "{device} was replaced"
        );
        assert_eq!(written.is_err(), fails, "{device}");
        if let Err(why) = written {
            assert_eq!((why.source.kind(), why.is_usage()), (ErrorKind::StorageFull, false));
            assert!(!why.to_string().contains("nothing was changed"), "{why}");
        }
    }
    let home = Home::new();
    home.fifo("pipe");
    let long = vec![7; 1 << 18]; // more than a pipe holds
    std::thread::scope(|scope| {
        let reader = scope.spawn(|| fs::read(home.at("pipe")).unwrap());
        while write(&home.at("pipe"), &long).is_err() {
            std::thread::yield_now(); // the reader has not opened the pipe yet
        }
        assert_eq!(reader.join().unwrap(), long);
    });
}

#[test]
fn an_open_descriptor_is_written_to_where_it_stands() {
    let home = Home::new();
    let file = File::options().append(true).open(home.at("old")).unwrap();
    let name = PathBuf::from(format!("/dev/fd/{}", file.as_raw_fd()));
    symlink(&name, home.at("link")).unwrap();
    let before = fs::metadata(home.at("old")).unwrap().ino();
    write(&name, b", new").unwrap();
    write(&home.at("link"), b", newer").unwrap();
    assert_eq!(
        (home.text("old"), fs::metadata(home.at("old")).unwrap().ino()),
        ("old, new, newer".to_owned(), before)
    );
    assert!(is_stream(&name) && !is_stdout(&name) && !is_stream(&home.at("old")));
    // /dev/stdout is such a link.
    symlink("/proc/self/fd/1", home.at("stdout")).unwrap();
    for name in [
        "-",
        "/dev/fd/1",
        "/proc/self/fd/1",
        "/proc/thread-self/fd/1",
        home.at("stdout").to_str().unwrap(),
    ] {
        assert!(is_stdout(Path::new(name)) && is_stream(Path::new(name)), "{name}");
    }
    assert_eq!(Place::of(Path::new("/dev/fd/0")).unwrap(), Place::Descriptor(0));
}

#[test]
fn the_kind_of_an_error_says_who_is_to_blame() {
    for (kind, is_of_usage) in [
        (ErrorKind::NotFound, true),
        (ErrorKind::PermissionDenied, true),
        (ErrorKind::IsADirectory, true),
        (ErrorKind::NotADirectory, true),
        (ErrorKind::ReadOnlyFilesystem, true),
        (ErrorKind::InvalidFilename, true),
        (ErrorKind::StorageFull, false),
        (ErrorKind::QuotaExceeded, false),
        (ErrorKind::FileTooLarge, false),
        (ErrorKind::OutOfMemory, false),
        (ErrorKind::Other, false),
    ] {
        assert_eq!(is_usage(&io::Error::from(kind)), is_of_usage, "{kind:?}");
    }
    let io_error = 5;
    assert!(!is_usage(&io::Error::from_raw_os_error(io_error)));
}

#[test]
fn threads_that_write_the_same_file_leave_one_that_is_whole() {
    let home = Home::new();
    let put = || (0..50).try_for_each(|_| write(&home.at("old"), b"whole"));
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|_| scope.spawn(put)).collect();
        threads.into_iter().for_each(|thread| thread.join().unwrap().unwrap());
    });
    assert_eq!((home.text("old"), home.names()), ("whole".to_owned(), vec!["old".to_owned()]));
}
