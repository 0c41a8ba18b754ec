//! Folders and archives that are submissions, and some that are none.

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;

use proptest::prelude::*;

use tempfile::TempDir;

use super::*;

/// A template of three files, one of them the student's.
fn template() -> Template {
    let file = |name: &str, text: &str| (name.to_owned(), text.to_owned());
    Template {
        pristine: [
            file("src/main.rs", "mod sphere; fn main() {}"),
            file("Cargo.toml", "[package]"),
        ]
        .into(),
        student: [file("src/sphere.rs", "// todo")].into(),
        dependencies: vec!["cases".to_owned()],
    }
}

/// A submission with the given files.
fn submission(files: &[(&str, &[u8])]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
    folder
}

fn sources(submission: &Submission) -> &BTreeMap<String, String> {
    match &submission.kind {
        Kind::Rust(rust) => &rust.sources,
        Kind::Own(own) => panic!("{own:?}"),
    }
}

/// Checks what is left aside of the files, or why they are refused.
fn check(files: &[(&str, &[u8])], expected: Result<&[&str], &str>) {
    check_folder(submission(files).path(), expected);
}

fn check_folder(folder: &Path, expected: Result<&[&str], &str>) {
    match (read(folder, &template()), expected) {
        (Ok(found), Ok(ignored)) => assert_eq!(found.ignored, ignored),
        (Err(SubmissionError::Refused(why)), Err(part)) => {
            assert!(why.contains(part), "{why}\nshould say: {part}")
        }
        (found, _) => panic!("{found:?}"),
    }
}

#[test]
fn only_the_students_files_count() {
    check(&[("src/sphere.rs", b"fn f() {}")], Ok(&[]));
    check(
        &[
            ("src/sphere.rs", b""),
            ("src/main.rs", b"fn main() {}"),
            ("build.rs", b""),
            (".cargo/config.toml", b""),
            ("README.md", b"mine"),
        ],
        Ok(&[
            ".cargo/config.toml: not a file of the template, so it is not used",
            "build.rs: not a file of the template, so it is not used",
            "src/main.rs: differs from the given file, which is used instead",
            "all but the files that you write, which are src/sphere.rs",
        ]),
    );
    check(
        &[("src/sphere.rs", b""), ("src/main.rs", b"mod sphere; fn main() {}"), ("target/x", b"")],
        Ok(&[]),
    );
    let many: Vec<String> = (0..30).map(|n| format!("{n:02}.txt")).collect();
    let mut files: Vec<(&str, &[u8])> = many.iter().map(|name| (name.as_str(), &b""[..])).collect();
    files.push(("src/sphere.rs", b""));
    let found = read(submission(&files).path(), &template()).unwrap();
    assert_eq!(found.ignored.len(), 21);
    assert_eq!(found.ignored[20], "and 10 more files");
}

#[test]
fn a_file_that_is_missing_comes_from_the_template() {
    let other = Template {
        student: [("src/sphere.rs", ""), ("src/plane.rs", "// todo")]
            .map(|(a, b)| (a.to_owned(), b.to_owned()))
            .into(),
        ..template()
    };
    let found = read(submission(&[("src/sphere.rs", b"mine")]).path(), &other).unwrap();
    assert_eq!(found.ignored, ["src/plane.rs: missing, so the template's untouched one is taken"]);
    assert_eq!(
        (&*sources(&found)["src/plane.rs"], &*sources(&found)["src/sphere.rs"]),
        ("// todo", "mine")
    );
}

#[test]
fn templates_in_other_languages_are_named_only_if_nothing_else_is_written() {
    let others: [(&str, &[u8]); 3] =
        [("cpp/submission.toml", b""), ("cpp/src/sphere.cpp", b""), ("cpp/src/old.rs", b"")];
    let with = |mine: &'static [u8]| [&[("src/sphere.rs", mine)][..], &others].concat();
    check(&with(b"mine"), Ok(&[]));
    let remark = "cpp: a submission in another language; grade this folder by itself";
    check(&with(b"// todo"), Ok(&[remark]));
    let nested = [("hw/src/sphere.rs", &b"mine"[..]), ("hw/cpp/submission.toml", b"")];
    check(
        &nested,
        Ok(&["everything outside of the folder `hw`: the submission is taken from there"]),
    );
}

#[test]
fn flat_and_nested_submissions_are_the_same_as_plain_ones() {
    let plain = read(submission(&[("src/sphere.rs", b"mine")]).path(), &template()).unwrap();
    for (files, remark) in [
        (
            &[("sphere.rs", &b"mine"[..])][..],
            "the missing folder `src`: the .rs files at the top are taken as its files",
        ),
        (
            &[("hw/sphere.rs", b"mine")],
            "everything outside of the folder `hw`: the submission is taken from there, \
             its .rs files as those of the missing folder `src`",
        ),
        (
            &[("a/b/c/src/sphere.rs", b"mine")],
            "everything outside of the folder `a/b/c`: the submission is taken from there",
        ),
    ] {
        let found = read(submission(files).path(), &template()).unwrap();
        assert_eq!(found.ignored, [remark]);
        assert_eq!(found.digest, plain.digest);
    }
    let flat: &[(&str, &[u8])] =
        &[("sphere.rs", b""), ("main.rs", b"mine"), ("build.rs", b""), ("x.pdf", b"")];
    check(
        flat,
        Ok(&[
            "the missing folder `src`: the .rs files at the top are taken as its files",
            "build.rs: not a file of the template, so it is not used",
            "main.rs: differs from the given file, which is used instead",
            "x.pdf: not a file of the template, so it is not used",
            "all but the files that you write, which are src/sphere.rs",
        ]),
    );
}

#[test]
fn what_is_none_is_refused_in_plain_words() {
    check(
        &[("notes.txt", b"")],
        Err("neither a folder `src` with files of the template nor a `submission.toml`"),
    );
    check(&[("ball.rs", b"")], Err("expected in a folder `src` are sphere.rs"));
    check(
        &[("a/src/sphere.rs", b""), ("b/src/sphere.rs", b"")],
        Err("`a`, `b`; hand in one of them"),
    );
    check(&[("src/sphere.rs", b"ok\nna\xefve")], Err("src/sphere.rs: is not UTF-8 text (line 2)"));
    check(
        &[("src/sphere.rs", &[b' '; (1 << 20) + 512 * 1024])],
        Err("src/sphere.rs: has 1.5 MiB; at most 1 MiB are read"),
    );
    check(&[("submission.toml", b"[run]\ncommand = []")], Err("the command of [run] is empty"));
    check(&[("submission.toml", b"[run]\ncommand = ['']")], Err("[run] begins with an empty word"));
    check(
        &[("submission.toml", b"[run]\ncommand = ['a', \"\\u0000\"]")],
        Err("[run] has a NUL in it"),
    );
    check(&[("submission.toml", b"[run]\ncomand = ['x']")], Err("unknown field `comand`"));
    check(&[("submission.toml", b"[build]\ncommand = ['make']")], Err("missing field `run`"));
    check(
        &[("submission.toml", b"template = 'java'\n[run]\ncommand = ['x']")],
        Err("unknown variant `java`, expected one of `rust`, `cpp`, `python`"),
    );
    check(
        &[("submission.toml", &[b'#'; 65 << 10])],
        Err("submission.toml: has 65 KiB; at most 64 KiB are read"),
    );
    let run: (&str, &[u8]) = ("submission.toml", b"[run]\ncommand = ['x']");
    check(
        &[run, ("mesh.obj", &[b'#'; 17 << 20])],
        Err("mesh.obj: has 17 MiB; at most 16 MiB are read"),
    );
}

#[test]
fn a_link_is_not_followed() {
    let folder = submission(&[("src/x", b"")]);
    symlink("/etc/hostname", folder.path().join("src/sphere.rs")).unwrap();
    check_folder(folder.path(), Err("src/sphere.rs: is a link"));
    let elsewhere = submission(&[("sphere.rs", b"of somebody else")]);
    fs::remove_dir_all(folder.path().join("src")).unwrap();
    symlink(elsewhere.path(), folder.path().join("src")).unwrap();
    check_folder(folder.path(), Err("src: is a link"));
    let manifest = TempDir::new().unwrap();
    symlink("/etc/hostname", manifest.path().join("submission.toml")).unwrap();
    check_folder(manifest.path(), Err("submission.toml: is a link"));
    let beside = submission(&[("src/sphere.rs", b"")]);
    symlink("/etc", beside.path().join("etc")).unwrap();
    check_folder(beside.path(), Ok(&["etc: is a link; put the file itself there"]));
}

#[test]
fn everything_that_can_lie_in_a_folder_is_survived() {
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::net::UnixListener;
    use std::process::Command;
    let folder = submission(&[("src/sphere.rs", b""), ("closed/x", b""), ("unreadable.bin", b"")]);
    let at = |name: &str| folder.path().join(name);
    let odd = std::ffi::OsStr::from_bytes(b"caf\xe9\n.rs");
    fs::write(folder.path().join(odd), "").unwrap();
    assert!(Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
    let _listener = UnixListener::bind(at("socket")).unwrap();
    fs::create_dir_all(at("1/2/3/4/5/6/7/8/9/10/11/12/13/14")).unwrap();
    let found = read(folder.path(), &template()).unwrap().ignored.join("\n");
    for words in [
        "caf\u{fffd} .rs: has a name that is not UTF-8",
        "pipe: is neither a file nor a folder",
        "socket: is neither a file nor a folder",
        "1/2/3/4/5/6/7/8/9/10/11/12/13: lies 13 names deep; at most 12 are read",
    ] {
        assert!(found.contains(words), "no {words:?} in\n{found}");
    }
}

#[test]
fn a_file_that_the_user_may_not_read_is_nobodys_submission() {
    use std::os::unix::fs::PermissionsExt;
    let folder = submission(&[("src/sphere.rs", b"")]);
    let closed = folder.path().join("src");
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o000)).unwrap();
    let may_read = fs::read_dir(&closed).is_ok(); // as root may
    let found = read(folder.path(), &template());
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o700)).unwrap();
    match found {
        Ok(_) => assert!(may_read),
        Err(SubmissionError::Unreadable { path, .. }) => assert!(!may_read && path == closed),
        Err(why) => panic!("{why}"),
    }
    // The same case for root, who may read everything: a listing as another user gets it.
    let denied = || Why::Unreadable(io::Error::from_raw_os_error(libc::EACCES));
    let listing = || Listing { files: vec![], aside: vec![Aside::new(b"src", denied())] };
    let mut place = Place { top: folder.path().to_owned(), listing: listing(), unpacked: None };
    for found in [
        place.locate(&template()).map(drop),
        rust::read(folder.path(), "", Layout::Template, listing(), &template()).map(drop),
        own::read(folder.path(), "", listing()).map(drop),
    ] {
        assert!(
            matches!(&found, Err(SubmissionError::Unreadable { path, .. }) if *path == closed),
            "{found:?}"
        );
    }
    let missing = read(&folder.path().join("nowhere"), &template());
    assert!(matches!(missing, Err(SubmissionError::Unreadable { .. })), "{missing:?}");
    let device = read(Path::new("/dev/zero"), &template());
    assert!(matches!(device, Err(SubmissionError::Unreadable { .. })), "{device:?}");
}

#[test]
fn more_than_can_be_listed_is_refused() {
    let folder = submission(&[("src/sphere.rs", b"")]);
    (0..limits::LIMITS.entries - 2)
        .for_each(|n| fs::write(folder.path().join(n.to_string()), "").unwrap());
    assert!(
        read(folder.path(), &template()).is_ok(),
        "with src and src/sphere.rs it is as many as are read"
    );
    fs::write(folder.path().join("x"), "").unwrap();
    check_folder(folder.path(), Err("more than 2000 files and folders"));
}

#[test]
fn the_digest_follows_what_counts_and_nothing_else() {
    let digest =
        |files: &[(&str, &[u8])]| read(submission(files).path(), &template()).unwrap().digest;
    let one = digest(&[("src/sphere.rs", b"a")]);
    assert_eq!(one, digest(&[("src/sphere.rs", b"a"), ("notes.txt", b"n"), (".DS_Store", b"")]));
    assert_ne!(one, digest(&[("src/sphere.rs", b"b")]));
    let found =
        read(submission(&[("src/sphere.rs", b"a"), ("src/main.rs", b"evil")]).path(), &template())
            .unwrap();
    assert_eq!(sources(&found)["src/main.rs"], "mod sphere; fn main() {}");
}

#[test]
fn another_language_says_how_it_is_run() {
    let run: &[u8] = b"[run]\ncommand = ['python3', './t.py']";
    let plain =
        read(submission(&[("submission.toml", run), ("t.py", b"1")]).path(), &template()).unwrap();
    let nested =
        [("hw/submission.toml", run), ("hw/t.py", b"1"), ("notes.txt", b""), ("hw/.DS_Store", b"")];
    let nested = read(submission(&nested).path(), &template()).unwrap();
    assert_eq!(nested.digest, plain.digest);
    let Kind::Own(own) = nested.kind else { panic!("{nested:?}") };
    assert_eq!((own.build, own.run), (None, vec!["python3".to_owned(), "./t.py".to_owned()]));
    assert_eq!(own.files, ["submission.toml", "t.py"]);
    assert_eq!(own.template, None);
}

#[test]
fn the_template_that_a_submission_is_made_from_is_read() {
    for (name, language) in [("cpp", Language::Cpp), ("python", Language::Python)] {
        let manifest = format!("template = '{name}'\n[run]\ncommand = ['x']");
        let folder = submission(&[("submission.toml", manifest.as_bytes())]);
        let Kind::Own(own) = read(folder.path(), &template()).unwrap().kind else {
            panic!("{name} is read as Rust")
        };
        assert_eq!(own.template, Some(language));
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn any_manifest_is_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        refused_or_read(&bytes);
    }

    #[test]
    fn any_change_of_a_manifest_is_read_or_refused(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = b"[build]\ncommand = ['make', \"a\"]\n[run]\n\
            command = ['./tracer', '''x''']\n".to_vec();
        for (at, byte) in edits {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        refused_or_read(&bytes);
    }
}

fn refused_or_read(manifest: &[u8]) {
    match read(submission(&[("submission.toml", manifest)]).path(), &template()) {
        Ok(Submission { kind: Kind::Own(own), .. }) => assert!(!own.run.is_empty()),
        Err(SubmissionError::Refused(why)) => {
            assert!(why.starts_with("submission.toml: "), "{why}")
        }
        other => panic!("{other:?}"),
    }
}

mod archives;
