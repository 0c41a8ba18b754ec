//! Archives for tests, with names and kinds that no writer of archives would let pass.

use std::io::{Cursor, Write};

use ::tar::{EntryType, Header};
use ::zip::write::{SimpleFileOptions, ZipWriter};
use flate2::Compression;
use flate2::write::GzEncoder;

/// An entry of an archive.
pub(super) struct Entry<'a> {
    pub(super) name: &'a [u8],
    pub(super) kind: EntryType,
    pub(super) data: &'a [u8],
}

pub(super) fn entry<'a>(name: &'a str, kind: EntryType, data: &'a [u8]) -> Entry<'a> {
    Entry { name: name.as_bytes(), kind, data }
}

pub(super) fn file<'a>(name: &'a str, data: &'a [u8]) -> Entry<'a> {
    entry(name, EntryType::Regular, data)
}

pub(super) fn link(name: &str) -> Entry<'_> {
    entry(name, EntryType::Symlink, b"")
}

pub(super) fn tarball(entries: &[Entry]) -> Vec<u8> {
    let mut out = ::tar::Builder::new(vec![]);
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
    out.into_inner().unwrap()
}

pub(super) fn gzipped(bytes: &[u8]) -> Vec<u8> {
    let mut out = GzEncoder::new(vec![], Compression::best());
    out.write_all(bytes).unwrap();
    out.finish().unwrap()
}

pub(super) fn tgz(entries: &[Entry]) -> Vec<u8> {
    gzipped(&tarball(entries))
}

pub(super) fn zipped(entries: &[Entry]) -> Vec<u8> {
    let mut out = ZipWriter::new(Cursor::new(vec![]));
    for entry in entries {
        let name = str::from_utf8(entry.name).unwrap();
        match entry.kind {
            EntryType::Symlink => {
                out.add_symlink(name, "/etc/passwd", SimpleFileOptions::default()).unwrap()
            }
            EntryType::Directory => out.add_directory(name, SimpleFileOptions::default()).unwrap(),
            _ => {
                out.start_file(name, SimpleFileOptions::default().unix_permissions(0o777)).unwrap();
                out.write_all(entry.data).unwrap();
            }
        }
    }
    out.finish().unwrap().into_inner()
}

/// Returns `bytes` with `from` replaced by `to`. There must be two places: both headers of an entry
/// of a zip archive.
pub(super) fn patched(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let mut bytes = bytes.to_owned();
    let places: Vec<usize> =
        (0..=bytes.len() - from.len()).filter(|at| bytes[*at..].starts_with(from)).collect();
    assert_eq!(places.len(), 2, "the text to patch stands in both headers, and nowhere else");
    places.iter().for_each(|at| bytes[*at..at + to.len()].copy_from_slice(to));
    bytes
}

/// Returns where the entries of the central directory of a zip archive begin.
pub(super) fn central_entries(bytes: &[u8]) -> Vec<usize> {
    (0..bytes.len() - 4).filter(|at| bytes[*at..].starts_with(b"PK\x01\x02")).collect()
}
