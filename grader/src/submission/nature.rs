//! Identifies a file by its first bytes, or by its name if the bytes say nothing.

use super::archive::Format;

/// The kind of a file that was handed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Nature {
    /// An archive that is read.
    Archive(Format),
    /// An archive that is not read. The text completes "it is ...".
    Packed(&'static str),
    /// A student's work, but no submission. The text completes "it is ...".
    Work(&'static str),
}

use Nature::{Archive, Packed, Work};

/// The bytes at the beginning of a file that [`of`] looks at.
pub(super) const START_BYTES: u64 = 512;

/// The byte strings that identify a file: their offset, the bytes, and the kind of the file.
const BYTES: [(usize, &[u8], Nature); 18] = [
    (0, b"PK\x03\x04", Archive(Format::Zip)),
    (0, b"PK\x05\x06", Archive(Format::Zip)), // an empty one
    (0, b"\x1f\x8b", Archive(Format::TarGz)),
    (257, b"ustar", Archive(Format::Tar)),
    (0, b"7z\xbc\xaf\x27\x1c", Packed("a .7z archive")),
    (0, b"Rar!\x1a\x07", Packed("a .rar archive")),
    (0, b"\xfd7zXZ\0", Packed("an .xz archive")),
    (0, b"BZh", Packed("a .bz2 archive")),
    (0, b"\x28\xb5\x2f\xfd", Packed("a .zst archive")),
    (0, b"\x04\x22\x4d\x18", Packed("an .lz4 archive")),
    (0, b"LZIP", Packed("an .lz archive")),
    (0, b"\x1f\x9d", Packed("a .Z archive")),
    (0, b"PK\x07\x08", Packed("one part of a .zip archive in several parts")),
    (0, b"%PDF-", Work("a PDF document")),
    (0, b"\xd0\xcf\x11\xe0", Work("an Office document")),
    (0, b"\x7fELF", Work("a compiled program")),
    (0, b"MZ", Work("a Windows program")),
    (
        0,
        b"<",
        Work("a page of the web or another text with markup, perhaps saved instead of the archive"),
    ),
];

/// The endings of names in lower case, longer ones before those that they end in, and the kind of
/// the file.
const ENDINGS: [(&str, Nature); 41] = [
    (".zip", Archive(Format::Zip)),
    (".tar.gz", Archive(Format::TarGz)),
    (".tgz", Archive(Format::TarGz)),
    (".tar", Archive(Format::Tar)),
    (".7z", Packed("a .7z archive")),
    (".rar", Packed("a .rar archive")),
    (".tar.xz", Packed("an .xz archive")),
    (".txz", Packed("an .xz archive")),
    (".xz", Packed("an .xz archive")),
    (".tar.bz2", Packed("a .bz2 archive")),
    (".tbz2", Packed("a .bz2 archive")),
    (".tbz", Packed("a .bz2 archive")),
    (".bz2", Packed("a .bz2 archive")),
    (".tar.zst", Packed("a .zst archive")),
    (".tzst", Packed("a .zst archive")),
    (".zst", Packed("a .zst archive")),
    (".lz4", Packed("an .lz4 archive")),
    (".tar.lz", Packed("an .lz archive")),
    (".lz", Packed("an .lz archive")),
    (".lzma", Packed("an .lzma archive")),
    (".tar.z", Packed("a .Z archive")),
    (".zipx", Packed("a .zipx archive")),
    (".gz", Archive(Format::TarGz)),
    (".rs", Work("a single source file")),
    (".c", Work("a single source file")),
    (".cc", Work("a single source file")),
    (".cpp", Work("a single source file")),
    (".cxx", Work("a single source file")),
    (".h", Work("a single source file")),
    (".hpp", Work("a single source file")),
    (".py", Work("a single source file")),
    (".java", Work("a single source file")),
    (".js", Work("a single source file")),
    (".ts", Work("a single source file")),
    (".go", Work("a single source file")),
    (".cs", Work("a single source file")),
    (".ipynb", Work("a notebook")),
    (".pdf", Work("a PDF document")),
    (".doc", Work("an Office document")),
    (".docx", Work("an Office document")),
    (".odt", Work("an Office document")),
];

/// Returns the kind of a file by its name and its first [`START_BYTES`], or `None` if neither says
/// anything.
///
/// The bytes decide, since names may be wrong. A document that is a zip archive inside is what its
/// name says.
pub(super) fn of(name: &[u8], start: &[u8]) -> Option<Nature> {
    match (by_bytes(start), by_name(name)) {
        (Some(Archive(Format::Zip)), Some(Work(what))) => Some(Work(what)),
        (by_bytes, by_name) => by_bytes.or(by_name),
    }
}

/// Returns the kind of a file by its first bytes.
pub(super) fn by_bytes(start: &[u8]) -> Option<Nature> {
    let start_at = |at: usize| start.get(at..).unwrap_or_default();
    BYTES
        .iter()
        .find(|(at, bytes, _)| start_at(*at).starts_with(bytes))
        .map(|(_, _, nature)| *nature)
}

/// Returns the kind of a file by the ending of its name.
pub(super) fn by_name(name: &[u8]) -> Option<Nature> {
    ending(name).map(|(_, nature)| nature)
}

/// Returns the name of an archive of any kind without its ending, and any other name as it is.
pub fn without_ending(name: &[u8]) -> &[u8] {
    match ending(name) {
        Some((ending, Archive(_) | Packed(_))) => &name[..name.len() - ending.len()],
        _ => name,
    }
}

fn ending(name: &[u8]) -> Option<(&'static str, Nature)> {
    ENDINGS.into_iter().find(|(ending, _)| {
        let end = name.len().saturating_sub(ending.len());
        name[end..].eq_ignore_ascii_case(ending.as_bytes())
    })
}

/// Returns why a file of that name is no submission, and what to hand in instead.
pub(super) fn refusal(name: &[u8], nature: Option<Nature>) -> String {
    let instead = "hand in the folder of the template, or a .zip or .tar.gz of it";
    let though = match ending(name) {
        Some((ending, Archive(_))) => format!(", though its name ends in {ending}"),
        _ => String::new(),
    };
    match nature {
        Some(Packed(what)) => {
            format!("it is {what}{though}, which cannot be read: hand in .zip or .tar.gz")
        }
        Some(Work(what)) => format!("it is {what}{though}: {instead}"),
        Some(Archive(_)) | None => {
            format!("it is neither a folder nor an archive{though}: {instead}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(name: &str, start: &[u8], expected: Option<Nature>) {
        assert_eq!(of(name.as_bytes(), start), expected, "{name}");
    }

    #[test]
    fn bytes_decide_before_names() {
        check("a.zip", b"PK\x03\x04...", Some(Archive(Format::Zip)));
        check("a.rar", b"PK\x03\x04...", Some(Archive(Format::Zip)));
        check("a.zip", b"Rar!\x1a\x07\x01\0", Some(Packed("a .rar archive")));
        check("a.tar.gz", b"\xfd7zXZ\0", Some(Packed("an .xz archive")));
        check("a", &[&[b'a'; 257][..], b"ustar\x0000"].concat(), Some(Archive(Format::Tar)));
        check("a.docx", b"PK\x03\x04...", Some(Work("an Office document")));
    }

    #[test]
    fn names_decide_where_bytes_say_nothing() {
        check("a.TAR.GZ", b"", Some(Archive(Format::TarGz)));
        check("a.7z", b"", Some(Packed("a .7z archive")));
        check("main.rs", b"fn main() {}", Some(Work("a single source file")));
        check("grades.csv", b"name,grade", None);
        check("zip", b"text", None);
        check("", b"", None);
    }

    #[test]
    fn the_ending_of_an_archive_is_cut() {
        for (name, expected) in [
            ("a.tar.gz", "a"),
            ("a.b.7z", "a.b"),
            ("a.tar.xz", "a"),
            ("report.pdf", "report.pdf"),
            (".zip", ""),
        ] {
            assert_eq!(without_ending(name.as_bytes()), expected.as_bytes(), "{name}");
        }
    }

    #[test]
    fn a_refusal_says_what_it_is_and_what_to_do() {
        let check = |name: &str, start: &[u8], expected: &str| {
            assert_eq!(refusal(name.as_bytes(), of(name.as_bytes(), start)), expected);
        };
        check("a.7z", b"", "it is a .7z archive, which cannot be read: hand in .zip or .tar.gz");
        check(
            "a.zip",
            b"Rar!\x1a\x07\0",
            "it is a .rar archive, though its name ends in .zip, which cannot be read: hand in \
                .zip or .tar.gz",
        );
        check(
            "main.rs",
            b"",
            "it is a single source file: hand in the folder of the template, or a .zip or .tar.gz \
                of it",
        );
    }
}
