//! Folders that are submissions, and folders that are none.

use std::fs;

use tempfile::TempDir;

use super::*;

/// A template of two files, one of each kind.
fn template(folder: &Path) -> Template {
    fs::create_dir_all(folder.join("src")).unwrap();
    fs::write(folder.join("template.toml"), "pristine = ['src/main.rs']\nstudent = ['src/sphere.rs']").unwrap();
    fs::write(folder.join("Cargo.toml"), "[package]\nname = 'x'\n[dependencies]\ncases = '1'").unwrap();
    fs::write(folder.join("src/main.rs"), "mod sphere; fn main() {}").unwrap();
    fs::write(folder.join("src/sphere.rs"), "// todo").unwrap();
    Template::load(folder).unwrap()
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

fn sources(submission: &Submission) -> &std::collections::BTreeMap<String, String> {
    match &submission.kind {
        Kind::Rust(rust) => &rust.sources,
        Kind::Own(own) => panic!("{own:?}"),
    }
}

/// Reads the files with a template and returns what is left aside, or why it is refused.
fn check(files: &[(&str, &[u8])], expected: Result<&[&str], &str>) {
    let (home, folder) = (TempDir::new().unwrap(), submission(files));
    match (read(folder.path(), &template(home.path())), expected) {
        (Ok(found), Ok(ignored)) => assert_eq!(found.ignored, ignored, "{files:?}"),
        (Err(SubmissionError::Refused(why)), Err(part)) => assert!(why.contains(part), "{why}"),
        (found, _) => panic!("{files:?}: {found:?}"),
    }
}

#[test]
fn only_the_students_files_count() {
    check(&[("src/sphere.rs", b"fn f() {}")], Ok(&[]));
    check(&[("inner/src/sphere.rs", b"fn f() {}")], Ok(&[]));
    check(
        &[("src/sphere.rs", b""), ("src/main.rs", b"fn main() {}"), ("build.rs", b""), (".cargo/config.toml", b"")],
        Ok(&[
            ".cargo/config.toml: not a file of the template",
            "build.rs: not a file of the template",
            "src/main.rs: differs from the template's, which is taken instead",
        ]),
    );
    check(
        &[("src/main.rs", b"mod sphere; fn main() {}"), ("target/x", b"")],
        Ok(&["src/sphere.rs: missing, so the template's untouched one is taken"]),
    );
}

#[test]
fn what_is_none_is_refused_in_plain_words() {
    check(&[("sphere.rs", b"")], Err("neither a folder `src` nor a `submission.toml`"));
    check(&[("a/src/x", b""), ("b/src/x", b"")], Err("several folders"));
    check(&[("src/sphere.rs", b"ok\nna\xefve")], Err("src/sphere.rs: is not UTF-8 text (line 2)"));
    check(&[("src/sphere.rs", &[b' '; (1 << 20) + 1])], Err("is larger than 1048576 bytes"));
    check(&[("submission.toml", b"[run]\ncommand = []")], Err("the command of [run] is empty"));
    check(&[("submission.toml", b"[run]\ncomand = ['x']")], Err("unknown field `comand`"));
    check(&[("submission.toml", b"[build]\ncommand = ['make']")], Err("missing field `run`"));
}

#[test]
fn a_link_is_not_followed() {
    let (home, folder) = (TempDir::new().unwrap(), submission(&[("src/x", b"")]));
    std::os::unix::fs::symlink("/etc/hostname", folder.path().join("src/sphere.rs")).unwrap();
    let found = read(folder.path(), &template(home.path()));
    assert!(matches!(&found, Err(SubmissionError::Refused(why)) if why.contains("is a link")), "{found:?}");
    let elsewhere = submission(&[("sphere.rs", b"of somebody else")]);
    fs::remove_dir_all(folder.path().join("src")).unwrap();
    std::os::unix::fs::symlink(elsewhere.path(), folder.path().join("src")).unwrap();
    let found = read(folder.path(), &template(home.path()));
    assert!(matches!(&found, Err(SubmissionError::Refused(why)) if why.contains("behind one")), "{found:?}");
}

#[test]
fn the_digest_follows_what_counts_and_nothing_else() {
    let home = TempDir::new().unwrap();
    let template = template(home.path());
    let digest = |files: &[(&str, &[u8])]| read(submission(files).path(), &template).unwrap().digest;
    let one = digest(&[("src/sphere.rs", b"a")]);
    assert_eq!(one, digest(&[("src/sphere.rs", b"a"), ("notes.txt", b"n")]));
    assert_ne!(one, digest(&[("src/sphere.rs", b"b")]));
    let main = "mod sphere; fn main() {}";
    let found = read(submission(&[("src/sphere.rs", b"a"), ("src/main.rs", b"evil")]).path(), &template).unwrap();
    assert_eq!(sources(&found)["src/main.rs"], main);
}

#[test]
fn another_language_says_how_it_is_run() {
    let home = TempDir::new().unwrap();
    let files: &[(&str, &[u8])] = &[("submission.toml", b"[run]\ncommand = ['python3', './t.py']"), ("t.py", b"1")];
    let found = read(submission(files).path(), &template(home.path())).unwrap();
    let Kind::Own(own) = found.kind else { panic!("{found:?}") };
    assert_eq!((own.build, own.run), (None, vec!["python3".to_owned(), "./t.py".to_owned()]));
}
