//! Changes of whole pictures. None of them is a mistake of a tracer.

use cases::film::{Image, byte};
use cases::glam::DVec3;

/// A change that a program makes in each right picture.
#[derive(Clone, Copy, Debug)]
pub struct Nuisance {
    /// A unique name.
    pub name: &'static str,
    /// Returns the light of the changed picture at a column and a row. The last argument is a
    /// random number from 0 to 1.
    pub change: fn(&Image, u32, u32, f64) -> DVec3,
    /// The film mistake that is named for it, if one must be.
    pub film: Option<&'static str>,
}

impl Nuisance {
    /// Returns the changed picture, in bytes.
    pub fn of(&self, right: &Image) -> Image {
        Image::from_fn(right.width(), right.height(), |i, j| {
            let light = (self.change)(right, i, j, random(i, j));
            DVec3::from(light.to_array().map(|x| f64::from(byte(x)))) / 255.0
        })
    }
}

/// Returns a number from 0 to 1 that looks random.
fn random(i: u32, j: u32) -> f64 {
    let mixed =
        (u64::from(i) * 7919 + u64::from(j) * 104_729 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    f64::from((mixed >> 40) as u32) / f64::from(1 << 24)
}

/// Returns the light of a pixel; the border continues outside.
fn at(right: &Image, i: i64, j: i64) -> DVec3 {
    let (width, height) = (i64::from(right.width()), i64::from(right.height()));
    let (i, j) = (i.clamp(0, width - 1), j.clamp(0, height - 1));
    right.pixels()[(j * width + i) as usize]
}

/// Returns the light of a pixel that lies inside.
fn here(right: &Image, i: u32, j: u32) -> DVec3 {
    at(right, i64::from(i), i64::from(j))
}

/// Returns `light` with each channel passed through `curve`. The platform's functions are not used,
/// so that the pictures are the same everywhere.
fn through(light: DVec3, curve: fn(f64) -> f64) -> DVec3 {
    DVec3::from(light.to_array().map(curve))
}

/// Returns the mean of the 3 × 3 pixels around a pixel.
fn blurred(right: &Image, i: u32, j: u32) -> DVec3 {
    let near = [-1, 0, 1];
    let pixels = near.iter().flat_map(|row| near.map(|column| (column, *row)));
    pixels.map(|(x, y)| at(right, i64::from(i) + x, i64::from(j) + y)).sum::<DVec3>() / 9.0
}

const fn film(
    name: &'static str,
    film: &'static str,
    change: fn(&Image, u32, u32, f64) -> DVec3,
) -> Nuisance {
    Nuisance { name, change, film: Some(film) }
}

const fn none(name: &'static str, change: fn(&Image, u32, u32, f64) -> DVec3) -> Nuisance {
    Nuisance { name, change, film: None }
}

const CURVE: &str = "levels_through_a_curve";

/// The nuisances.
pub const NUISANCES: &[Nuisance] = &[
    film("gamma 2", CURVE, |p, i, j, _| through(here(p, i, j), f64::sqrt)),
    film("gamma 1/2", CURVE, |p, i, j, _| through(here(p, i, j), |x| x * x)),
    film("times 0.8", CURVE, |p, i, j, _| here(p, i, j) * 0.8),
    film("times 0.95", CURVE, |p, i, j, _| here(p, i, j) * 0.95),
    film("times 1.05", CURVE, |p, i, j, _| here(p, i, j) * 1.05),
    film("4 levels more", CURVE, |p, i, j, _| here(p, i, j) + 4.0 / 255.0),
    film("3 levels less", CURVE, |p, i, j, _| here(p, i, j) - 3.0 / 255.0),
    film("5 bits", CURVE, |p, i, j, _| through(here(p, i, j), |x| (x * 31.0).floor() / 31.0)),
    film("Reinhard", CURVE, |p, i, j, _| through(here(p, i, j), |x| x / (1.0 + x))),
    film("negative", CURVE, |p, i, j, _| DVec3::ONE - here(p, i, j)),
    film("mirrored", "mirrored", |p, i, j, _| here(p, p.width() - 1 - i, j)),
    film("upside down", "upside_down", |p, i, j, _| here(p, i, p.height() - 1 - j)),
    film("turned", "turned_around", |p, i, j, _| here(p, p.width() - 1 - i, p.height() - 1 - j)),
    film("red and blue exchanged", "channels_exchanged", |p, i, j, _| {
        let light = here(p, i, j);
        DVec3::new(light.z, light.y, light.x)
    }),
    film("a column to the right", "shifted", |p, i, j, _| at(p, i64::from(i) - 1, i64::from(j))),
    film("column by column", "rows_and_columns_exchanged", |p, i, j, _| {
        let n = j * p.width() + i;
        here(p, n / p.height(), n % p.height())
    }),
    film("half finished", "last_rows_missing", |p, i, j, _| {
        if 2 * j < p.height() { here(p, i, j) } else { DVec3::ZERO }
    }),
    film("without the last row", "last_rows_missing", |p, i, j, _| {
        if j + 1 < p.height() { here(p, i, j) } else { DVec3::ZERO }
    }),
    none("noise of 2 levels", |p, i, j, r| here(p, i, j) + (r - 0.5) * 4.0 / 255.0),
    none("noise of 8 levels", |p, i, j, r| here(p, i, j) + (r - 0.5) * 16.0 / 255.0),
    none("noise of 40 levels", |p, i, j, r| here(p, i, j) + (r - 0.5) * 80.0 / 255.0),
    none("blurred", |p, i, j, _| blurred(p, i, j)),
    none("grey", |p, i, j, _| DVec3::splat(here(p, i, j).element_sum() / 3.0)),
    none("shuffled", |p, _, _, r| p.pixels()[(r * p.pixels().len() as f64) as usize]),
    none("clamped light of each channel", |p, i, j, _| here(p, i, j).min(DVec3::splat(0.7))),
    none("a border", |p, i, j, _| if i < 3 || j < 3 { DVec3::ONE } else { here(p, i, j) }),
    none("every second row", |p, i, j, _| if j % 2 == 0 { here(p, i, j) } else { DVec3::ZERO }),
];
