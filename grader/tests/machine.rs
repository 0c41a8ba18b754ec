//! Checks that a machine that fails while a submission is read costs no points, and that the next
//! run grades the submission.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use zip::CompressionMethod;
use zip::write::{SimpleFileOptions, ZipWriter};

/// Returns the exam of flat colours, which small programs can get right.
fn exam() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/exam")
}

/// Returns an archive with a correct program for the exam and a file of a mebibyte.
fn archive() -> Vec<u8> {
    let honest =
        fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/submissions/honest.py"))
            .unwrap();
    let files: [(&str, &[u8]); 4] = [
        ("submission.toml", b"run = { command = ['python3', './main.py'] }"),
        ("main.py", b"import sys\nsys.dont_write_bytecode = True\nimport honest\nhonest.main()\n"),
        ("honest.py", &honest),
        ("zeros.bin", &[0; 1 << 20]),
    ];
    let mut out = ZipWriter::new(std::io::Cursor::new(vec![]));
    for (name, bytes) in files {
        // Stored, since a file of zeros would look like a bomb.
        out.start_file(
            name,
            SimpleFileOptions::default().compression_method(CompressionMethod::Stored),
        )
        .unwrap();
        out.write_all(bytes).unwrap();
    }
    out.finish().unwrap().into_inner()
}

/// Returns a folder with `in/ann.zip` and an empty `tmp`.
fn class() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    fs::create_dir(place.path().join("in")).unwrap();
    fs::create_dir(place.path().join("tmp")).unwrap();
    fs::write(place.path().join("in/ann.zip"), archive()).unwrap();
    place
}

/// Runs the command. Returns the exit code, and what it printed on both streams.
fn run(command: &mut Command) -> (i32, String) {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let text = String::from_utf8_lossy(&stdout).into_owned() + &String::from_utf8_lossy(&stderr);
    (status.code().unwrap_or_else(|| panic!("{status}: {text}")), text)
}

/// Adds the batch of the class in `place` to a command that runs it.
fn batch<'a>(command: &'a mut Command, place: &Path) -> &'a mut Command {
    command.arg(env!("CARGO_BIN_EXE_grader")).arg("batch").arg("in").arg("-o").arg("out");
    command.args(["--jobs", "1", "--sandbox", "basic", "--cases"]).arg(exam()).current_dir(place)
}

/// Checks a batch that `limited` runs with too little room, and then one with enough.
fn check(limited: &mut Command, place: &Path) {
    let (code, text) = run(batch(limited, place));
    assert_eq!(code, 3, "{text}");
    assert!(text.contains("1 could not be graded, for no fault of the student's"), "{text}");
    assert!(
        text.contains("ann: cannot unpack the archive below") && text.contains("TMPDIR"),
        "{text}"
    );
    let published = |folder: &str| fs::read_dir(place.join("out").join(folder)).unwrap().count();
    assert_eq!([published("results"), published("records")], [0, 0]);
    let (code, text) = run(batch(&mut Command::new("env"), place));
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("ann: 10 of 10 points"), "{text}");
    assert_eq!([published("results"), published("records")], [1, 1]);
}

#[test]
fn a_limit_on_the_size_of_files_is_no_fault_of_the_students() {
    let place = class();
    // The crates for submissions are compiled without the limit, if they are not in the store yet.
    let (_, text) = run(batch(&mut Command::new("env"), place.path()));
    assert!(text.contains("ann: 10 of 10 points"), "{text}");
    fs::remove_dir_all(place.path().join("out")).unwrap();
    // 1000 blocks are half a mebibyte in some shells, and a little less than one in others.
    let script = "trap '' XFSZ; ulimit -f 1000; exec \"$@\"";
    check(Command::new("sh").args(["-c", script, "sh"]), place.path());
}

#[test]
fn a_full_disk_is_no_fault_of_the_students() {
    let may_mount =
        Command::new("unshare").args(["-rm", "true"]).status().is_ok_and(|status| status.success());
    if !may_mount {
        // The fault is tested above without a mount as well. A gate that sets the variable must be
        // able to mount.
        assert!(
            std::env::var_os("REQUIRE_NAMESPACES").is_none(),
            "`unshare -rm` does not work here"
        );
        eprintln!(
            "`unshare -rm` does not work here, so no file system of a given size can be tried"
        );
        return;
    }
    let place = class();
    let script = "mount -t tmpfs -o size=64k none tmp && TMPDIR=$PWD/tmp exec \"$@\"";
    check(
        Command::new("unshare").args(["-rm", "sh", "-c", script, "sh"]).current_dir(place.path()),
        place.path(),
    );
}

#[test]
fn the_exit_code_says_whose_fault_it_is() {
    let place = class();
    fs::write(place.path().join("broken.zip"), "PK\x03\x04 and no more").unwrap();
    let grade = |path: &str, tmp: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.args(["grade", path, "--cases"]).arg(exam()).current_dir(place.path());
        run(command.env("TMPDIR", place.path().join(tmp)))
    };
    for (path, tmp, code, words) in [
        ("in/ann.zip", "tmp", 0, "10 of 10 points"),
        ("broken.zip", "tmp", 2, "the archive is broken"),
        ("nowhere.zip", "tmp", 2, "nowhere.zip: No such file or directory"),
        ("in/ann.zip", "missing", 3, "missing: No such file or directory"),
        ("in/ann.zip", "in/ann.zip", 3, "in/ann.zip: Not a directory"),
    ] {
        let (found, text) = grade(path, tmp);
        assert_eq!(found, code, "{path} with TMPDIR {tmp}: {text}");
        assert!(text.contains(words), "{path} with TMPDIR {tmp}: no {words:?} in {text}");
    }
}
