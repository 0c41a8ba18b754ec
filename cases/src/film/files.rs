//! Image files: written whole or not at all, read with their size demanded before memory is taken.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;
use image::{ColorType, DynamicImage, ImageDecoder, ImageEncoder, codecs::png};

use super::{Image, Quantiser};

/// The kinds of file that hold a picture of ours.
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
    /// By the extension of `path`, `None` for another one.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "pfm" => Some(Self::Pfm),
            _ => None,
        }
    }
}

/// Why a file is no picture of the size that was asked for.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The bytes are of no kind that is read here; says what they look like.
    #[error("not a PNG or PFM image: {0}")]
    Foreign(String),
    /// The header promises another size; nothing was decoded.
    #[error("it is {}×{} pixels, not {}×{}", found.0, found.1, wanted.0, wanted.1)]
    Size {
        /// What the file says.
        found: (u32, u32),
        /// What was asked for.
        wanted: (u32, u32),
    },
    /// The right kind, but broken.
    #[error("it cannot be decoded: {0}")]
    Broken(String),
    /// The file cannot be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Writes `image` to `path`, as PNG or PFM by its extension; the file appears whole or not at all.
///
/// # Errors
/// An extension other than those of [`Kind`], or what the file system says.
pub fn write(path: &Path, image: &Image) -> Result<(), PictureError> {
    let kind = Kind::of(path).ok_or_else(|| PictureError::Foreign("the name must end in .png or .pfm".to_owned()))?;
    Ok(replace(path, &encode(kind, image)?)?)
}

/// The bytes of a file of that kind, light rounded to the nearest level.
///
/// # Errors
/// What the encoder says.
pub fn encode(kind: Kind, image: &Image) -> Result<Vec<u8>, PictureError> {
    encode_by(Quantiser::Rounding, kind, image)
}

/// The bytes of a file of that kind, light brought to levels by `quantiser`; a file of floats has none.
///
/// # Errors
/// What the encoder says.
pub fn encode_by(quantiser: Quantiser, kind: Kind, image: &Image) -> Result<Vec<u8>, PictureError> {
    match kind {
        Kind::Png => encode_png(image, image::ExtendedColorType::Rgb8, |light| [quantiser.byte(light)]),
        Kind::DeepPng => {
            encode_png(image, image::ExtendedColorType::Rgb16, |light| quantiser.word(light).to_ne_bytes())
        }
        Kind::Pfm => Ok(encode_pfm(image)),
    }
}

/// Neighbours made so far: two threads that put the same file must not share one.
static PARTS: AtomicU64 = AtomicU64::new(0);

/// Puts `bytes` at `path` by way of a neighbour, so that a reader sees the old file or the new one, never a part.
///
/// # Errors
/// What the file system says; `path` is then as it was.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}-{}.part", std::process::id(), PARTS.fetch_add(1, Ordering::Relaxed)));
    let part = path.with_file_name(name);
    let written = File::create(&part).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written.and_then(|()| std::fs::rename(&part, path)).inspect_err(|_| {
        let _ = std::fs::remove_file(&part);
    })
}

/// The picture that `bytes` hold, demanded to be `width` × `height` before anything is decoded.
///
/// The kind is told by the bytes, not by a name. PNG: any depth, grey, palette, alpha (which is ignored); a level n of an 8-bit
/// file is n/255. PFM: linear light as it stands, NaN and infinity included.
///
/// # Errors
/// [`PictureError`]; never a panic, and never more memory than a picture of that size needs.
pub fn read_exact(bytes: &[u8], width: u32, height: u32) -> Result<Image, PictureError> {
    match bytes {
        _ if is_png(bytes) => decode_png(bytes, (width, height)),
        [b'P', b'F' | b'f', b'\n' | b'\r' | b' ', ..] => decode_pfm(bytes, (width, height)),
        _ => Err(PictureError::Foreign(describe(bytes))),
    }
}

fn describe(bytes: &[u8]) -> String {
    let name = match bytes {
        [] => "the file is empty",
        [b'B', b'M', ..] => "these are the bytes of a BMP",
        [0xff, 0xd8, ..] => "these are the bytes of a JPEG",
        [b'G', b'I', b'F', ..] => "these are the bytes of a GIF",
        [b'P', b'1'..=b'6', ..] => "these are the bytes of a PPM, PGM or PBM",
        [b'q', b'o', b'i', b'f', ..] => "these are the bytes of a QOI",
        [b'<', ..] => "these are the bytes of a text or an SVG",
        _ => "no known kind of image begins with these bytes",
    };
    name.to_owned()
}

/// `levels` are the bytes of a channel; of two the encoder wants them in the machine's own order.
fn encode_png<const N: usize>(
    image: &Image,
    colour: image::ExtendedColorType,
    levels: impl Fn(f64) -> [u8; N],
) -> Result<Vec<u8>, PictureError> {
    let mut bytes = Vec::with_capacity(image.pixels().len() * 3 * N);
    for pixel in image.pixels() {
        bytes.extend_from_slice(pixel.to_array().map(&levels).as_flattened());
    }
    let mut out = Vec::new();
    png::PngEncoder::new_with_quality(&mut out, png::CompressionType::Fast, png::FilterType::Adaptive)
        .write_image(&bytes, image.width(), image.height(), colour)
        .map_err(|why| PictureError::Broken(why.to_string()))?;
    Ok(out)
}

fn decode_png(bytes: &[u8], wanted: (u32, u32)) -> Result<Image, PictureError> {
    let broken = |why: image::ImageError| PictureError::Broken(why.to_string());
    if let Some(found) = png_size(bytes).filter(|found| *found != wanted) {
        return Err(PictureError::Size { found, wanted });
    }
    let decoder = png::PngDecoder::with_limits(Cursor::new(bytes), limits()).map_err(broken)?;
    if decoder.dimensions() != wanted {
        return Err(PictureError::Size { found: decoder.dimensions(), wanted });
    }
    let is_deep =
        matches!(decoder.color_type(), ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16);
    let decoded = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let pixels = if is_deep {
        decoded.to_rgb16().pixels().map(|p| levels(p.0.map(f64::from), 65535.0)).collect()
    } else {
        decoded.to_rgb8().pixels().map(|p| levels(p.0.map(f64::from), 255.0)).collect()
    };
    Image::from_pixels(wanted.0, wanted.1, pixels).ok_or_else(|| PictureError::Broken("pixels are missing".to_owned()))
}

/// Bytes that chunks beside the pixels, a colour profile say, may take when they are inflated.
pub(super) const MAX_CHUNKS: usize = 8 << 20;

fn limits() -> image::Limits {
    let mut limits = image::Limits::no_limits();
    limits.max_alloc = Some(MAX_CHUNKS as u64);
    limits
}

/// Whether the bytes begin as those of a PNG do.
pub(super) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x89PNG")
}

/// Width and height, which stand at a fixed place: before a decoder sees the rest.
pub(super) fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    Some((number(16)?, number(20)?))
}

fn levels(channels: [f64; 3], top: f64) -> DVec3 {
    DVec3::from_array(channels) / top
}

/// Rows from the bottom, little-endian: what readers of PFM expect.
fn encode_pfm(image: &Image) -> Vec<u8> {
    let (width, height) = (image.width(), image.height());
    let mut out = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    for j in (0..height).rev() {
        for i in 0..width {
            out.extend(image.pixel(i, j).to_array().into_iter().flat_map(|light| (light as f32).to_le_bytes()));
        }
    }
    out
}

fn decode_pfm(bytes: &[u8], wanted: (u32, u32)) -> Result<Image, PictureError> {
    let mut reader = BufReader::new(bytes);
    let n_channels = if token(&mut reader)? == "PF" { 3 } else { 1 };
    let found = (number(&token(&mut reader)?)?, number(&token(&mut reader)?)?);
    let scale: f32 = number(&token(&mut reader)?)?;
    if found != wanted {
        return Err(PictureError::Size { found, wanted });
    }
    if !scale.is_normal() {
        return Err(PictureError::Broken(format!(
            "the scale {scale} does not say the order of bytes: write -1.0 or 1.0"
        )));
    }
    let row_bytes = wanted.0 as usize * n_channels * 4;
    let mut rows = Vec::new();
    let most = row_bytes as u64 * u64::from(wanted.1);
    reader.take(most).read_to_end(&mut rows)?;
    if rows.len() as u64 != most {
        return Err(PictureError::Broken(format!("the header promises {most} bytes of light, {} follow", rows.len())));
    }
    let light = |at: &[u8]| {
        let four = [at[0], at[1], at[2], at[3]];
        f64::from(if scale < 0.0 { f32::from_le_bytes(four) } else { f32::from_be_bytes(four) })
    };
    let pixel = |at: &[u8]| match n_channels {
        3 => DVec3::new(light(at), light(&at[4..]), light(&at[8..])),
        _ => DVec3::splat(light(at)),
    };
    let pixels = rows.chunks(row_bytes).rev().flat_map(|row| row.chunks(n_channels * 4).map(pixel)).collect();
    Image::from_pixels(wanted.0, wanted.1, pixels).ok_or_else(|| PictureError::Broken("pixels are missing".to_owned()))
}

/// The next word of a PFM header, with the single white space behind it; at most 32 bytes.
fn token(reader: &mut impl BufRead) -> Result<String, PictureError> {
    let mut word = String::new();
    let mut one = [0];
    while word.len() < 32 {
        reader.read_exact(&mut one).map_err(|_| PictureError::Broken("the header ends early".to_owned()))?;
        match one[0] {
            space if space.is_ascii_whitespace() && word.is_empty() => {}
            space if space.is_ascii_whitespace() => return Ok(word),
            letter => word.push(char::from(letter)),
        }
    }
    Err(PictureError::Broken(format!("the header holds the overlong word {word:?}")))
}

fn number<T: std::str::FromStr>(word: &str) -> Result<T, PictureError> {
    word.parse().map_err(|_| PictureError::Broken(format!("the header holds {word:?} where a number belongs")))
}
