//! Writes pictures by kind, and reads a picture whose size is known.

use std::io::{self, Cursor};
use std::path::Path;

use super::{Image, PictureError, Quantiser, Rows, pfm, png};
use crate::files::{self, WriteError};

/// A kind of picture file that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 8 bits a channel when written; any PNG is read.
    Png,
    /// A PNG of 16 bits a channel.
    DeepPng,
    /// Linear float.
    Pfm,
}

impl Kind {
    /// Returns the kind for the extension of `path`, or `None` for another extension.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "pfm" => Some(Self::Pfm),
            _ => None,
        }
    }
}

/// Writes `image` to `path`, as a PNG or a PFM by the extension. The file is replaced whole.
///
/// # Errors
/// The extension is not that of a [`Kind`], or [`files::write`] fails.
pub fn write(path: &Path, image: &Image) -> Result<(), PictureError> {
    let kind = Kind::of(path).ok_or_else(|| WriteError {
        name: path.to_owned(),
        is_untouched: true,
        source: io::Error::new(io::ErrorKind::InvalidInput, "the name must end in .png or .pfm"),
    })?;
    Ok(files::write(path, &encode(kind, image)?)?)
}

/// Encodes a picture as a file of that kind. Light is rounded to the nearest level.
///
/// # Errors
/// The picture has no pixels, or the encoder fails.
pub fn encode(kind: Kind, image: &Image) -> Result<Vec<u8>, PictureError> {
    encode_by(Quantiser::Rounding, kind, image)
}

/// Encodes a picture as a file of that kind. `quantiser` converts light to levels, unless the file
/// holds floats.
///
/// # Errors
/// The picture has no pixels, or the encoder fails.
pub fn encode_by(quantiser: Quantiser, kind: Kind, image: &Image) -> Result<Vec<u8>, PictureError> {
    demand_pixels(image)?;
    match kind {
        Kind::Png => png::encode(image, |light| [quantiser.byte(light)]),
        Kind::DeepPng => png::encode(image, |light| quantiser.word(light).to_be_bytes()),
        Kind::Pfm => Ok(pfm::encode(image)),
    }
}

/// Reads the picture in `bytes`, which must be `width` × `height` pixels.
///
/// The first bytes decide the kind. A PNG may have any depth, a palette, and alpha, which is
/// ignored; the level n of an 8-bit file is light of n/255. A PFM holds linear light, which may be
/// NaN or infinite; only the sign of its scale is used.
///
/// # Errors
/// [`PictureError`]: the picture has another size or kind, or it is damaged. A PNG with a wrong CRC
/// or without its end mark is damaged. The size is checked before memory is allocated.
pub fn read_exact(bytes: &[u8], width: u32, height: u32) -> Result<Image, PictureError> {
    Rows::open_exact(Cursor::new(bytes), (width, height))?.into_image()
}

fn demand_pixels(image: &Image) -> Result<(), PictureError> {
    match image.pixels().is_empty() {
        true => Err(PictureError::Broken(format!(
            "a picture of {}×{} pixels has none",
            image.width(),
            image.height()
        ))),
        false => Ok(()),
    }
}
