//! Reads and writes PNG files. They may have 1 to 16 bits, be grey, paletted or coloured, and be
//! interlaced or not. Alpha is ignored.
//!
//! All readers of PNGs use this one, so that they agree on what is damaged. The CRC of every chunk
//! must be right, and the end mark (IEND) must be there. The check sum within the compressed pixels
//! is ignored, because the CRC covers the same bytes. Bytes after the end mark are ignored. An
//! animation counts as its still picture.

use std::io::{BufReader, ErrorKind, Read, Seek};

use ::png::{
    BitDepth, ColorType, Compression, DecodeOptions, Decoder, DecodingError, Encoder, Filter,
    Limits, Reader,
};
use ::png::{EncodingError, Transformations};

use super::encode::WORDS_IN_BYTE;
use super::{Image, PictureError};

/// Largest size of a chunk other than the pixels, in bytes.
const MOST_CHUNK: usize = 8 << 20;
/// Bytes that are read from a file at a time. All callers use the same number, so that the decoder
/// gives all of them the same verdict.
const PIECE: usize = 1 << 16;

/// A decoder of the rows of a PNG, the top row first.
pub(super) struct PngRows<R: Read + Seek> {
    /// Width and height.
    pub(super) size: (u32, u32),
    /// Whether a sample has two bytes, the high one first.
    pub(super) is_deep: bool,
    n_channels: usize,
    source: Source<R>,
    /// Buffer for a row with all its channels.
    row: Vec<u8>,
}

/// A source of rows with all their channels.
enum Source<R: Read + Seek> {
    /// A decoder of one row at a time, and the number of rows that are left.
    Stream(Box<Reader<BufReader<R>>>, u32),
    /// All rows, decoded at once because an interlaced file stores them in another order, and the
    /// index at which the next row begins.
    Held(Vec<u8>, usize),
}

impl<R: Read + Seek> PngRows<R> {
    /// Opens the PNG in `file`.
    ///
    /// Before memory is allocated, `admit` may refuse the size. Its flag says whether the whole
    /// picture must be held.
    pub(super) fn open(
        file: R,
        admit: &dyn Fn((u32, u32), bool) -> Result<(), PictureError>,
    ) -> Result<Self, PictureError> {
        let mut options = DecodeOptions::default();
        options.set_skip_ancillary_crc_failures(false);
        options.set_ignore_text_chunk(true);
        options.set_ignore_iccp_chunk(true);
        let mut decoder = Decoder::new_with_options(BufReader::with_capacity(PIECE, file), options);
        decoder.set_limits(Limits { bytes: MOST_CHUNK });
        decoder.set_transformations(Transformations::EXPAND);
        let info = decoder.read_header_info().map_err(damaged)?;
        let (size, is_held) = (info.size(), info.interlaced);
        admit(size, is_held)?;
        let mut reader = decoder.read_info().map_err(damaged)?;
        let (colour, depth) = reader.output_color_type();
        let (is_deep, n_channels) = (depth == BitDepth::Sixteen, colour.samples());
        let row = vec![0; size.0 as usize * n_channels * if is_deep { 2 } else { 1 }];
        let source = match is_held {
            false => Source::Stream(Box::new(reader), size.1),
            true => {
                let mut held = vec![0; row.len() * size.1 as usize];
                reader.next_frame(&mut held).and_then(|_| reader.finish()).map_err(damaged)?;
                Source::Held(held, 0)
            }
        };
        Ok(Self { size, is_deep, n_channels, source, row })
    }

    /// Fills `row` with the next row of a PNG that is not deep: red, green and blue of each pixel.
    pub(super) fn bytes(&mut self, row: &mut [u8]) -> Result<(), PictureError> {
        if self.n_channels == 3 {
            return self.source.next(row);
        }
        self.source.next(&mut self.row)?;
        for (pixel, channels) in row.chunks_exact_mut(3).zip(self.row.chunks_exact(self.n_channels))
        {
            pixel.copy_from_slice(&rgb(self.n_channels).map(|at| channels[at]));
        }
        Ok(())
    }

    /// Fills `row` with the next row in 16-bit levels: red, green and blue of each pixel.
    pub(super) fn words(&mut self, row: &mut [f64]) -> Result<(), PictureError> {
        self.source.next(&mut self.row)?;
        let at = rgb(self.n_channels);
        if self.is_deep {
            let samples = self.row.as_chunks::<2>().0;
            for (pixel, channels) in
                row.chunks_exact_mut(3).zip(samples.chunks_exact(self.n_channels))
            {
                pixel.copy_from_slice(&at.map(|at| f64::from(u16::from_be_bytes(channels[at]))));
            }
        } else {
            for (pixel, channels) in
                row.chunks_exact_mut(3).zip(self.row.chunks_exact(self.n_channels))
            {
                pixel.copy_from_slice(&at.map(|at| f64::from(channels[at]) * WORDS_IN_BYTE));
            }
        }
        Ok(())
    }
}

/// Returns the indices of the channels that are red, green and blue.
fn rgb(n_channels: usize) -> [usize; 3] {
    if n_channels < 3 { [0; 3] } else { [0, 1, 2] }
}

impl<R: Read + Seek> Source<R> {
    fn next(&mut self, row: &mut [u8]) -> Result<(), PictureError> {
        let none = || PictureError::Broken("it has no more rows".to_owned());
        match self {
            Self::Stream(reader, n_left) => {
                *n_left = n_left.checked_sub(1).ok_or_else(none)?;
                reader.read_row(row).map_err(damaged)?.ok_or_else(none)?;
                if *n_left == 0 { reader.finish().map_err(damaged) } else { Ok(()) }
            }
            Self::Held(held, at) => {
                row.copy_from_slice(held.get(*at..*at + row.len()).ok_or_else(none)?);
                *at += row.len();
                Ok(())
            }
        }
    }
}

/// Returns width and height, which are at a fixed offset, or `None` if `head` is too short.
pub(super) fn size_of(head: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| Some(u32::from_be_bytes(head.get(at..at + 4)?.try_into().ok()?));
    Some((number(16)?, number(20)?))
}

fn damaged(why: DecodingError) -> PictureError {
    match why {
        DecodingError::IoError(why) if why.kind() == ErrorKind::UnexpectedEof => {
            PictureError::Broken("the PNG ends early, before its end mark (IEND)".to_owned())
        }
        DecodingError::IoError(why) => PictureError::Io(why),
        DecodingError::LimitsExceeded => PictureError::Broken(format!(
            "a part of the PNG beside its pixels has more than {MOST_CHUNK} bytes"
        )),
        other => PictureError::Broken(format!("the PNG is damaged: {}", plain(&other.to_string()))),
    }
}

/// Replaces the `Debug` form of a chunk's type in the text of an error by its letters.
fn plain(text: &str) -> String {
    let found = text.split_once("ChunkType { type: ").and_then(|(before, rest)| {
        let (kind, rest) = rest.split_once(',')?;
        Some(format!("{before}{kind}{}", rest.split_once(" }")?.1))
    });
    found.unwrap_or_else(|| text.to_owned())
}

/// Encodes an RGB picture whose samples have `N` bytes, the high one first.
pub(super) fn encode<const N: usize>(
    image: &Image,
    level: impl Fn(f64) -> [u8; N],
) -> Result<Vec<u8>, PictureError> {
    let mut levels = Vec::with_capacity(image.pixels().len() * 3 * N);
    for pixel in image.pixels() {
        levels.extend_from_slice(pixel.to_array().map(&level).as_flattened());
    }
    let mut out = Vec::new();
    let mut encoder = Encoder::new(&mut out, image.width(), image.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(if N == 1 { BitDepth::Eight } else { BitDepth::Sixteen });
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let wrong = |why: EncodingError| PictureError::Broken(why.to_string());
    let mut writer = encoder.write_header().map_err(wrong)?;
    writer.write_image_data(&levels).and_then(|()| writer.finish()).map_err(wrong)?;
    Ok(out)
}
