//! Pictures of errors: where a picture differs from a better one, amplified until it can be seen.

use cases::film::{self, Image, Kind};
use cases::glam::DVec3;

use super::error::levels_off;

/// The greatest side of a picture of errors in pixels. Larger pictures are reduced.
const MOST_SIDE: u32 = 256;

/// A picture of the differences between two pictures, channel by channel, on black.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPicture {
    /// The picture as a PNG file.
    pub png: Vec<u8>,
    /// The factor by which the differences are amplified, a power of two. The greatest difference
    /// has more than half of the full brightness.
    pub gain: f64,
    /// The number of pixels in a row.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
}

impl ErrorPicture {
    /// Returns the picture of the differences of `image` from `truth`, a picture of the same size.
    /// `None` if they do not differ or have no pixels.
    ///
    /// In a picture that is larger than 256 pixels, each pixel shows the greatest difference of a
    /// square block, so that no wrong pixel disappears.
    pub fn of(truth: &Image, image: &Image) -> Option<Self> {
        let (width, height) = (image.width(), image.height());
        let block = width.max(height).div_ceil(MOST_SIDE).max(1);
        let off = |x: u32, y: u32| levels_off(truth.pixel(x, y), image.pixel(x, y));
        let small = Image::from_fn(width.div_ceil(block), height.div_ceil(block), |i, j| {
            let rows = j * block..((j + 1) * block).min(height);
            let columns = i * block..((i + 1) * block).min(width);
            let pixels = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
            pixels.fold(DVec3::ZERO, |most, (x, y)| most.max(off(x, y)))
        });
        let most = small.pixels().iter().fold(0.0, |most: f64, off| most.max(off.max_element()));
        if most == 0.0 {
            return None;
        }
        let mut gain = 1.0;
        while 2.0 * gain * most <= 255.0 {
            gain *= 2.0;
        }
        let (width, height) = (small.width(), small.height());
        let bright =
            Image::from_fn(width, height, |i, j| small.pixel(i, j) * (gain / film::level(1.0)));
        let png = film::encode(Kind::Png, &bright).ok()?;
        Some(Self { png, gain, width, height })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, wrong: (u32, u32), off: f64) -> Option<ErrorPicture> {
        let black = Image::from_fn(width, height, |_, _| DVec3::ZERO);
        let at = |i, j| if (i, j) == wrong { DVec3::new(0.0, off, 0.0) } else { DVec3::ZERO };
        ErrorPicture::of(&black, &Image::from_fn(width, height, at))
    }

    #[test]
    fn one_wrong_pixel_stays_visible_at_every_size() {
        for (size, wrong, seen) in [((4, 3), (3, 2), (3, 2)), ((1024, 2), (1023, 1), (255, 0))] {
            let found = picture(size.0, size.1, wrong, 4.0 / 255.0).unwrap();
            assert_eq!(found.gain, 32.0, "64 × 4 levels are more than 255");
            let image = film::read_exact(&found.png, found.width, found.height).unwrap();
            for j in 0..found.height {
                for i in 0..found.width {
                    let green = if (i, j) == seen { 128.0 } else { 0.0 };
                    let expected = DVec3::new(0.0, green / 255.0, 0.0);
                    assert!((image.pixel(i, j) - expected).length() < 1e-12, "{size:?} {i} {j}");
                }
            }
        }
    }

    #[test]
    fn equal_pictures_have_none() {
        assert_eq!(picture(4, 3, (1, 1), 0.0), None);
        assert!(picture(4, 3, (1, 1), f64::NAN).is_some_and(|found| found.gain == 1.0));
    }
}
