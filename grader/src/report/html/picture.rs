//! Pictures as data URIs.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use cases::film::{self, Image};
use cases::glam::DVec3;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use crate::grade::Pictures;

/// How much the difference that is stored is brightened; the viewer offers others.
pub(super) const GAIN: u8 = 4;

/// Marks in the map of wrong pixels.
const OUT: u8 = 255;
const NOT_A_NUMBER: u8 = 128;

/// The picture in 8-bit levels.
pub(super) fn colours(image: &Image) -> String {
    let bytes: Vec<u8> = image.pixels().iter().flat_map(|pixel| pixel.to_array().map(film::byte)).collect();
    data_uri(&bytes, image, ExtendedColorType::Rgb8)
}

/// By how many levels each channel differs, times [`GAIN`].
pub(super) fn difference(expected: &Image, actual: &Image) -> String {
    let channel = |a: f64, b: f64| film::byte(a).abs_diff(film::byte(b)).saturating_mul(GAIN);
    let bytes: Vec<u8> = pairs(expected, actual).flat_map(|(a, b)| [0, 1, 2].map(|c| channel(a[c], b[c]))).collect();
    data_uri(&bytes, expected, ExtendedColorType::Rgb8)
}

/// Where the picture is out of tolerance: 0 within, 255 out, 128 out and not a finite number.
pub(super) fn wrong(pictures: &Pictures, actual: &Image) -> String {
    let answer = &pictures.answer;
    let mark = |(n, colour): (usize, &DVec3)| match () {
        () if !colour.is_finite() => NOT_A_NUMBER,
        () if answer.is_out(n, *colour) => OUT,
        () => 0,
    };
    let bytes: Vec<u8> = actual.pixels().iter().enumerate().map(mark).collect();
    data_uri(&bytes, actual, ExtendedColorType::L8)
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
