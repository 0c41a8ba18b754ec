//! The statements of a Wavefront file that make a mesh.

use glam::DVec3;

use super::scan::{Scan, is_used};
use crate::scene::mesh::fault::{Fault, Place};
use crate::scene::mesh::text::{Word, beginning, real, whole};

/// Index of a corner's normal if it has none.
pub(super) const NONE: u32 = u32::MAX;

const CORNERS: &str = "a corner is written v, v/vt, v//vn or v/vt/vn, each of them a whole number";
/// Largest count of numbers after the three of a vertex: a weight, or a colour with its opacity, or
/// both.
const MOST_BEHIND: usize = 5;
pub(super) const INDICES: &str = "indices count from 1; negative ones count back from the latest";

/// The statements of a file that make a mesh.
pub(super) struct Obj<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    /// The corners of all faces.
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    /// The first statement that draws something other than faces.
    pub(super) other: Option<Word<'a>>,
}

/// A corner of a face. Its indices, from 0, may be too large, because they can name later vertices.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) normal: u32,
}

pub(super) struct Face {
    /// End of its corners in the list of all corners.
    pub(super) end: usize,
    /// Offset of the statement.
    pub(super) at: usize,
}

impl<'a> Obj<'a> {
    /// Reads the statements of a file. The normals are read only if `with_normals`.
    pub(super) fn read(bytes: &'a [u8], with_normals: bool) -> Result<Self, Fault> {
        let mut obj = Self {
            bytes,
            positions: vec![],
            normals: vec![],
            corners: vec![],
            faces: vec![],
            other: None,
        };
        let mut scan = Scan::new(bytes, beginning(bytes)?);
        while let Some(keyword) = scan.keyword() {
            match keyword.text {
                b"v" => obj.positions.push(vector(&mut scan, keyword)?),
                b"vn" if with_normals => obj.normals.push(vector(&mut scan, keyword)?),
                b"f" | b"fo" => obj.face(&mut scan, keyword, with_normals)?,
                _ => {
                    obj.check_unused(keyword)?;
                    scan.skip();
                }
            }
        }
        Ok(obj)
    }

    /// Adds a face with the corners that follow.
    fn face(
        &mut self,
        scan: &mut Scan<'a>,
        keyword: Word<'a>,
        with_normals: bool,
    ) -> Result<(), Fault> {
        let start = self.corners.len();
        while let Some(word) = scan.word() {
            let mut parts = word.text.split(|byte| *byte == b'/');
            let position = index(word, parts.next(), "vertex", self.positions.len())?;
            let normal = match parts.nth(1) {
                Some([]) | None => NONE,
                Some(_) if !with_normals => NONE,
                normal => index(word, normal, "normal", self.normals.len())?,
            };
            if parts.next().is_some() {
                return Err(word.fault("is not a corner of a face", CORNERS));
            }
            self.corners.push(Corner { position, normal });
        }
        if self.corners.len() - start < 3 {
            // A face without an area, which some programs write for an edge.
            self.corners.truncate(start);
            self.other = self.other.or(Some(keyword));
            return Ok(());
        }
        self.faces.push(Face { end: self.corners.len(), at: keyword.at });
        Ok(())
    }

    /// Records a statement that is not used. Fails if its keyword shows that something is lost.
    fn check_unused(&mut self, keyword: Word<'a>) -> Result<(), Fault> {
        let text = keyword.text;
        let of_lower_case = text.to_ascii_lowercase();
        match text {
            b"l" | b"p" | b"curv" | b"curv2" | b"surf" => self.other = self.other.or(Some(keyword)),
            b"call" => {
                return Err(keyword.fault("reads another file", "put everything into one file"));
            }
            _ if text.contains(&0) => {
                let help =
                    "the file is damaged, binary or UTF-16; save it as UTF-8, or as plain ASCII";
                return Err(keyword.fault("holds a NUL byte", help));
            }
            [b'0'..=b'9' | b'+' | b'-' | b'.', ..] => {
                let help = "a line begins with a keyword such as v, vn or f, unless the line \
                    before it ends with \\";
                return Err(keyword.fault("is not a keyword", help));
            }
            _ if !text.is_ascii() => {
                let help = "write keywords in plain ASCII; a byte order mark belongs at the start \
                    of the file";
                return Err(keyword.fault("is not a keyword", help));
            }
            _ if of_lower_case != text && is_used(&of_lower_case) => {
                return Err(keyword.fault("is not a keyword", "write v, vn and f in lower case"));
            }
            _ => {}
        }
        Ok(())
    }

    /// Returns the place of the `n`-th statement with this keyword, from 0, or else the file.
    pub(super) fn statement(&self, wanted: &[u8], n: u32) -> Place {
        let mut scan = Scan::new(self.bytes, beginning(self.bytes).unwrap_or(0));
        let mut left = n;
        while let Some(keyword) = scan.keyword() {
            match keyword.text == wanted {
                true if left == 0 => return Place::Text(keyword.at),
                true => left -= 1,
                false => {}
            }
            if is_used(keyword.text) {
                while scan.word().is_some() {}
            } else {
                scan.skip();
            }
        }
        Place::File
    }
}

/// Reads the three numbers of a statement that has only numbers.
///
/// Up to [`MOST_BEHIND`] others may follow: a weight, and the parts of a colour. A word among them
/// shows that the next statement was joined to this one, which would lose it.
fn vector(scan: &mut Scan<'_>, keyword: Word<'_>) -> Result<DVec3, Fault> {
    let vector = three(scan, keyword)?;
    let mut n_behind = 0;
    while let Some(word) = scan.word() {
        n_behind += 1;
        if n_behind > MOST_BEHIND || real(word.text).is_none() {
            let help =
                "begin a new line for each statement, without \\ at the end of the line before it";
            return Err(word.fault("does not belong to this statement", help));
        }
    }
    Ok(vector)
}

/// Reads the next three numbers of a statement.
fn three(scan: &mut Scan<'_>, keyword: Word<'_>) -> Result<DVec3, Fault> {
    let mut numbers = [0.0; 3];
    for (n, number) in numbers.iter_mut().enumerate() {
        let Some(word) = scan.word() else {
            let name = String::from_utf8_lossy(keyword.text);
            let what = format!("`{name}` has {n} numbers here");
            return Err(Fault::at(
                scan.at(),
                what,
                format!("`{name}` needs three numbers, such as `{name} 0 0.5 -1e3`"),
            ));
        };
        *number = real(word.text)
            .ok_or_else(|| word.fault("is not a number", "write it as 1, -2.5 or 1e-3"))?;
    }
    Ok(DVec3::from_array(numbers))
}

/// Returns the index from 0 that a part of a corner means. `n_before` vertices or normals have come
/// before.
fn index(word: Word<'_>, part: Option<&[u8]>, kind: &str, n_before: usize) -> Result<u32, Fault> {
    let Some(number) = part.and_then(whole) else {
        return Err(word.fault("is not a corner of a face", CORNERS));
    };
    let index = match number {
        0 => None,
        1.. => Some(number - 1),
        _ => Some(n_before as i64 + number).filter(|index| *index >= 0),
    };
    index.and_then(|index| u32::try_from(index).ok()).filter(|index| *index != NONE).ok_or_else(
        || {
            Fault::at(
                word.at,
                format!("there is no {kind} {number}: {n_before} come before this face"),
                INDICES,
            )
        },
    )
}
