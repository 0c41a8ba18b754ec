//! Pictures as the 8-bit levels that a PNG holds: an eighth of the memory of light, for pictures too large to be light.

use std::io::Cursor;

use image::{ColorType, DynamicImage, ImageDecoder, codecs::png::PngDecoder};

use super::PictureError;
use super::files::{is_png, limits, png_size};

/// Three bytes a pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue of each pixel.
    pub levels: Vec<u8>,
}

impl Raster {
    /// The picture that `bytes` hold, or `None` where they are no PNG of at most 8 bits a channel, which has other levels.
    ///
    /// Grey and palettes become colours, alpha is ignored, as [`read_exact`](super::read_exact) has it.
    ///
    /// # Errors
    /// More than `max_side` pixels in a row or column, before anything is decoded; a broken file.
    pub fn read(bytes: &[u8], max_side: u32) -> Result<Option<Self>, PictureError> {
        let broken = |why: image::ImageError| PictureError::Broken(why.to_string());
        if !is_png(bytes) {
            return Ok(None);
        }
        if let Some(found) = png_size(bytes).filter(|(width, height)| *width > max_side || *height > max_side) {
            return Err(PictureError::Size { found, wanted: (max_side, max_side) });
        }
        let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits()).map_err(broken)?;
        let (width, height) = decoder.dimensions();
        let levels = match decoder.color_type() {
            ColorType::Rgb8 => {
                let mut levels = vec![0; decoder.total_bytes() as usize];
                decoder.read_image(&mut levels).map_err(broken)?;
                levels
            }
            ColorType::L8 | ColorType::La8 | ColorType::Rgba8 => {
                DynamicImage::from_decoder(decoder).map_err(broken)?.into_rgb8().into_raw()
            }
            _ => return Ok(None),
        };
        Ok(Some(Self { width, height, levels }))
    }

    /// The levels of a row from the top, three a pixel.
    pub fn row(&self, j: u32) -> &[u8] {
        let n = self.width as usize * 3;
        &self.levels[j as usize * n..][..n]
    }
}
