//! Anti-aliased pictures, made by several rays per pixel or by a filter over the finished picture.
//! Their edges are not wrong, but not requested either.
//!
//! A graded picture has the light at the centre of each pixel. An anti-aliased one has a mean over
//! the pixel and a little around it. Away from edges both are equal. At an edge the mean lies
//! between the values on both sides, and nearer to the side of the centre:
//!
//! ```text
//! expected          40  40  40 |210 210 210
//! anti-aliased      40  40  75 |210 210 210        between: 75
//! half a pixel off  40  40 210 |210 210 210        the neighbour's value: a shift, not a mean
//! ```

use cases::answer::ImageAnswer;
use cases::film::{Image, level};

/// Bound on unexplained pixels: at most one in this many out pixels, because a feature thinner than
/// a pixel shows only to several rays.
const UNEXPLAINED: u32 = 8;
/// Bound on pixels at clear steps: at least one in this many out pixels. Slopes look the same in a
/// mean and in a shift.
const AT_STEPS: u32 = 16;
/// Bound on pixels well between both sides: at least one in this many pixels at steps.
const BETWEEN: u32 = 3;
/// Bound on pixels with the value of the far side: at most one in this many pixels at steps.
const FLIPPED: u32 = 5;
/// The least number of pixels at steps; fewer prove nothing.
const LEAST: u32 = 8;
/// The least height of a clear step, in levels.
const STEP: f64 = 24.0;
/// The flatness of a clear step, as a share of its height. Each side varies by at most this share,
/// and a pixel is well between if it is farther than this from both.
const FLAT: f64 = 0.2;

/// The relation of an out pixel to its neighbours in the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    /// The pixel is outside the range of its neighbours.
    Apart,
    /// The pixel is within the range, and there is no clear step.
    Within,
    /// The pixel is at a clear step, near its own side.
    Near,
    /// The pixel is at a clear step, well between both sides.
    Between,
    /// The pixel is at a clear step, on the far side.
    Flipped,
}

/// Returns which of the `out` pixels are out because the picture is anti-aliased. `None` if the
/// picture is not anti-aliased, or if too few pixels lie at steps to decide.
pub(super) fn smoothed(actual: &Image, answer: &ImageAnswer, out: &[bool]) -> Option<Vec<bool>> {
    let stand = |n: usize| if out[n] { classify(actual, answer, n) } else { Relation::Apart };
    let all: Vec<Relation> = (0..out.len()).map(stand).collect();
    let count = |wanted: Relation| all.iter().filter(|one| **one == wanted).count() as u32;
    let n_out = out.iter().filter(|is_out| **is_out).count() as u32;
    let [within, near, between, flipped] =
        [Relation::Within, Relation::Near, Relation::Between, Relation::Flipped].map(count);
    let n_steps = near + between + flipped;
    let n_unexplained = n_out - within - n_steps;
    let is_smoothed = n_steps >= LEAST
        && n_steps * AT_STEPS >= n_out
        && n_unexplained * UNEXPLAINED <= n_out
        && between * BETWEEN >= n_steps
        && flipped * FLIPPED <= n_steps;
    is_smoothed.then(|| all.iter().map(|one| *one != Relation::Apart).collect())
}

/// Classifies the pixel `n` against the 3 × 3 pixels around it in the answer. A colour that is not
/// finite is [`Relation::Apart`].
fn classify(actual: &Image, answer: &ImageAnswer, n: usize) -> Relation {
    let colour = actual.pixels()[n];
    if !colour.is_finite() {
        return Relation::Apart;
    }
    let around = around(n, actual.width() as usize, actual.height() as usize);
    let slack = answer.limits.slack;
    let is_within = |channel: usize| {
        let lo = around.iter().map(|at| answer.lo[*at][channel]).min().map_or(0.0, f64::from);
        let hi = around.iter().map(|at| answer.hi[*at][channel]).max().map_or(255.0, f64::from);
        (lo - slack..=hi + slack).contains(&level(colour[channel]))
    };
    if !(0..3).all(is_within) {
        return Relation::Apart;
    }
    let levels =
        |channel: usize| around.iter().map(move |at| level(answer.expected.pixels()[*at][channel]));
    let ends = |channel: usize| {
        levels(channel).fold((255.0f64, 0.0f64), |(lo, hi), one| (lo.min(one), hi.max(one)))
    };
    let height = |channel: usize| ends(channel).1 - ends(channel).0;
    let steepest =
        [1, 2].into_iter().fold(0, |best, one| if height(one) > height(best) { one } else { best });
    let ((lo, hi), step) = (ends(steepest), height(steepest));
    let is_flat = levels(steepest).all(|one| one - lo <= FLAT * step || hi - one <= FLAT * step);
    if step < STEP || !is_flat {
        return Relation::Within;
    }
    let expected = level(answer.expected.pixels()[n][steepest]);
    match (level(colour[steepest]) - expected).abs() / step {
        moved if moved < FLAT => Relation::Near,
        moved if moved <= 1.0 - FLAT => Relation::Between,
        _ => Relation::Flipped,
    }
}

/// Returns the pixel `n` and its up to eight neighbours.
fn around(n: usize, width: usize, height: usize) -> Vec<usize> {
    let (x, y) = (n % width, n / width);
    let columns = x.saturating_sub(1)..(x + 2).min(width);
    (y.saturating_sub(1)..(y + 2).min(height))
        .flat_map(|row| columns.clone().map(move |x| row * width + x))
        .collect()
}

#[cfg(test)]
mod tests;
