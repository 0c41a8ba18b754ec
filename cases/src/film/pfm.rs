//! Reads and writes portable float maps: a header of text, then rows of floats, the bottom row
//! first.
//!
//! ```text
//! PF         three channels; Pf: one, which is grey
//! 640 480    width and height
//! -1.0       the sign gives the order of bytes: negative is little-endian; the number is not used
//! ```
//!
//! White space separates the words, and `#` begins a comment that ends with its line. A single
//! white space follows the last word, and CR LF counts as one. The bytes after it may have any
//! value, so they do not show where the floats begin. Their number does: it must match the size.

use std::io::Read;

use super::{Image, PictureError};

/// Largest size of a header, in bytes.
pub(super) const MOST_HEADER: usize = 4096;

/// The text before the floats.
#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    /// Width and height.
    pub(super) size: (u32, u32),
    n_channels: usize,
    is_little: bool,
    /// Offset of the white space after the last word.
    end: usize,
}

impl Header {
    /// Reads the header at the beginning of `head`, which holds [`MOST_HEADER`] bytes unless the
    /// file is shorter.
    pub(super) fn parse(head: &[u8]) -> Result<Self, PictureError> {
        let mut words = Words { head, at: 0 };
        let n_channels = if words.next()? == "PF" { 3 } else { 1 };
        let size = (words.number()?, words.number()?);
        let scale: f32 = words.number()?;
        if !scale.is_normal() {
            return Err(PictureError::Broken(format!(
                "the scale {scale} does not say the order of bytes: write -1.0 or 1.0"
            )));
        }
        Ok(Self { size, n_channels, is_little: scale < 0.0, end: words.at })
    }

    /// Returns the number of bytes of floats that the size demands, at most 2⁶⁴ − 1.
    pub(super) fn n_bytes(&self) -> u64 {
        let n_samples = u64::from(self.size.0).saturating_mul(u64::from(self.size.1));
        n_samples.saturating_mul(self.n_channels as u64 * 4)
    }

    /// Returns the offset of the floats in a file of `length` bytes that begins with `head`.
    ///
    /// # Errors
    /// The file has too few bytes or too many.
    pub(super) fn start(&self, head: &[u8], length: u64) -> Result<u64, PictureError> {
        let (end, promised) = (self.end as u64, self.n_bytes());
        let behind = length.saturating_sub(end);
        let is_crlf = head[self.end..].starts_with(b"\r\n");
        let fits = |space: u64| behind.checked_sub(space) == Some(promised);
        match () {
            () if fits(1) => return Ok(end + 1),
            () if is_crlf && fits(2) => return Ok(end + 2),
            () => {}
        }
        let follow = behind.saturating_sub(if is_crlf { 2 } else { 1 });
        let n_off = follow.abs_diff(promised);
        let how = if follow > promised { "too many" } else { "too few" };
        let text = format!(
            "the header demands {promised} bytes of floats, {follow} follow: {n_off} {how}"
        );
        Err(PictureError::Broken(
            text + cause(n_off, follow > promised && is_text(&head[self.end..])),
        ))
    }

    /// Reads the floats, which follow in `file`. The top row comes first in the result.
    pub(super) fn pixels(&self, mut file: impl Read) -> Result<Vec<[f32; 3]>, PictureError> {
        let (width, height) = (self.size.0 as usize, self.size.1 as usize);
        let mut pixels = vec![[0.0; 3]; width * height];
        let mut stored = vec![0; width * self.n_channels * 4];
        let light = |four: [u8; 4]| {
            if self.is_little { f32::from_le_bytes(four) } else { f32::from_be_bytes(four) }
        };
        for row in pixels.chunks_exact_mut(width).rev() {
            file.read_exact(&mut stored)?;
            let samples = stored.as_chunks::<4>().0;
            match self.n_channels {
                3 => row
                    .iter_mut()
                    .zip(samples.as_chunks::<3>().0)
                    .for_each(|(to, from)| *to = from.map(light)),
                _ => row.iter_mut().zip(samples).for_each(|(to, from)| *to = [light(*from); 3]),
            }
        }
        Ok(pixels)
    }
}

/// Returns the likely cause of a wrong number of bytes, or an empty text.
fn cause(n_off: u64, is_text: bool) -> &'static str {
    match n_off {
        _ if is_text => {
            "; every line end in it is CR LF, as in a file that was written as text: write it in \
                binary mode"
        }
        1 | 2 => {
            "; the header is the likely cause: one white space, or CR LF, must follow the scale"
        }
        _ => "",
    }
}

/// Returns whether each LF follows a CR, as in a file that a program on Windows wrote as text.
fn is_text(bytes: &[u8]) -> bool {
    let n = |end: &[u8]| bytes.windows(end.len()).filter(|at| *at == end).count();
    n(b"\n") > 1 && n(b"\n") == n(b"\r\n")
}

/// A reader of the words of a header.
struct Words<'a> {
    head: &'a [u8],
    /// Offset of the next byte.
    at: usize,
}

impl<'a> Words<'a> {
    /// Reads the next word, of at most 32 bytes, without the white space after it.
    fn next(&mut self) -> Result<&'a str, PictureError> {
        self.skip_space();
        let rest = &self.head[self.at..];
        let n = rest.iter().position(u8::is_ascii_whitespace);
        let wrong = |what: &str, word: &[u8]| {
            let shown = word[..word.len().min(32)].escape_ascii();
            PictureError::Broken(format!("the header holds the {what} \"{shown}\""))
        };
        let word = &rest[..n.unwrap_or(rest.len())];
        if word.len() > 32 {
            return Err(wrong("overlong word", word));
        }
        if n.is_none() {
            let text = if self.head.len() < MOST_HEADER {
                "the header ends early"
            } else {
                "the header does not end"
            };
            return Err(PictureError::Broken(text.to_owned()));
        }
        self.at += word.len();
        std::str::from_utf8(word).map_err(|_| wrong("word", word))
    }

    fn number<T: std::str::FromStr>(&mut self) -> Result<T, PictureError> {
        let word = self.next()?;
        let shown = word.escape_default();
        word.parse().map_err(|_| {
            PictureError::Broken(format!("the header holds \"{shown}\" where a number belongs"))
        })
    }

    fn skip_space(&mut self) {
        let mut is_comment = false;
        while let Some(byte) = self.head.get(self.at) {
            match byte {
                b'\n' | b'\r' => is_comment = false,
                b'#' => is_comment = true,
                _ if is_comment || byte.is_ascii_whitespace() => {}
                _ => return,
            }
            self.at += 1;
        }
    }
}

/// Encodes a picture with the bottom row first and little-endian floats, as readers of PFM expect.
pub(super) fn encode(image: &Image) -> Vec<u8> {
    let (width, height) = (image.width(), image.height());
    let mut out = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    for j in (0..height).rev() {
        for i in 0..width {
            out.extend(
                image
                    .pixel(i, j)
                    .to_array()
                    .into_iter()
                    .flat_map(|light| (light as f32).to_le_bytes()),
            );
        }
    }
    out
}
