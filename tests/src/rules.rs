//! The rules by which other graders of this assignment compare two pictures, each in a few lines.

use cases::film::{self, Image, PictureError};

/// A picture as a file with 8 bits per channel stores it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: usize,
    /// Three bytes per pixel, row by row from the top.
    bytes: Vec<u8>,
}

impl Picture {
    /// Returns `image`, rounded to 8 bits.
    pub fn of(image: &Image) -> Self {
        let bytes =
            image.pixels().iter().flat_map(|pixel| pixel.to_array().map(film::byte)).collect();
        Self { width: image.width() as usize, bytes }
    }

    /// Returns a picture of `bytes`, three per pixel, in rows of `width` pixels.
    pub fn new(width: usize, bytes: Vec<u8>) -> Self {
        Self { width, bytes }
    }

    /// Returns red, green and blue of each pixel, row by row from the top.
    pub fn pixels(&self) -> impl Iterator<Item = &[u8]> {
        self.bytes.chunks_exact(3)
    }

    /// Returns the picture as a PNG file.
    ///
    /// # Errors
    /// Returns the error of the encoder.
    pub fn png(&self) -> Result<Vec<u8>, PictureError> {
        let height = self.bytes.len() / 3 / self.width;
        let image = Image::from_fn(self.width as u32, height as u32, |x, y| {
            let at = (y as usize * self.width + x as usize) * 3;
            [0, 1, 2].map(|channel| f64::from(self.bytes[at + channel]) / 255.0).into()
        });
        film::encode(film::Kind::Png, &image)
    }

    /// Returns a hash of the bytes, for a name (FNV-1a).
    pub fn digest(&self) -> String {
        let add = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        format!("{:016x}", self.bytes.iter().fold(0xcbf2_9ce4_8422_2325, add))
    }
}

/// A rule of another grader.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The measure, and its source.
    pub name: &'static str,
    /// The condition under which a picture passes.
    pub says: &'static str,
    /// Returns whether the second picture passes if the first one is expected.
    pub passes: fn(&Picture, &Picture) -> bool,
}

/// The rules. A rule without a threshold of its own says so.
pub const RULES: [Rule; 4] = [
    Rule {
        name: "mean difference (UC Riverside)",
        says: "the mean absolute difference over all samples, rounded to 0.01 %, is at most 0.10 %",
        passes: |expected, actual| (mean_percent(expected, actual) * 100.0).round() <= 10.0,
    },
    Rule {
        name: "RMS, unsigned 8-bit (UT Austin, as shipped)",
        says: "the root mean square of the differences, taken in unsigned bytes so that −1 counts \
            as 255, is at most 10 of 255",
        passes: |expected, actual| {
            rms(expected, actual, |a, b| f64::from(a.wrapping_sub(b))) <= 10.0
        },
    },
    Rule {
        name: "RMS (UT Austin, as meant)",
        says: "the root mean square of the differences is at most 10 of 255",
        passes: |expected, actual| rms(expected, actual, |a, b| f64::from(a.abs_diff(b))) <= 10.0,
    },
    Rule {
        name: "3×3 neighbourhood (GMU)",
        says: "each pixel against the nearest of the other picture's 3×3 around it, both ways, \
            the larger mean kept; the score 100 − 10 · mean % (no threshold of its own) rounds to \
            100",
        passes: |expected, actual| 100.0 - 10.0 * neighbourhood_percent(expected, actual) >= 99.5,
    },
];

fn mean_percent(expected: &Picture, actual: &Picture) -> f64 {
    let sum: u64 =
        expected.bytes.iter().zip(&actual.bytes).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / expected.bytes.len() as f64 / 2.55
}

fn rms(expected: &Picture, actual: &Picture, difference: fn(u8, u8) -> f64) -> f64 {
    let squares =
        expected.bytes.iter().zip(&actual.bytes).map(|(a, b)| difference(*a, *b)).map(|by| by * by);
    (squares.sum::<f64>() / expected.bytes.len() as f64).sqrt()
}

fn neighbourhood_percent(expected: &Picture, actual: &Picture) -> f64 {
    one_way_percent(expected, actual).max(one_way_percent(actual, expected))
}

fn one_way_percent(from: &Picture, to: &Picture) -> f64 {
    let (width, height) = (from.width, from.bytes.len() / 3 / from.width);
    let mut sum = 0;
    for (at, pixel) in from.pixels().enumerate() {
        let (x, y) = (at % width, at / width);
        let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let around =
            rows.flat_map(|row| columns.clone().map(move |column| (row * width + column) * 3));
        let distance = |other: usize| -> u64 {
            pixel
                .iter()
                .zip(&to.bytes[other..other + 3])
                .map(|(a, b)| u64::from(a.abs_diff(*b)))
                .sum()
        };
        sum += around.map(distance).min().unwrap_or(0);
    }
    sum as f64 / from.bytes.len() as f64 / 2.55
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns 4 × 4 pixels of the level 100, with some samples changed.
    fn grey(changes: &[(usize, u8)]) -> Picture {
        let mut bytes = vec![100; 48];
        for (at, byte) in changes {
            bytes[*at] = *byte;
        }
        Picture::new(4, bytes)
    }

    #[test]
    fn the_measures_are_those_worked_out_by_hand() {
        let (plain, darker) = (grey(&[]), grey(&[(0, 99)]));
        assert!((mean_percent(&plain, &darker) - 100.0 / 255.0 / 48.0).abs() < 1e-12);
        let signed = |a: u8, b: u8| f64::from(a.abs_diff(b));
        let wrapped = |a: u8, b: u8| f64::from(a.wrapping_sub(b));
        assert!((rms(&plain, &darker, signed) - (1.0f64 / 48.0).sqrt()).abs() < 1e-12);
        assert!((rms(&darker, &plain, wrapped) - (255.0f64 * 255.0 / 48.0).sqrt()).abs() < 1e-12);
        assert_eq!(rms(&plain, &darker, wrapped), rms(&plain, &darker, signed));
    }

    #[test]
    fn a_pixel_that_moves_by_one_is_no_difference_of_neighbourhoods() {
        let (left, right) = (grey(&[(15, 255)]), grey(&[(18, 255)]));
        assert_eq!(neighbourhood_percent(&left, &right), 0.0);
        assert!((neighbourhood_percent(&left, &grey(&[])) - 155.0 / 2.55 / 48.0).abs() < 1e-12);
    }

    #[test]
    fn every_rule_passes_the_picture_itself_and_fails_black_for_grey() {
        for rule in RULES {
            assert!((rule.passes)(&grey(&[]), &grey(&[])), "{}", rule.name);
            assert!(!(rule.passes)(&grey(&[]), &Picture::new(4, vec![0; 48])), "{}", rule.name);
        }
    }

    #[test]
    fn a_picture_comes_back_from_its_file() {
        let picture = grey(&[(0, 0), (7, 255), (8, 1)]);
        let image = film::read_exact(&picture.png().unwrap(), 4, 4).unwrap();
        assert_eq!(Picture::of(&image), picture);
        assert_ne!(picture.digest(), grey(&[]).digest());
    }
}
