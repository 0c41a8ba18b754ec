//! Opens pictures of any kind and size, for commands that compare them.

use std::io::{Read, Seek, SeekFrom};

use super::encode::words;
use super::pfm::{Header, MOST_HEADER};
use super::rows::{has_pixels, look};
use super::signature::{self, Signature};
use super::{PictureError, Rows, exr};
use crate::answer;

/// Largest number of pixels in a row of a picture, and of rows.
const MOST_SIDE: u32 = 16_384;
/// Largest number of pixels of a picture that must be held in memory.
const MOST_HELD: u64 = 1 << 26;
/// Largest size, in bytes, of a file without a length in its header: 16 times what a submission may
/// write.
const MOST_BYTES: u64 = 16 * (64 << 20);
/// Bytes beyond the expected end of a stream that are read, so that an error can count them.
const SURPLUS: u64 = 1 << 16;
const READ: &str = "PNG, PFM or EXR";

impl<R: Read + Seek> Rows<R> {
    /// Opens the picture in `file`. The first bytes decide its kind.
    ///
    /// A PNG and a PFM are read as by [`read_exact`](super::read_exact). Of an EXR file, the planes
    /// `R`, `G` and `B` of the first part are read, which are the expected picture in a stored
    /// answer. A picture may have 16,384 pixels a side. It may have 2²⁶ pixels in all, unless it is
    /// a PNG that is not interlaced.
    ///
    /// # Errors
    /// [`PictureError`]; a size beyond the limits is an error before memory is allocated.
    pub fn open(mut file: R) -> Result<Self, PictureError> {
        let (head, kind) = look(&mut file, READ)?;
        if kind != Signature::Exr {
            return Self::plain(file, &head, kind, &admit);
        }
        let length = file.seek(SeekFrom::End(0))?;
        if length > MOST_BYTES {
            return Err(PictureError::Broken(format!(
                "it has {length} bytes; at most {MOST_BYTES} can be read"
            )));
        }
        file.rewind()?;
        let mut bytes = vec![];
        file.take(MOST_BYTES).read_to_end(&mut bytes)?;
        let shown =
            exr::decode_rgb(&bytes, |size| admit(size, true).and_then(|()| has_pixels(size)))?;
        Ok(Self::held(shown.size, shown.pixels, words(1.0) / answer::full_light(&shown.part)))
    }
}

/// Returns how many bytes of a stream have to be read at most if it begins with `head`.
///
/// `head` has 4,096 bytes, or all bytes of a shorter stream.
///
/// # Errors
/// The first bytes are not those of a picture, or state a size beyond the limits of [`Rows::open`].
pub fn most_bytes(head: &[u8]) -> Result<u64, PictureError> {
    if signature::of(head, READ)? != Signature::Pfm {
        return Ok(MOST_BYTES);
    }
    let header = Header::parse(head)?;
    admit(header.size, true)?;
    Ok(header.n_bytes() + MOST_HEADER as u64 + SURPLUS)
}

fn admit(found: (u32, u32), is_held: bool) -> Result<(), PictureError> {
    let too_large = |most| Err(PictureError::TooLarge { found, most });
    match found {
        (width, height) if width.max(height) > MOST_SIDE => {
            too_large(format!("{MOST_SIDE}×{MOST_SIDE}"))
        }
        (width, height) if is_held && u64::from(width) * u64::from(height) > MOST_HELD => {
            too_large(format!("{MOST_HELD} pixels of this kind"))
        }
        _ => Ok(()),
    }
}
