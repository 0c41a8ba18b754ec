//! Every rule has an archive that breaks it and nothing else, and good archives come out as they
//! went in.

use std::fs;

use ::tar::EntryType;

use super::*;

mod hostile;
mod make;

use make::{Entry, entry, file, link, tarball, tgz, zipped};

/// Limits that a small archive can exceed. The ratio matters only past [`RATIO_FREE_BYTES`].
const SMALL: Limits = Limits {
    archive_bytes: 1 << 20,
    inflated_bytes: 8 << 20,
    looked_at: 20,
    entries: 6,
    depth: 3,
    file_bytes: 2 << 20,
    all_bytes: 3 << 20,
    ratio: 500,
};

/// The files that came out, as (path, content) in order, and the parts that were left aside.
type Unpacked = (Vec<(String, Vec<u8>)>, Vec<String>);

fn unpacked(bytes: &[u8], format: Format, limits: &Limits) -> Result<Unpacked, ArchiveError> {
    let place = tempfile::tempdir().unwrap();
    let into = place.path().join("into");
    fs::create_dir(&into).unwrap();
    let outcome = unpack(bytes, format, &into, limits);
    assert_eq!(
        fs::read_dir(place.path()).unwrap().count(),
        1,
        "something came out beside the folder"
    );
    let mut found = vec![];
    gather(&into, &into, &mut found);
    found.sort();
    Ok((found, outcome?.iter().map(Aside::to_string).collect()))
}

fn gather(root: &Path, at: &Path, found: &mut Vec<(String, Vec<u8>)>) {
    for entry in fs::read_dir(at).unwrap() {
        let path = entry.unwrap().path();
        let kind = path.symlink_metadata().unwrap().file_type();
        assert!(
            kind.is_dir() || kind.is_file(),
            "{} is neither a file nor a folder",
            path.display()
        );
        if kind.is_dir() {
            gather(root, &path, found);
        } else {
            found.push((
                path.strip_prefix(root).unwrap().to_str().unwrap().to_owned(),
                fs::read(&path).unwrap(),
            ));
        }
    }
}

/// Returns an archive of these entries in each of the three formats.
fn all(entries: &[Entry]) -> [(Format, Vec<u8>); 3] {
    [(Format::Zip, zipped(entries)), (Format::TarGz, tgz(entries)), (Format::Tar, tarball(entries))]
}

/// Checks that archives of these entries give the files `expected`, and leave aside what `aside`
/// says.
fn check(entries: &[Entry], expected: &[&str], aside: &[&str]) {
    for (format, bytes) in all(entries) {
        check_one(format, &bytes, expected, aside);
    }
}

fn check_one(format: Format, bytes: &[u8], expected: &[&str], aside: &[&str]) {
    let (found, left) =
        unpacked(bytes, format, &SMALL).unwrap_or_else(|why| panic!("{format:?}: {why}"));
    let paths: Vec<&str> = found.iter().map(|(path, _)| path.as_str()).collect();
    assert_eq!(paths, expected, "{format:?}");
    assert_eq!(left, aside, "{format:?}");
}

/// Checks that archives of these entries are refused in these words.
fn refused(entries: &[Entry], words: &str) {
    for (format, bytes) in all(entries) {
        refused_one(format, &bytes, &SMALL, words);
    }
}

fn refused_one(format: Format, bytes: &[u8], limits: &Limits, words: &str) {
    match unpacked(bytes, format, limits) {
        Ok(found) => panic!("{format:?} should be refused ({words}), came out as {found:?}"),
        Err(why) => {
            assert!(why.to_string().contains(words), "{format:?}: {why}\nshould speak of: {words}")
        }
    }
}

#[test]
fn good_archives_come_out_as_they_went_in() {
    let entries = [
        entry("src/", EntryType::Directory, b""),
        file("src/main.rs", b"fn main() {}"),
        file("./Lies.md", "Zoë".as_bytes()),
        file("empty", b""),
    ];
    let expected = [("Lies.md", "Zoë"), ("empty", ""), ("src/main.rs", "fn main() {}")]
        .map(|(name, data)| (name.to_owned(), data.as_bytes().to_owned()));
    for (format, bytes) in all(&entries) {
        assert_eq!(
            unpacked(&bytes, format, &SMALL).unwrap(),
            (expected.to_vec(), vec![]),
            "{format:?}"
        );
    }
}

#[test]
fn modes_are_ignored() {
    use std::os::unix::fs::PermissionsExt;
    let into = tempfile::tempdir().unwrap();
    unpack(&tgz(&[file("run.sh", b"")]), Format::TarGz, into.path(), &SMALL).unwrap();
    let mode = fs::metadata(into.path().join("run.sh")).unwrap().permissions().mode();
    assert_eq!(mode & 0o7111, 0, "neither set-uid nor executable: {mode:o}");
}

#[test]
fn an_odd_entry_costs_itself_alone() {
    for (odd, why) in [
        (link("passwd"), "passwd: is a link; put the file itself there"),
        (file("/etc/cron.d/x", b"x"), "/etc/cron.d/x: has an absolute path"),
        (file("../x", b"x"), "../x: leaves the folder (`..`)"),
        (file("a/../../x", b"x"), "a/../../x: leaves the folder (`..`)"),
        (file("C:/x", b"x"), "C:/x: has a backslash or a colon in its name"),
        (file("a\\b", b"x"), "a\\b: has a backslash or a colon in its name"),
        (
            file("Icon\r", b""),
            "Icon\\u{d}: has a control character or an invisible one in its name",
        ),
        (
            file("\u{202e}sr", b""),
            "\\u{202e}sr: has a control character or an invisible one in its name",
        ),
        (file("a/b/c/d", b"x"), "a/b/c/d: lies 4 names deep; at most 3 are read"),
    ] {
        check(&[file("a1", b"1"), odd, file("z", b"2")], &["a1", "z"], &[why]);
    }
    for kind in [EntryType::Char, EntryType::Block, EntryType::Fifo] {
        let entries = [entry("x", kind, b""), file("z", b"2")];
        check_one(Format::Tar, &tarball(&entries), &["z"], &["x: is neither a file nor a folder"]);
    }
    check_one(
        Format::Tar,
        &tarball(&[entry("x", EntryType::Link, b"")]),
        &[],
        &["x: is a link; put the file itself there"],
    );
    let named = [Entry { name: b"a\xffb", kind: EntryType::Regular, data: b"" }];
    check_one(Format::Tar, &tarball(&named), &[], &["a\u{fffd}b: has a name that is not UTF-8"]);
}

#[test]
fn a_link_cannot_be_written_through() {
    let aside = "out: is a link; put the file itself there";
    check(&[link("out"), file("out/x", b"x")], &["out/x"], &[aside]);
}

#[test]
fn a_path_comes_once() {
    let twice = "comes twice";
    check(&[file("a", b"1"), file("./a", b"2")], &["a"], &[&format!("a: {twice}")]);
    check(&[file("a", b"1"), file("a/b", b"2")], &["a"], &[&format!("a/b: {twice}")]);
    check(&[file("a/b", b"1"), file("a", b"2")], &["a/b"], &[&format!("a: {twice}")]);
    check(
        &[file("src/Ray.rs", b"1"), file("src/ray.rs", b"2")],
        &["src/Ray.rs", "src/ray.rs"],
        &[],
    );
    // The writer of zip archives refuses equal names, so the second is patched in.
    let zip = make::patched(&zipped(&[file("a.rs", b"1"), file("#.rs", b"2")]), b"#.rs", b"a.rs");
    check_one(Format::Zip, &zip, &["a.rs"], &["a.rs: comes twice"]);
}

#[test]
fn what_tools_and_systems_leave_is_skipped() {
    let names = [
        "target/debug/x",
        "hw/.git/objects/0",
        "hw/.venv/bin/python:3",
        "node_modules/a/b/c/d/e",
        "__MACOSX/._x",
        "src/__pycache__/x.pyc",
        "src/.DS_Store",
        "src/._main.rs",
        "Thumbs.db",
    ];
    let mut entries: Vec<Entry> = names.iter().map(|name| file(name, b"x")).collect();
    entries.push(link("hw/.venv/bin/python"));
    entries.push(file("src/target", b"a file of that name"));
    check(&entries, &["src/target"], &[]);
    let many: Vec<String> = (0..21).map(|n| format!("target/{n}")).collect();
    refused(&many.iter().map(|name| file(name, b"")).collect::<Vec<_>>(), "more than 20 entries");
    let zeros = vec![0; 4 << 20];
    check_one(Format::TarGz, &tgz(&[file("target/x", &zeros), file("a", b"")]), &["a"], &[]);
    check_one(Format::Zip, &zipped(&[file("target/x", &zeros), file("a", b"")]), &["a"], &[]);
}

#[test]
fn amounts_are_limited() {
    let names = ["1", "2", "3", "4", "5", "6", "7"];
    refused(&names.map(|name| file(name, b"")), "more than 6 files and folders");
    refused(&names.map(link), "more than 6 files and folders");
    let noise: Vec<u8> =
        (0..2_u64 << 20).map(|n| (n.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as u8 & 3).collect();
    let large = [&noise[..], b"x"].concat();
    check(
        &[file("b", &large), file("c", b"")],
        &["c"],
        &["b: has 2097153 bytes; at most 2097152 bytes are read"],
    );
    refused(
        &[file("a", &noise), file("b", &noise)],
        "have more than 3 MiB; at most 3 MiB are read",
    );
}

#[test]
fn a_bomb_is_stopped_while_it_inflates() {
    let zeros = vec![0; (1 << 20) + 1];
    let tight = Limits { ratio: 10, ..SMALL };
    for (format, bytes) in
        [(Format::TarGz, tgz(&[file("a", &zeros)])), (Format::Zip, zipped(&[file("a", &zeros)]))]
    {
        assert!(
            unpacked(&bytes, format, &Limits { ratio: 1200, ..SMALL }).is_ok(),
            "{format:?}: the control"
        );
        refused_one(format, &bytes, &tight, "inflates to more than 10 times its size");
    }
    let skipped = tgz(&[file("target/x", &zeros)]);
    refused_one(
        Format::TarGz,
        &skipped,
        &Limits { inflated_bytes: 1 << 20, ..SMALL },
        "inflates to more than 1 MiB",
    );
}
