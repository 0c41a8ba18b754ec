//! Archives as they are handed in: of every kind, under every name, within folders and within each
//! other.

use std::io::Write;

use ::zip::write::{SimpleFileOptions, ZipWriter};

use super::*;

fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut out = ZipWriter::new(std::io::Cursor::new(vec![]));
    for (name, bytes) in files {
        match name.strip_suffix('@') {
            Some(link) => {
                out.add_symlink(link, "/etc/passwd", SimpleFileOptions::default()).unwrap()
            }
            None => {
                out.start_file(*name, SimpleFileOptions::default()).unwrap();
                out.write_all(bytes).unwrap();
            }
        }
    }
    out.finish().unwrap().into_inner()
}

fn tarball(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut out = ::tar::Builder::new(vec![]);
    for (name, bytes) in files {
        let mut header = ::tar::Header::new_gnu();
        header.set_size(bytes.len() as u64);
        out.append_data(&mut header, name, *bytes).unwrap();
    }
    out.into_inner().unwrap()
}

/// Checks what is left aside of the bytes as a file called `name`, or why it is refused.
fn check_file(name: &str, bytes: &[u8], expected: Result<&[&str], &str>) {
    let home = submission(&[(name, bytes)]);
    check_folder(&home.path().join(name), expected);
}

const MINE: &[(&str, &[u8])] = &[("src/sphere.rs", b"mine")];

#[test]
fn an_archive_is_identified_by_its_bytes() {
    check_file("hw.zip", &zipped(MINE), Ok(&[]));
    check_file("hw.rar", &zipped(MINE), Ok(&[]));
    check_file("hw.tar", &tarball(MINE), Ok(&[]));
    check_file("hw.tar.gz", &tarball(MINE), Ok(&[]));
    check_file("hw", &tarball(MINE), Ok(&[]));
    check_file(
        "hw.zip",
        b"Rar!\x1a\x07\x01\0...",
        Err("a .rar archive, though its name ends in .zip, which cannot be read"),
    );
    check_file(
        "hw.tar.xz",
        b"\xfd7zXZ\0...",
        Err("an .xz archive, which cannot be read: hand in .zip or .tar.gz"),
    );
    check_file("hw.7z", b"7z\xbc\xaf\x27\x1c", Err("it is a .7z archive, which cannot be read"));
    check_file("hw.zip", b"<!DOCTYPE html>", Err("a page of the web"));
    check_file("main.rs", b"fn main() {}", Err("it is a single source file: hand in the folder"));
    check_file("report.pdf", b"%PDF-1.7", Err("it is a PDF document"));
    check_file("hw.zip", b"", Err("the file is empty"));
    check_file(
        "hw.zip",
        b"PK\x03\x04 and no more",
        Err("the archive cannot be taken: the archive is broken"),
    );
    check_file("notes", b"text", Err("neither a folder nor an archive"));
}

#[test]
fn an_archive_gives_the_same_digest_as_its_folder() {
    let folder = read(submission(MINE).path(), &template()).unwrap().digest;
    for bytes in [
        zipped(MINE),
        tarball(MINE),
        zipped(&[("a/b/sphere.rs", b"mine"), ("report.pdf", b"%PDF-")]),
    ] {
        let home = submission(&[("hw", &bytes)]);
        assert_eq!(read(&home.path().join("hw"), &template()).unwrap().digest, folder);
    }
}

#[test]
fn an_odd_entry_is_named_and_costs_nothing() {
    let odd = "a:b: has a backslash or a colon in its name";
    check_file("hw.zip", &zipped(&[MINE[0], ("a:b", b"")]), Ok(&[odd]));
    check_file("hw.zip", &zipped(&[MINE[0], ("hw/.venv/bin/python@", b"")]), Ok(&[]));
    let large = vec![b'x'; 20 << 20];
    let large = zipped(&[MINE[0], ("demo.mp4", &large)]);
    check_file("hw.zip", &large, Ok(&["demo.mp4: has 20 MiB; at most 16 MiB are read"]));
}

#[test]
fn an_odd_entry_that_counts_refuses_the_submission() {
    check_file(
        "hw.zip",
        &zipped(&[("src/sphere.rs@", b""), ("src/main.rs", b"")]),
        Err("src/sphere.rs: is a link"),
    );
    check_file("hw.zip", &zipped(&[("hw/src@", b""), ("hw/a.txt", b"")]), Err("hw/src: is a link"));
    let twice = [MINE[0], ("./src/sphere.rs", b"another")];
    check_file("hw.zip", &zipped(&twice), Err("src/sphere.rs: comes twice"));
    check_file(
        "hw.zip",
        &zipped(&[("../src/sphere.rs", b"")]),
        Err("left aside: ../src/sphere.rs: leaves the folder"),
    );
    let elsewhere = [MINE[0], ("/etc/sphere.rs", b"x"), ("../sphere.rs", b"x")];
    let words = ["../sphere.rs: leaves the folder (`..`)", "/etc/sphere.rs: has an absolute path"];
    check_file("hw.zip", &zipped(&elsewhere), Ok(&words));
    let large = vec![b'x'; 17 << 20];
    let run: (&str, &[u8]) = ("submission.toml", b"[run]\ncommand = ['x']");
    check_file(
        "hw.zip",
        &zipped(&[run, ("mesh.obj", &large)]),
        Err("mesh.obj: has 17 MiB; at most 16 MiB are read"),
    );
    let nested: (&str, &[u8]) = ("hw/submission.toml", run.1);
    let remarks = [
        "everything outside of the folder `hw`: the submission is taken from there",
        "demo.mp4: has 17 MiB; at most 16 MiB are read",
    ];
    check_file("hw.zip", &zipped(&[nested, ("demo.mp4", &large)]), Ok(&remarks));
    check_file(
        "hw.zip",
        &zipped(&[run, ("a:b", b"")]),
        Ok(&["a:b: has a backslash or a colon in its name"]),
    );
}

#[test]
fn an_archive_in_a_folder_is_taken() {
    let hw = zipped(MINE);
    let remark = "everything outside of the archive `Ann_1_file_/hw.zip`: the submission is taken \
        from there";
    check(&[("Ann_1_file_/hw.zip", &hw), ("onlinetext.html", b"<p>")], Ok(&[remark]));
    let nested = zipped(&[("inner/hw.zip", &hw)]);
    let remark =
        "everything outside of the archive `inner/hw.zip`: the submission is taken from there";
    check_file("outer.zip", &nested, Ok(&[remark]));
    let twice = zipped(&[("outer.zip", &nested)]);
    check_file("outermost.zip", &twice, Err("an archive within an archive"));
    check(&[("a.zip", &hw), ("b.zip", &hw)], Err("`a.zip`, `b.zip`; hand in one of them"));
    check(
        &[("src/sphere.rs", b""), ("old.zip", &hw)],
        Ok(&["old.zip: not a file of the template, so it is not used"]),
    );
}

#[test]
fn too_large_an_archive_is_refused_with_both_numbers() {
    let mut large = zipped(MINE);
    large.resize(33 << 20, 0);
    check_file("hw.zip", &large, Err("the archive has 33 MiB; at most 32 MiB are read"));
}
