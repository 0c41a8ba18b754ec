//! The header of a PLY file: its encoding, and the elements and properties that follow.

use crate::problem::{did_you_mean, quoted as listed};
use crate::scene::mesh::fault::{Fault, quoted};
use crate::scene::mesh::text::{Word, beginning, is_blank, is_end};

/// The encoding of the numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Float32,
    Float64,
}

/// The names of the types; every type has two.
const KINDS: [(&str, Kind); 16] = [
    ("char", Kind::Int8),
    ("int8", Kind::Int8),
    ("uchar", Kind::Uint8),
    ("uint8", Kind::Uint8),
    ("short", Kind::Int16),
    ("int16", Kind::Int16),
    ("ushort", Kind::Uint16),
    ("uint16", Kind::Uint16),
    ("int", Kind::Int32),
    ("int32", Kind::Int32),
    ("uint", Kind::Uint32),
    ("uint32", Kind::Uint32),
    ("float", Kind::Float32),
    ("float32", Kind::Float32),
    ("double", Kind::Float64),
    ("float64", Kind::Float64),
];

impl Kind {
    /// Returns the size of a number in the binary encodings, in bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Int8 | Self::Uint8 => 1,
            Self::Int16 | Self::Uint16 => 2,
            Self::Int32 | Self::Uint32 | Self::Float32 => 4,
            Self::Float64 => 8,
        }
    }

    /// Returns the least and the greatest value of an integer type; `None` for the other types.
    pub(super) fn range(self) -> Option<(i64, i64)> {
        match self {
            Self::Int8 => Some((i8::MIN.into(), i8::MAX.into())),
            Self::Uint8 => Some((0, u8::MAX.into())),
            Self::Int16 => Some((i16::MIN.into(), i16::MAX.into())),
            Self::Uint16 => Some((0, u16::MAX.into())),
            Self::Int32 => Some((i32::MIN.into(), i32::MAX.into())),
            Self::Uint32 => Some((0, u32::MAX.into())),
            Self::Float32 | Self::Float64 => None,
        }
    }
}

/// A property of an element.
#[derive(Debug)]
pub(super) struct Property<'a> {
    pub name: &'a [u8],
    /// The type of the number, or of each number of the list.
    pub kind: Kind,
    /// The type of the number of entries, if the property is a list.
    pub count: Option<Kind>,
}

/// An element: a number of records, each with all properties.
#[derive(Debug)]
pub(super) struct Element<'a> {
    pub name: Word<'a>,
    pub count: usize,
    /// The count as it is written.
    pub written: Word<'a>,
    pub properties: Vec<Property<'a>>,
}

impl Element<'_> {
    /// Returns a fault of the line that declares the element.
    pub(super) fn fault(&self, what: &str, help: impl Into<String>) -> Fault {
        Fault::at(self.name.at, format!("the element {} {what}", quoted(self.name.text)), help)
    }
}

/// A header.
#[derive(Debug)]
pub(super) struct Header<'a> {
    pub encoding: Encoding,
    pub elements: Vec<Element<'a>>,
    /// Offset of the first byte after the header.
    pub end: usize,
}

impl<'a> Header<'a> {
    /// Parses the header of a file of these bytes.
    ///
    /// # Errors
    /// The file does not begin with a header, or the header has a line that the format does not
    /// have, names no format, or does not end.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, Fault> {
        let mut lines = Lines::new(bytes, beginning(bytes)?);
        let first = lines.next_words();
        if !first.as_ref().is_some_and(|words| matches!(words[..], [Word { text: b"ply", .. }])) {
            return Err(Fault::at(
                0,
                "the first line is not `ply`",
                "only PLY files have names that end in .ply",
            ));
        }
        let (mut encoding, mut elements) = (None, vec![]);
        loop {
            let start = lines.at;
            let Some(words) = lines.next_words() else {
                return Err(Fault::at(
                    start,
                    "the header does not end",
                    "close it with a line `end_header`",
                ));
            };
            match words[..] {
                [] => {}
                [Word { text: b"comment" | b"obj_info", .. }, ..] => {}
                [Word { text: b"format", .. }, ref rest @ ..] => {
                    encoding = Some(format(&words[0], rest)?)
                }
                [Word { text: b"element", .. }, name, count] => {
                    elements.push(element(name, count)?)
                }
                [Word { text: b"property", .. }, ref rest @ ..] => {
                    let Some(element) = elements.last_mut() else {
                        return Err(words[0]
                            .fault("comes before all elements", "declare its element first"));
                    };
                    element.properties.push(property(&words[0], rest)?);
                }
                [Word { text: b"end_header", .. }] => break,
                [first, ..] => {
                    let help = "a line of a header is `format`, `element NAME COUNT`, `property \
                        TYPE NAME`, \
                        `property list TYPE TYPE NAME`, `comment`, `obj_info` or `end_header`";
                    return Err(first.fault("begins no line of a header", help));
                }
            }
        }
        let help = "add `format ascii 1.0`, `format binary_little_endian 1.0` or `format \
            binary_big_endian 1.0`";
        let encoding =
            encoding.ok_or_else(|| Fault::of_file("the header does not name a format", help))?;
        Ok(Self { encoding, elements, end: lines.at })
    }

    /// Returns the element of that name, or `None` if there is none.
    ///
    /// # Errors
    /// Several elements have that name.
    pub(super) fn element(&self, name: &str) -> Result<Option<&Element<'a>>, Fault> {
        let mut found = self.elements.iter().filter(|element| element.name.text == name.as_bytes());
        let first = found.next();
        match found.next() {
            Some(second) => {
                Err(second.fault("is declared twice", "declare it once, with all of its records"))
            }
            None => Ok(first),
        }
    }
}

/// The lines of a header.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether lines end with CR alone, as the first one does. An LF after `end_header` then
    /// belongs to the numbers.
    ends_with_cr: bool,
}

impl<'a> Lines<'a> {
    /// Number of words of a line that are read: those of a list, and one that would be too many.
    const MOST_WORDS: usize = 6;

    fn new(bytes: &'a [u8], at: usize) -> Self {
        let end = bytes[at..].iter().position(|byte| is_end(*byte)).unwrap_or(0);
        let ends_with_cr = matches!(bytes[at + end..], [b'\r', second, ..] if second != b'\n');
        Self { bytes, at, ends_with_cr }
    }

    /// Returns the words of the next line, or `None` if the file ends before the line does.
    fn next_words(&mut self) -> Option<Vec<Word<'a>>> {
        let (start, rest) = (self.at, &self.bytes[self.at..]);
        let length = rest.iter().position(|byte| is_end(*byte))?;
        self.at +=
            length + if !self.ends_with_cr && rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        let line = &rest[..length];
        let offset = |word: &[u8]| word.as_ptr().addr() - line.as_ptr().addr();
        let words = line.split(|byte| is_blank(*byte)).filter(|word| !word.is_empty());
        Some(
            words
                .take(Self::MOST_WORDS)
                .map(|text| Word { at: start + offset(text), text })
                .collect(),
        )
    }
}

fn format(line: &Word<'_>, rest: &[Word<'_>]) -> Result<Encoding, Fault> {
    let help = "write `format ascii 1.0`, `format binary_little_endian 1.0` or `format \
        binary_big_endian 1.0`";
    match rest.iter().map(|word| word.text).collect::<Vec<_>>()[..] {
        [b"ascii", b"1.0"] => Ok(Encoding::Text),
        [b"binary_little_endian", b"1.0"] => Ok(Encoding::LittleEndian),
        [b"binary_big_endian", b"1.0"] => Ok(Encoding::BigEndian),
        _ => Err(line.fault("is not followed by a format and version that are read", help)),
    }
}

fn element<'a>(name: Word<'a>, count: Word<'a>) -> Result<Element<'a>, Fault> {
    let digits = std::str::from_utf8(count.text)
        .ok()
        .filter(|text| text.bytes().all(|byte| byte.is_ascii_digit()));
    let digits = digits.ok_or_else(|| {
        count.fault("is not a number of records", "give a whole number of at least 0")
    })?;
    // No file can hold `usize::MAX` records, so a larger number need not be exact.
    let n = digits.parse().unwrap_or(usize::MAX);
    Ok(Element { name, count: n, written: count, properties: vec![] })
}

fn property<'a>(line: &Word<'a>, rest: &[Word<'a>]) -> Result<Property<'a>, Fault> {
    match *rest {
        [Word { text: b"list", .. }, count, entry, name, ..] => {
            let is_whole = |kind: &Kind| kind.range().is_some();
            let count_kind = Some(kind(count)?).filter(is_whole).ok_or_else(|| {
                count.fault(
                    "cannot count the entries of a list",
                    "use a type of whole numbers, such as uchar",
                )
            })?;
            Ok(Property { name: name.text, kind: kind(entry)?, count: Some(count_kind) })
        }
        [of, name, ..] if of.text != b"list" => {
            Ok(Property { name: name.text, kind: kind(of)?, count: None })
        }
        _ => Err(line.fault(
            "lacks a type or a name",
            "write `property TYPE NAME` or `property list TYPE TYPE NAME`",
        )),
    }
}

fn kind(word: Word<'_>) -> Result<Kind, Fault> {
    let known = KINDS.iter().find(|(name, _)| name.as_bytes() == word.text);
    known.map(|(_, kind)| *kind).ok_or_else(|| {
        let names = KINDS.map(|(name, _)| name);
        let all = format!("the types are {}", listed(names));
        let meant = did_you_mean(&String::from_utf8_lossy(word.text), names);
        word.fault(
            "is not a type",
            meant.map_or(all.clone(), |meant| format!("did you mean `{meant}`? {all}")),
        )
    })
}
