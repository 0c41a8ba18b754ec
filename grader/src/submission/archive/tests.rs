//! Every rule has an archive that breaks it and nothing else, and good archives come out as they went in.

use std::fs;
use std::io::Write;

use tar::{EntryType, Header};
use zip::write::{SimpleFileOptions, ZipWriter};

use super::*;

/// Small, so that each can be crossed by a small archive; the ratio only matters past [`RATIO_FREE_BYTES`].
const LIMITS: Limits =
    Limits { archive_bytes: 1 << 20, entries: 6, depth: 3, file_bytes: 2 << 20, all_bytes: 3 << 20, ratio: 500 };

struct Entry<'a> {
    name: &'a [u8],
    kind: EntryType,
    data: &'a [u8],
}

fn file<'a>(name: &'a str, data: &'a [u8]) -> Entry<'a> {
    Entry { name: name.as_bytes(), kind: EntryType::Regular, data }
}

fn tgz(entries: &[Entry]) -> Vec<u8> {
    let mut out = tar::Builder::new(flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best()));
    for entry in entries {
        let mut header = Header::new_gnu();
        // Written by hand: the builder would refuse most of these names.
        header.as_old_mut().name[..entry.name.len()].copy_from_slice(entry.name);
        header.set_entry_type(entry.kind);
        header.set_size(entry.data.len() as u64);
        header.set_mode(0o4777);
        if entry.kind.is_symlink() || entry.kind.is_hard_link() {
            header.set_link_name("/etc/passwd").unwrap();
        }
        header.set_cksum();
        out.append(&header, entry.data).unwrap();
    }
    out.into_inner().unwrap().finish().unwrap()
}

fn zipped(entries: &[Entry]) -> Vec<u8> {
    let mut out = ZipWriter::new(io::Cursor::new(Vec::new()));
    for entry in entries {
        let name = str::from_utf8(entry.name).unwrap();
        match entry.kind {
            EntryType::Symlink => out.add_symlink(name, "/etc/passwd", SimpleFileOptions::default()).unwrap(),
            EntryType::Directory => out.add_directory(name, SimpleFileOptions::default()).unwrap(),
            _ => {
                out.start_file(name, SimpleFileOptions::default().unix_permissions(0o777)).unwrap();
                out.write_all(entry.data).unwrap();
            }
        }
    }
    out.finish().unwrap().into_inner()
}

/// Unpacks the bytes as a file called `name`; what came out as (path, contents), sorted.
fn unpacked(name: &str, bytes: &[u8], limits: &Limits) -> Result<Vec<(String, Vec<u8>)>, ArchiveError> {
    let place = tempfile::tempdir().unwrap();
    let (archive, into) = (place.path().join(name), place.path().join("into"));
    fs::write(&archive, bytes).unwrap();
    fs::create_dir(&into).unwrap();
    let outcome = unpack(&archive, &into, limits);
    let beside = fs::read_dir(place.path()).unwrap().count();
    assert_eq!(beside, 2, "something came out beside the folder");
    outcome?;
    let mut found = Vec::new();
    gather(&into, &into, &mut found);
    found.sort();
    Ok(found)
}

fn gather(root: &Path, at: &Path, found: &mut Vec<(String, Vec<u8>)>) {
    for entry in fs::read_dir(at).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            gather(root, &path, found);
        } else {
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().to_owned();
            found.push((name, fs::read(&path).unwrap()));
        }
    }
}

/// Both kinds of archive of these entries are refused, in these words.
fn check(entries: &[Entry], words: &str) {
    check_one("a.tar.gz", &tgz(entries), words);
    check_one("a.zip", &zipped(entries), words);
}

fn check_one(name: &str, bytes: &[u8], words: &str) {
    match unpacked(name, bytes, &LIMITS) {
        Ok(found) => panic!("{name} should be refused ({words}), came out as {found:?}"),
        Err(why) => assert!(why.to_string().contains(words), "{name}: {why}\nshould speak of: {words}"),
    }
}

#[test]
fn good_archives_come_out_as_they_went_in() {
    let folder = Entry { name: b"src/", kind: EntryType::Directory, data: b"" };
    let entries =
        [folder, file("src/main.rs", b"fn main() {}"), file("./Lies.md", "Zoë".as_bytes()), file("empty", b"")];
    let expected = [("Lies.md", "Zoë"), ("empty", ""), ("src/main.rs", "fn main() {}")]
        .map(|(name, data)| (name.to_owned(), data.as_bytes().to_owned()));
    assert_eq!(unpacked("a.tar.gz", &tgz(&entries), &LIMITS).unwrap(), expected);
    assert_eq!(unpacked("a.TGZ", &tgz(&entries), &LIMITS).unwrap(), expected);
    assert_eq!(unpacked("a.zip", &zipped(&entries), &LIMITS).unwrap(), expected);
}

#[test]
fn modes_are_ignored() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().unwrap();
    let (archive, into) = (place.path().join("a.tgz"), place.path().join("into"));
    fs::write(&archive, tgz(&[file("run.sh", b"")])).unwrap();
    fs::create_dir(&into).unwrap();
    unpack(&archive, &into, &LIMITS).unwrap();
    let mode = fs::metadata(into.join("run.sh")).unwrap().permissions().mode();
    assert_eq!(mode & 0o7111, 0, "neither set-uid nor executable: {mode:o}");
}

#[test]
fn entries_that_are_neither_file_nor_folder_are_refused() {
    check(&[Entry { name: b"passwd", kind: EntryType::Symlink, data: b"" }], "neither a file nor a folder");
    for kind in [EntryType::Link, EntryType::Char, EntryType::Block, EntryType::Fifo] {
        check_one("a.tgz", &tgz(&[Entry { name: b"x", kind, data: b"" }]), "neither a file nor a folder");
    }
}

#[test]
fn a_link_cannot_be_written_through() {
    let link = Entry { name: b"out", kind: EntryType::Symlink, data: b"" };
    check(&[link, file("out/x", b"x")], "`out` is neither");
}

#[test]
fn paths_that_leave_the_folder_are_refused() {
    check(&[file("/etc/cron.d/x", b"x")], "absolute");
    check(&[file("../x", b"x")], "leaves the folder");
    check(&[file("a/../../x", b"x")], "leaves the folder");
    check(&[file("..\\x", b"x")], "backslash");
    check(&[file("C:/x", b"x")], "colon");
}

#[test]
fn names_that_cannot_be_trusted_are_refused() {
    check(&[file("a\u{1b}[2J", b"x")], "control character");
    check(&[file("\u{202e}sr.niam", b"x")], "`\\u{202e}sr.niam` has a control character");
    check(&[file("src/aux.rs", b"x")], "Windows");
    check(&[file("COM1", b"x")], "Windows");
    check_one("a.tgz", &tgz(&[Entry { name: b"a\xffb", kind: EntryType::Regular, data: b"" }]), "not UTF-8");
    // A NUL ends a name in a tar header, so only a zip file can carry one: patched in, in both of its headers.
    check_one("a.zip", &patched(&zipped(&[file("a#b", b"x")]), b"a#b", b"a\0b"), "control character");
    check_one("a.zip", &patched(&zipped(&[file("a#b", b"x")]), b"a#b", b"a\xffb"), "not UTF-8");
}

fn patched(bytes: &[u8], from: &[u8; 3], to: &[u8; 3]) -> Vec<u8> {
    let mut bytes = bytes.to_owned();
    let places: Vec<usize> = (0..bytes.len() - 2).filter(|at| bytes[*at..].starts_with(from)).collect();
    assert_eq!(places.len(), 2);
    places.iter().for_each(|at| bytes[*at..at + 3].copy_from_slice(to));
    bytes
}

#[test]
fn a_path_comes_once() {
    check_one("a.tgz", &tgz(&[file("a", b"1"), file("a", b"2")]), "comes twice");
    check_one("a.tgz", &tgz(&[file("a", b"1"), file("./a", b"2")]), "comes twice");
    let twice = patched(&zipped(&[file("a#b", b"1"), file("abc", b"2")]), b"a#b", b"abc");
    check_one("a.zip", &twice, "same name");
    check(&[file("a", b"1"), file("a/b", b"2")], "comes twice");
    check(&[file("src/Ray.rs", b"1"), file("src/ray.rs", b"2")], "only in upper and lower case");
    check(&[file("Src/a.rs", b"1"), file("src/b.rs", b"2")], "differs from `Src`");
}

#[test]
fn amounts_are_limited() {
    let names = ["1", "2", "3", "4", "5", "6", "7"];
    check(&names.map(|name| file(name, b"")), "more than 6 entries");
    check(&[file("a/b/c/d", b"")], "more than 3 folders deep");
    let noise: Vec<u8> = (0..2_u64 << 20).map(|n| (n.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as u8 & 3).collect();
    check(&[file("a", &[&noise[..], b"x"].concat())], "larger than 2097152 bytes");
    check(&[file("a", &noise), file("b", &noise)], "inflates to more than 3145728 bytes");
    let archive: Vec<u8> = (0..(1 << 20) + 1_u64).map(|n| ((n * n) >> 3) as u8).collect();
    check_one("a.zip", &archive, "larger than 1048576 bytes");
}

#[test]
fn a_bomb_is_stopped_while_it_inflates() {
    let zeros = vec![0; (1 << 20) + 1];
    let tight = Limits { ratio: 10, ..LIMITS };
    for (name, bytes) in [("a.tgz", tgz(&[file("a", &zeros)])), ("a.zip", zipped(&[file("a", &zeros)]))] {
        assert!(unpacked(name, &bytes, &Limits { ratio: 1200, ..LIMITS }).is_ok(), "{name}: the control");
        let why = unpacked(name, &bytes, &tight).unwrap_err().to_string();
        assert!(why.contains("10 times its size"), "{name}: {why}");
    }
}

#[test]
fn a_header_that_lies_about_the_size_gains_nothing() {
    let zeros = vec![0; 2 << 20];
    let mut bytes = zipped(&[file("a", &zeros)]);
    let size = u32::to_le_bytes(2 << 20);
    let places: Vec<usize> = (0..bytes.len() - 4).filter(|at| bytes[*at..].starts_with(&size)).collect();
    assert!(!places.is_empty());
    places.iter().for_each(|at| bytes[*at..at + 4].copy_from_slice(&[1, 0, 0, 0]));
    assert!(unpacked("a.zip", &bytes, &Limits { ratio: 10, ..LIMITS }).is_err());
}

#[test]
fn long_names_in_extended_headers_are_cut() {
    let long = vec![b'a'; 4 << 20];
    let entry = Entry { name: b"././@LongLink", kind: EntryType::GNULongName, data: &long };
    check_one("a.tgz", &tgz(&[entry, file("x", b"")]), "inflates to too much");
}

#[test]
fn what_is_no_archive_is_said_to_be_none() {
    check_one("a.rar", b"", "neither .zip nor .tar.gz nor .tgz");
    check_one("a.zip", b"nonsense", "cannot read the archive");
    check_one("a.tgz", b"nonsense", "cannot read the archive");
    let whole = tgz(&[file("a", &[7; 5000])]);
    check_one("a.tgz", &whole[..whole.len() - 12], "cannot read the archive");
}

#[test]
fn the_folder_must_be_empty() {
    let place = tempfile::tempdir().unwrap();
    let archive = place.path().join("a.tgz");
    fs::write(&archive, tgz(&[file("a", b"")])).unwrap();
    let why = unpack(&archive, place.path(), &LIMITS).unwrap_err();
    assert!(why.to_string().contains("not empty"), "{why}");
}
