//! Reads a picture row by row, so that a large one need not be held in memory.

use std::io::{Read, Seek, SeekFrom};

use glam::DVec3;

use super::encode::{of_words, words};
use super::pfm::{Header, MOST_HEADER};
use super::png::{PngRows, size_of};
use super::signature::{self, Signature};
use super::{Image, PictureError};

/// An open picture from which rows are read, the top row first.
pub struct Rows<R: Read + Seek> {
    size: (u32, u32),
    source: Source<R>,
}

/// A source of rows.
enum Source<R: Read + Seek> {
    Png(PngRows<R>),
    /// All pixels in memory, the number of 16-bit levels of a sample of 1, and the index of the
    /// next pixel.
    Held(Vec<[f32; 3]>, f64, usize),
}

/// A function that refuses sizes before memory is allocated. The flag says whether the whole
/// picture must be held.
type Admit<'a> = &'a dyn Fn((u32, u32), bool) -> Result<(), PictureError>;

impl<R: Read + Seek> Rows<R> {
    /// Opens the PNG or PFM in `file`, which must have the size `wanted`.
    pub(super) fn open_exact(mut file: R, wanted: (u32, u32)) -> Result<Self, PictureError> {
        let read = "PNG or PFM";
        let (head, kind) = look(&mut file, read)?;
        if kind == Signature::Exr {
            return Err(PictureError::Foreign {
                read,
                found: "these are the bytes of an OpenEXR file",
            });
        }
        let admit = |found, _| {
            if found == wanted { Ok(()) } else { Err(PictureError::Size { found, wanted }) }
        };
        Self::plain(file, &head, kind, &admit)
    }

    /// Opens a PNG or a PFM that begins with `head`.
    pub(super) fn plain(
        mut file: R,
        head: &[u8],
        kind: Signature,
        admit: Admit,
    ) -> Result<Self, PictureError> {
        let admit = |found, is_held| admit(found, is_held).and_then(|()| has_pixels(found));
        if kind == Signature::Png {
            size_of(head)
                .filter(|size| has_pixels(*size).is_err())
                .map_or(Ok(()), |size| admit(size, false))?;
            let rows = PngRows::open(file, &admit)?;
            return Ok(Self { size: rows.size, source: Source::Png(rows) });
        }
        let header = Header::parse(head)?;
        admit(header.size, true)?;
        let length = file.seek(SeekFrom::End(0))?;
        file.seek(SeekFrom::Start(header.start(head, length)?))?;
        Ok(Self::held(header.size, header.pixels(file)?, words(1.0)))
    }

    /// Returns a picture of pixels in memory. A sample of 1 is `unit` 16-bit levels.
    pub(super) fn held(size: (u32, u32), pixels: Vec<[f32; 3]>, unit: f64) -> Self {
        Self { size, source: Source::Held(pixels, unit, 0) }
    }

    /// Returns width and height.
    pub fn size(&self) -> (u32, u32) {
        self.size
    }

    /// Returns whether every sample is one of 256 levels, so that [`bytes`](Self::bytes) works.
    pub fn has_bytes(&self) -> bool {
        matches!(&self.source, Source::Png(rows) if !rows.is_deep)
    }

    /// Fills `levels` with the next rows in 8-bit levels: red, green and blue of each pixel.
    ///
    /// # Errors
    /// The file is damaged, its samples are not bytes, or there are no more rows.
    pub fn bytes(&mut self, levels: &mut [u8]) -> Result<(), PictureError> {
        match &mut self.source {
            Source::Png(rows) if !rows.is_deep => levels
                .chunks_exact_mut(self.size.0 as usize * 3)
                .try_for_each(|row| rows.bytes(row)),
            _ => Err(PictureError::Broken("its samples are not bytes".to_owned())),
        }
    }

    /// Fills `levels` with the next rows in 16-bit levels, where light of 1 is 65,535.
    ///
    /// No sample of any kind of file is rounded or clamped.
    ///
    /// # Errors
    /// The file is damaged, or there are no more rows.
    pub fn words(&mut self, levels: &mut [f64]) -> Result<(), PictureError> {
        match &mut self.source {
            Source::Png(rows) => levels
                .chunks_exact_mut(self.size.0 as usize * 3)
                .try_for_each(|row| rows.words(row)),
            Source::Held(pixels, unit, at) => {
                let rest = pixels.get(*at..*at + levels.len() / 3);
                let rest =
                    rest.ok_or_else(|| PictureError::Broken("it has no more rows".to_owned()))?;
                let samples = rest.as_flattened().iter().map(|sample| f64::from(*sample) * *unit);
                levels.iter_mut().zip(samples).for_each(|(to, from)| *to = from);
                *at += rest.len();
                Ok(())
            }
        }
    }

    /// Reads the whole picture in linear light.
    ///
    /// # Errors
    /// The file is damaged, or rows were already taken.
    pub fn into_image(mut self) -> Result<Image, PictureError> {
        let (width, height) = self.size;
        let mut pixels = vec![]; // grows with the rows in the file: the header is not trusted
        let mut row = vec![0.0; width as usize * 3];
        for _ in 0..height {
            self.words(&mut row)?;
            pixels.extend(
                row.as_chunks::<3>().0.iter().map(|levels| DVec3::from_array(levels.map(of_words))),
            );
        }
        Image::from_pixels(width, height, pixels)
            .ok_or_else(|| PictureError::Broken("pixels are missing".to_owned()))
    }
}

/// Returns the first bytes of `file` and the kind of picture that they belong to.
pub(super) fn look(
    file: &mut (impl Read + Seek),
    read: &'static str,
) -> Result<(Vec<u8>, Signature), PictureError> {
    let mut head = vec![];
    file.by_ref().take(MOST_HEADER as u64).read_to_end(&mut head)?;
    file.rewind()?;
    let kind = signature::of(&head, read)?;
    Ok((head, kind))
}

/// Checks that a picture of this size has pixels.
pub(super) fn has_pixels((width, height): (u32, u32)) -> Result<(), PictureError> {
    match width.min(height) {
        0 => {
            Err(PictureError::Broken(format!("it is {width}×{height} pixels, which is no picture")))
        }
        _ => Ok(()),
    }
}
