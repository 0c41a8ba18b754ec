//! Encodes pictures as data URIs.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cases::answer::ImageAnswer;
use cases::film::{self, Image};
use cases::glam::DVec3;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use serde::Serialize;

/// The factor by which the stored difference is brightened. The viewer offers others.
pub(super) const GAIN: u8 = 4;

/// Marks in the map of pixels; those from 128 on are wrong. `submission.js` has the same values.
const CONTESTED: u8 = 64;
const NOT_A_NUMBER: u8 = 128;
const OUT_AND_CONTESTED: u8 = 192;
const OUT: u8 = 255;

/// The allowed values of each pixel, as distances from the expected one. The distances are small
/// nearly everywhere and so compress well.
#[derive(Serialize)]
pub(super) struct Allowed {
    below: String,
    above: String,
}

/// Returns the picture in 8-bit levels.
pub(super) fn colours(image: &Image) -> String {
    let bytes: Vec<u8> =
        image.pixels().iter().flat_map(|pixel| pixel.to_array().map(film::byte)).collect();
    data_uri(&bytes, image, ExtendedColorType::Rgb8)
}

/// Returns the difference of each channel in levels, times [`GAIN`].
pub(super) fn difference(expected: &Image, actual: &Image) -> String {
    let channel = |a: f64, b: f64| film::byte(a).abs_diff(film::byte(b)).saturating_mul(GAIN);
    let bytes: Vec<u8> =
        pairs(expected, actual).flat_map(|(a, b)| [0, 1, 2].map(|c| channel(a[c], b[c]))).collect();
    data_uri(&bytes, expected, ExtendedColorType::Rgb8)
}

/// Returns the map of wrong and contested pixels.
pub(super) fn marks(answer: &ImageAnswer, actual: &Image) -> String {
    let mark =
        |(n, colour): (usize, &DVec3)| match (answer.is_out(n, *colour), answer.is_contested(n)) {
            _ if !colour.is_finite() => NOT_A_NUMBER,
            (true, true) => OUT_AND_CONTESTED,
            (true, false) => OUT,
            (false, true) => CONTESTED,
            (false, false) => 0,
        };
    let bytes: Vec<u8> = actual.pixels().iter().enumerate().map(mark).collect();
    data_uri(&bytes, actual, ExtendedColorType::L8)
}

/// Returns the weight of each pixel for the points. `None` if all pixels have the same weight.
pub(super) fn weight(answer: &ImageAnswer) -> Option<String> {
    let is_uneven = answer.weight.windows(2).any(|pair| pair[0] != pair[1]);
    is_uneven.then(|| data_uri(&answer.weight, &answer.expected, ExtendedColorType::L8))
}

/// Returns the least and the greatest level that is allowed for each channel, slack included.
pub(super) fn allowed(answer: &ImageAnswer) -> Allowed {
    let slack = answer.limits.slack;
    let (mut below, mut above) = (vec![], vec![]);
    for (n, pixel) in answer.expected.pixels().iter().enumerate() {
        for channel in 0..3 {
            let expected = film::byte(pixel[channel]);
            let least = (f64::from(answer.lo[n][channel]) - slack).max(0.0).ceil();
            let most = (f64::from(answer.hi[n][channel]) + slack).min(255.0).floor();
            below.push((f64::from(expected) - least).max(0.0) as u8);
            above.push((most - f64::from(expected)).max(0.0) as u8);
        }
    }
    let stored = |bytes: &[u8]| data_uri(bytes, &answer.expected, ExtendedColorType::Rgb8);
    Allowed { below: stored(&below), above: stored(&above) }
}

fn pairs(expected: &Image, actual: &Image) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
    expected.pixels().iter().zip(actual.pixels()).map(|(a, b)| (a.to_array(), b.to_array()))
}

fn data_uri(bytes: &[u8], size: &Image, colour: ExtendedColorType) -> String {
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Default, FilterType::Adaptive)
        .write_image(bytes, size.width(), size.height(), colour)
        .expect("the bytes are as many as the picture has pixels, and memory takes them all");
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
}
