//! Compares two pictures row by row, without an envelope and without points.
//!
//! Neither picture is the correct one, so their order does not matter. The memory does not grow
//! with the pictures.

use cases::answer::Clusters;
use cases::film::WORDS_IN_BYTE;

use super::{Difference, extent};
use crate::judge::numbers::grouped;

/// A comparison of two pictures of the same width, row by row.
///
/// A pixel is out if a channel differs by more than `slack` 8-bit levels, or if a channel is NaN or
/// infinite in either picture.
#[derive(Clone, Debug)]
pub struct RowsCompared {
    slack: f64,
    width: usize,
    n_rows: u32,
    difference: Difference,
    clusters: Clusters,
    out: Vec<bool>,
    worst: Option<Worst>,
    n_not_finite: u32,
}

/// The pixel that is farthest out, and the first one of equals.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Worst {
    /// The difference in 8-bit levels, infinite for NaN and infinity.
    by: f64,
    /// The 8-bit levels of both pictures.
    sides: [[f64; 3]; 2],
}

/// The difference between two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Counts over the out pixels. No pixel is contested.
    pub difference: Difference,
    /// The difference of the worst pixel in 8-bit levels. The value is infinite for NaN and
    /// infinity, and 0 if no pixel is out.
    pub by: f64,
    /// The number of pixels that are NaN or infinite in either picture.
    pub n_not_finite: u32,
    /// A text on how many pixels are out, where they are, and the worst of them in both pictures.
    pub text: String,
}

impl RowsCompared {
    /// Starts a comparison of pictures that have `width` pixels in a row, at least 1.
    pub fn new(width: u32, slack: f64) -> Self {
        let width = width as usize;
        Self {
            slack,
            width,
            n_rows: 0,
            difference: Difference {
                n_out: 0,
                cluster: 0,
                n_contested: 0,
                worst: None,
                bounds: None,
            },
            clusters: Clusters::default(),
            out: vec![false; width],
            worst: None,
            n_not_finite: 0,
        }
    }

    /// Compares the next rows in 8-bit levels: red, green and blue of each pixel.
    ///
    /// # Panics
    /// Panics if the slices are not whole rows, or not equally long.
    pub fn take(&mut self, one: &[u8], other: &[u8]) {
        let by = |a: [u8; 3], b: [u8; 3], channel: usize| a[channel].abs_diff(b[channel]);
        let most = |a, b| larger(larger(by(a, b, 0), by(a, b, 1)), by(a, b, 2));
        for (one, other) in rows(one, other, self.width) {
            if one != other {
                self.row(one, other, 1.0, |a, b| (a != b).then(|| f64::from(most(a, b))));
            }
            self.end_row();
        }
    }

    /// Compares the next rows in 16-bit levels: red, green and blue of each pixel.
    ///
    /// # Panics
    /// Panics if the slices are not whole rows, or not equally long.
    pub fn take_words(&mut self, one: &[f64], other: &[f64]) {
        let apart =
            |a: [f64; 3], b: [f64; 3]| match a.iter().chain(&b).all(|level| level.is_finite()) {
                true => Some((a[0] - b[0]).abs().max((a[1] - b[1]).abs()).max((a[2] - b[2]).abs())),
                false => Some(f64::INFINITY),
            };
        for (one, other) in rows(one, other, self.width) {
            self.row(one, other, WORDS_IN_BYTE, apart);
            self.end_row();
        }
    }

    /// Returns how the rows differ.
    pub fn finish(self) -> Comparison {
        let difference = Difference { cluster: self.clusters.largest(), ..self.difference };
        let mut text = extent(&difference, self.width as u64 * u64::from(self.n_rows));
        if let (Some([x, y]), Some(Worst { by, sides })) = (difference.worst, self.worst) {
            let [one, other] = sides.map(|pixel| pixel.map(shown).join(" "));
            let by =
                if by.is_finite() { format!(" by {} levels", shown(by)) } else { String::new() };
            text += &format!(", most at ({x}, {y}){by}: first {one}, second {other}");
        }
        if self.n_not_finite > 0 {
            let n = grouped(self.n_not_finite.into());
            text += &format!("; {n} of them hold NaN or infinity, which differ from everything");
        }
        let by = self.worst.map_or(0.0, |worst| worst.by);
        Comparison { difference, by, n_not_finite: self.n_not_finite, text }
    }

    /// Compares a row of samples. An 8-bit level is `unit` samples. `apart` returns the difference
    /// of two pixels in samples, or `None` if they are equal.
    fn row<T: Copy + Into<f64>>(
        &mut self,
        one: &[T],
        other: &[T],
        unit: f64,
        apart: impl Fn([T; 3], [T; 3]) -> Option<f64>,
    ) {
        let slack = self.slack * unit;
        for (x, (a, b)) in one.as_chunks::<3>().0.iter().zip(other.as_chunks::<3>().0).enumerate() {
            let Some(by) = apart(*a, *b) else { continue };
            if by > slack {
                self.note(x, by / unit, || {
                    [a, b].map(|pixel| pixel.map(|sample| sample.into() / unit))
                });
            }
        }
    }

    fn end_row(&mut self) {
        self.clusters.row(&self.out);
        self.out.fill(false);
        self.n_rows += 1;
    }

    /// Counts the pixel in column `x` of the current row, which is out.
    fn note(&mut self, x: usize, by: f64, sides: impl FnOnce() -> [[f64; 3]; 2]) {
        self.out[x] = true;
        let (x, y) = (x as u32, self.n_rows);
        if self.worst.is_none_or(|worst| by > worst.by) {
            self.worst = Some(Worst { by, sides: sides() });
            self.difference.worst = Some([x, y]);
        }
        self.difference.n_out += 1;
        self.n_not_finite += u32::from(by.is_infinite());
        let [x0, y0, x1, y1] = self.difference.bounds.unwrap_or([x, y, x, y]);
        self.difference.bounds =
            Some([smaller(x0, x), smaller(y0, y), larger(x1, x), larger(y1, y)]);
    }
}

/// Returns the larger one. At the low level of optimization of this crate, `Ord::max` remains a
/// call of a copy in another crate, which made `grader compare` a quarter slower.
fn larger<T: Copy + PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// Returns the smaller one, for the same reason.
fn smaller<T: Copy + PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// Returns pairs of rows.
fn rows<'a, T>(
    one: &'a [T],
    other: &'a [T],
    width: usize,
) -> impl Iterator<Item = (&'a [T], &'a [T])> {
    let n = width * 3;
    assert!(one.len() == other.len() && one.len().is_multiple_of(n), "whole rows");
    one.chunks_exact(n).zip(other.chunks_exact(n))
}

/// Formats a number of levels with three decimals, or with an exponent if it is tiny or huge.
fn shown(levels: f64) -> String {
    let thousandths = (levels * 1000.0).round() / 1000.0;
    match levels.abs() {
        _ if !levels.is_finite() => levels.to_string(),
        size if size >= 1e6 || (size > 0.0 && size < 0.01) => format!("{levels:.2e}"),
        _ => (thousandths + 0.0).to_string(), // no -0
    }
}
