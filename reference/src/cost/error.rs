//! The error of a picture against a better one.

use cases::film::{Image, Quantiser, level};
use cases::glam::DVec3;
use serde::Serialize;

/// The difference of two pictures. A channel that is not finite counts as wrong by its whole range:
/// 255 levels, or 1 of light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Error {
    /// The greatest difference of a channel in 8-bit levels, before rounding to whole levels.
    pub max_levels: f64,
    /// The root of the mean squared difference in 8-bit levels, over all channels.
    pub rms_levels: f64,
    /// The greatest difference of a channel in linear light, which is not clamped to 1.
    pub max_light: f64,
    /// The root of the mean squared difference in linear light, over all channels.
    pub rms_light: f64,
    /// The share of the pixels with a different 8-bit colour. A pixel that is not finite counts.
    pub changed: f64,
    /// The share of the pixels that are off by more than 1/255 in some channel, before rounding.
    pub off: f64,
}

impl Error {
    /// Returns the error of `image` against `truth`, a picture of the same size. `quantiser` turns
    /// light into bytes.
    pub fn of(truth: &Image, image: &Image, quantiser: Quantiser) -> Self {
        let mut error = Self::default();
        let n_pixels = truth.pixels().len().max(1) as f64;
        for (a, b) in truth.pixels().iter().zip(image.pixels()) {
            let levels = levels_off(*a, *b);
            let light = difference(*a, *b, |light| light, 1.0);
            error.max_levels = error.max_levels.max(levels.max_element());
            error.max_light = error.max_light.max(light.max_element());
            error.rms_levels += levels.length_squared();
            error.rms_light += light.length_squared();
            let bytes = |pixel: DVec3| pixel.to_array().map(|light| quantiser.byte(light));
            error.changed += f64::from(u8::from(bytes(*a) != bytes(*b) || !b.is_finite()));
            error.off += f64::from(u8::from(levels.max_element() > 1.0));
        }
        error.rms_levels = (error.rms_levels / (3.0 * n_pixels)).sqrt();
        error.rms_light = (error.rms_light / (3.0 * n_pixels)).sqrt();
        error.changed /= n_pixels;
        error.off /= n_pixels;
        error
    }
}

/// Returns the absolute difference of each channel in 8-bit levels, before rounding to whole
/// levels. A channel that is not finite is off by 255.
pub(super) fn levels_off(a: DVec3, b: DVec3) -> DVec3 {
    difference(a, b, level, 255.0)
}

impl Error {
    /// Returns the number of pixels with a different 8-bit colour, of `n_pixels` that were
    /// compared.
    pub fn n_changed(&self, n_pixels: usize) -> u64 {
        // The share is a whole number of pixels over their number.
        (self.changed * n_pixels as f64).round() as u64
    }
}

/// Returns the absolute difference of each channel after `scale`, or `all` where `b` or the
/// difference is not finite.
fn difference(a: DVec3, b: DVec3, scale: impl Fn(f64) -> f64, all: f64) -> DVec3 {
    let channel = |a: f64, b: f64| {
        let difference = (scale(a) - scale(b)).abs();
        if b.is_finite() && difference.is_finite() { difference } else { all }
    };
    DVec3::new(channel(a.x, b.x), channel(a.y, b.y), channel(a.z, b.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the error of a picture of four pixels, of which the last one is `last` and all others
    /// are mid-grey. In the truth all four are mid-grey.
    fn check(last: [f64; 3], expected: Error) {
        let grey = DVec3::splat(0.5);
        let truth = Image::from_fn(2, 2, |_, _| grey);
        let last = DVec3::from_array(last);
        let image = Image::from_fn(2, 2, |i, j| if i + j == 2 { last } else { grey });
        let error = Error::of(&truth, &image, Quantiser::Rounding);
        let numbers =
            |e: Error| [e.max_levels, e.rms_levels, e.max_light, e.rms_light, e.changed, e.off];
        for (found, wanted) in numbers(error).into_iter().zip(numbers(expected)) {
            assert!((found - wanted).abs() < 1e-12, "{last}: {error:?}, not {expected:?}");
        }
    }

    #[test]
    fn figures_of_one_wrong_pixel_of_four() {
        check([0.5; 3], Error::default());
        // 51 levels in one of twelve channels.
        let fifth = Error {
            max_levels: 51.0,
            rms_levels: 51.0 / 12f64.sqrt(),
            max_light: 0.2,
            rms_light: 0.2 / 12f64.sqrt(),
            changed: 0.25,
            off: 0.25,
        };
        check([0.5, 0.7, 0.5], fifth);
        // Half a level: 127.5 is rounded to 128, and so is 128.
        let half = 0.5 / 255.0;
        let small = Error {
            max_levels: 0.5,
            rms_levels: 0.5 / 12f64.sqrt(),
            max_light: half,
            rms_light: half / 12f64.sqrt(),
            ..Error::default()
        };
        check([0.5 + half, 0.5, 0.5], small);
        check([0.5 - half, 0.5, 0.5], Error { changed: 0.25, ..small });
        // Light above 1 is white: 127.5 levels, but 2.5 of light.
        let bright = Error {
            max_levels: 127.5,
            rms_levels: 127.5 / 4f64.sqrt(),
            max_light: 2.5,
            rms_light: 2.5 / 4f64.sqrt(),
            changed: 0.25,
            off: 0.25,
        };
        check([3.0; 3], bright);
    }

    #[test]
    fn what_is_no_number_is_wholly_wrong() {
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let whole = Error {
                max_levels: 255.0,
                rms_levels: 255.0 / 12f64.sqrt(),
                max_light: 1.0,
                rms_light: 1.0 / 12f64.sqrt(),
                changed: 0.25,
                off: 0.25,
            };
            check([0.5, odd, 0.5], whole);
        }
    }
}
