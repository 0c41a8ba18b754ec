//! PNGs read row by row as the 8-bit levels that they hold: for pictures too large to be light, or to be held at all.

use std::io::{BufRead, Seek};

use png::{BitDepth, ColorType, Decoder, Limits, Reader, Transformations};

use super::PictureError;
use super::files::{MAX_CHUNKS, is_png, png_size};

/// Bytes at the head of a PNG that give its size away.
const HEAD: usize = 24;

/// A PNG of at most 8 bits a channel, from which rows are taken, the top one first.
pub struct Rows<R: BufRead + Seek> {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    n_channels: usize,
    source: Source<R>,
    /// A row with all its channels.
    row: Vec<u8>,
}

/// Where rows come from.
enum Source<R: BufRead + Seek> {
    /// Decoded as they are asked for.
    Stream(Box<Reader<R>>),
    /// Decoded at once, since an interlaced file holds its rows in another order; what is left of them, and where that begins.
    Held(Vec<u8>, usize),
}

impl<R: BufRead + Seek> Rows<R> {
    /// The rows of the picture in `file`, or `None` where it is no PNG of at most 8 bits a channel, which has other levels.
    ///
    /// Grey and palettes become colours, alpha is ignored, as [`read_exact`](super::read_exact) has it.
    ///
    /// # Errors
    /// More than `max_side` pixels in a row or column, before anything is decoded; a broken file.
    pub fn open(mut file: R, max_side: u32) -> Result<Option<Self>, PictureError> {
        let head = file.fill_buf()?;
        if !is_png(head) {
            return Ok(None);
        }
        let size = head.get(..HEAD).and_then(png_size);
        if let Some(found) = size.filter(|(width, height)| *width > max_side || *height > max_side) {
            return Err(PictureError::Size { found, wanted: (max_side, max_side) });
        }
        let mut decoder = Decoder::new_with_limits(file, Limits { bytes: MAX_CHUNKS });
        decoder.set_transformations(Transformations::EXPAND);
        let mut reader = decoder.read_info().map_err(broken)?;
        let (colour, depth) = reader.output_color_type();
        if depth != BitDepth::Eight {
            return Ok(None);
        }
        let info = reader.info();
        let (width, height, n_channels) = (info.width, info.height, colour.samples());
        let row = vec![0; width as usize * n_channels];
        let source = match info.interlaced {
            false => Source::Stream(Box::new(reader)),
            true => {
                let mut held = vec![0; row.len() * height as usize];
                reader.next_frame(&mut held).map_err(broken)?;
                Source::Held(held, 0)
            }
        };
        debug_assert!(colour != ColorType::Indexed, "palettes are expanded");
        Ok(Some(Self { width, height, n_channels, source, row }))
    }

    /// Fills `levels` with the next rows: red, green, blue of each pixel, row after row.
    ///
    /// # Errors
    /// A broken file, or one that has no more such rows.
    pub fn read(&mut self, levels: &mut [u8]) -> Result<(), PictureError> {
        for row in levels.chunks_mut(self.width as usize * 3) {
            if self.n_channels == 3 {
                self.source.next(row)?;
                continue;
            }
            self.source.next(&mut self.row)?;
            for (pixel, channels) in row.chunks_exact_mut(3).zip(self.row.chunks_exact(self.n_channels)) {
                pixel.copy_from_slice(&if self.n_channels < 3 {
                    [channels[0]; 3]
                } else {
                    [channels[0], channels[1], channels[2]]
                });
            }
        }
        Ok(())
    }
}

impl<R: BufRead + Seek> Source<R> {
    fn next(&mut self, row: &mut [u8]) -> Result<(), PictureError> {
        match self {
            Self::Stream(reader) => match reader.read_row(row).map_err(broken)? {
                Some(_) => Ok(()),
                None => Err(PictureError::Broken("rows are missing".to_owned())),
            },
            Self::Held(held, at) => {
                let next = held.get(*at..*at + row.len());
                row.copy_from_slice(next.ok_or_else(|| PictureError::Broken("rows are missing".to_owned()))?);
                *at += row.len();
                Ok(())
            }
        }
    }
}

fn broken(why: png::DecodingError) -> PictureError {
    PictureError::Broken(why.to_string())
}
