//! Headers that lie, names in old encodings, and bytes that are no archive.

use std::io;
use std::sync::LazyLock;

use proptest::prelude::*;

use super::make::{central_entries, gzipped, patched};
use super::*;

/// The offset of the upper byte of "version made by" in the central directory, and its values.
const MADE_BY: usize = 5;
const FAT: u8 = 0;
const UNIX: u8 = 3;
const NTFS: u8 = 10;

/// Returns the zip archive as if `system` had made it.
fn made_by(bytes: &[u8], system: u8) -> Vec<u8> {
    let mut bytes = bytes.to_owned();
    central_entries(&bytes).iter().for_each(|at| bytes[at + MADE_BY] = system);
    bytes
}

#[test]
fn a_backslash_separates_where_the_zip_was_made_on_windows() {
    let zip = zipped(&[file("hw\\src\\a.rs", b"x"), file("hw\\docs\\", b"")]);
    for system in [FAT, NTFS] {
        check_one(Format::Zip, &made_by(&zip, system), &["hw/src/a.rs"], &[]);
    }
    let words = "hw\\src\\a.rs: has a backslash or a colon in its name";
    check_one(Format::Zip, &made_by(&zipped(&[file("hw\\src\\a.rs", b"x")]), UNIX), &[], &[words]);
    let out = made_by(&zipped(&[file("..\\x", b"x")]), FAT);
    check_one(Format::Zip, &out, &[], &["../x: leaves the folder (`..`)"]);
}

#[test]
fn a_name_that_is_not_utf8_is_code_page_437() {
    let zip = patched(&zipped(&[file("caf#.txt", b"x")]), b"caf#.txt", b"caf\x82.txt");
    check_one(Format::Zip, &zip, &["café.txt"], &[]);
}

#[test]
fn a_unicode_path_wins() {
    // The extra field 0x7075: version 1, the checksum of the name in the header, the path.
    let mut field = vec![1];
    field.extend(crc32(b"caf#.txt").to_le_bytes());
    field.extend("café.txt".as_bytes());
    let mut out = ::zip::ZipWriter::new(io::Cursor::new(vec![]));
    let mut options = ::zip::write::FullFileOptions::default();
    options.add_extra_field(0x7075, field, true).unwrap();
    out.start_file("caf#.txt", options).unwrap();
    let zip = out.finish().unwrap().into_inner();
    check_one(Format::Zip, &zip, &["café.txt"], &[]);
}

fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = flate2::Crc::new();
    crc.update(bytes);
    crc.sum()
}

#[test]
fn what_is_encrypted_or_packed_otherwise_is_left_aside() {
    // Flags and method of the central directory stand at 8 and 10.
    let zip = zipped(&[file("a", b"x"), file("b", b"y")]);
    let first = central_entries(&zip)[0];
    let patch = |at: usize, byte: u8| {
        let mut zip = zip.clone();
        zip[first + at] = byte;
        zip
    };
    check_one(Format::Zip, &patch(8, 1), &["b"], &["a: is encrypted; pack it without a password"]);
    let words = "a: is packed by a method that cannot be read (only Deflate can)";
    check_one(Format::Zip, &patch(10, 9), &["b"], &[words]);
}

#[test]
fn a_header_that_lies_about_the_size_gains_nothing() {
    let zeros = vec![0; (2 << 20) + 1];
    let mut zip = zipped(&[file("a", &zeros)]);
    let size = u32::to_le_bytes((2 << 20) + 1);
    let places: Vec<usize> =
        (0..zip.len() - 4).filter(|at| zip[*at..].starts_with(&size)).collect();
    assert_eq!(places.len(), 2, "in both headers");
    places.iter().for_each(|at| zip[*at..at + 4].copy_from_slice(&[1, 0, 0, 0]));
    refused_one(Format::Zip, &zip, &SMALL, "broken");
}

#[test]
fn entries_that_share_their_bytes_are_refused() {
    let noise: Vec<u8> =
        (0..4096_u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let mut zip = zipped(&[file("a", &noise), file("b", b"")]);
    // The second entry of the directory gets the sizes, checksum and offset of the first.
    let entries = central_entries(&zip);
    for (from, to) in [(10, 28), (42, 46)] {
        zip.copy_within(entries[0] + from..entries[0] + to, entries[1] + from);
    }
    refused_one(Format::Zip, &zip, &SMALL, "its entries overlap");
}

#[test]
fn long_names_in_extended_headers_are_cut() {
    let long = vec![b'a'; 4 << 20];
    let entry = Entry { name: b"././@LongLink", kind: EntryType::GNULongName, data: &long };
    refused_one(
        Format::TarGz,
        &tgz(&[entry, file("x", b"")]),
        &SMALL,
        "the headers of an entry are too long",
    );
}

#[test]
fn what_is_no_archive_is_said_to_be_broken() {
    for format in [Format::Zip, Format::TarGz, Format::Tar] {
        refused_one(format, b"nonsense", &SMALL, "the archive is broken");
        refused_one(format, &[b'x'; 600], &SMALL, "the archive is broken");
    }
    refused_one(Format::TarGz, &gzipped(&[b'x'; 600]), &SMALL, "there is no tar archive in it");
    let whole = tgz(&[file("a", &[7; 5000])]);
    refused_one(Format::TarGz, &whole[..whole.len() - 12], &SMALL, "the archive is broken");
}

/// An archive of each format, with an entry of every kind.
static SAMPLES: LazyLock<[(Format, Vec<u8>); 3]> = LazyLock::new(|| {
    let long =
        Entry { name: b"././@LongLink", kind: EntryType::GNULongName, data: b"a/long/name\0" };
    let mut entries = vec![
        file("src/main.rs", b"fn main() {}"),
        link("l"),
        file("b", &[7; 3000]),
        file("target/x", b"x"),
    ];
    let zip = zipped(&entries);
    entries.insert(0, long);
    let tar = tarball(&entries);
    [(Format::Zip, zip), (Format::TarGz, gzipped(&tar)), (Format::Tar, tar)]
});

/// Checks that unpacking `bytes` writes nothing beside the folder, exceeds no limit and does not
/// panic.
fn survives(format: Format, bytes: &[u8]) {
    if let Ok((found, aside)) = unpacked(bytes, format, &SMALL) {
        let bytes: usize = found.iter().map(|(_, bytes)| bytes.len()).sum();
        assert!(found.len() + aside.len() <= SMALL.entries && bytes as u64 <= SMALL.all_bytes);
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn arbitrary_bytes_are_survived(
        which in 0_usize..3, bytes in proptest::collection::vec(any::<u8>(), 0..2000),
    ) {
        survives(SAMPLES[which].0, &bytes);
    }

    #[test]
    fn mutated_archives_are_survived(
        which in 0_usize..3,
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut in proptest::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let (format, mut bytes) = SAMPLES[which].clone();
        for (at, byte) in edits {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        survives(format, &bytes);
    }

    #[test]
    fn mutated_headers_of_a_zip_are_survived(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
    ) {
        // Most of the archive is content: here the directory alone changes.
        let mut bytes = SAMPLES[0].1.clone();
        let directory = central_entries(&bytes)[0];
        for (at, byte) in edits {
            let at = directory + at.index(bytes.len() - directory);
            bytes[at] = byte;
        }
        survives(Format::Zip, &bytes);
    }

    #[test]
    fn mutated_headers_of_a_tar_with_a_right_sum_are_survived(
        edits in proptest::collection::vec((0_usize..512, any::<u8>()), 1..8),
    ) {
        // Without the sum nearly every mutation of a header ends there.
        let mut bytes = SAMPLES[2].1.clone();
        for (at, byte) in edits {
            bytes[1024 + at] = byte;
        }
        let mut header = ::tar::Header::new_old();
        header.as_mut_bytes().copy_from_slice(&bytes[1024..1536]);
        header.set_cksum();
        bytes[1024..1536].copy_from_slice(header.as_bytes());
        survives(Format::Tar, &bytes);
    }
}
