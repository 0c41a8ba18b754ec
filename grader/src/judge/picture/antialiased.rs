//! Anti-aliased pictures: several rays a pixel, or a filter over the finished picture. Their edges
//! are not wrong, but not asked for either.
//!
//! Where a graded picture takes the light at the pixel's centre, an anti-aliased one takes a mean
//! over the pixel and a little around it. Away from edges that is the same. At an edge it lies
//! between the values on both sides, and nearer to the side of the centre:
//!
//! ```text
//! expected          40  40  40 |210 210 210
//! anti-aliased      40  40  75 |210 210 210        between: 75
//! half a pixel off  40  40 210 |210 210 210        the neighbour's value: a shift, not a mean
//! ```

use cases::answer::ImageAnswer;
use cases::film::{Image, level};

/// At most one pixel of so many that are out may be left unexplained: what is thinner than a pixel
/// shows only to several rays.
const UNEXPLAINED: u32 = 8;
/// At least one pixel of so many that are out must lie at a clear step: slopes look alike in a mean
/// and in a shift.
const AT_STEPS: u32 = 16;
/// At least one pixel of so many at steps must lie well between both sides.
const BETWEEN: u32 = 3;
/// At most one pixel of so many at steps may have the value of the far side.
const FLIPPED: u32 = 5;
/// Fewer pixels at steps prove nothing.
const LEAST: u32 = 8;
/// Levels between the sides of a clear step.
const STEP: f64 = 24.0;
/// Each side of a clear step is flat within this share of it, and a pixel is well between if it is
/// farther than this from both.
const FLAT: f64 = 0.2;

/// How a pixel that is out stands to its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stands {
    /// Outside what they show.
    Apart,
    /// Within, where there is no clear step.
    Within,
    /// At a clear step, near its own side.
    Near,
    /// At a clear step, well between both sides.
    Between,
    /// At a clear step, on the far side.
    Flipped,
}

/// Which of the pixels that are `out` are so because the picture is anti-aliased; `None` where it
/// is not, or not to be told.
pub(super) fn smoothed(actual: &Image, answer: &ImageAnswer, out: &[bool]) -> Option<Vec<bool>> {
    let stand = |n: usize| if out[n] { stands(actual, answer, n) } else { Stands::Apart };
    let all: Vec<Stands> = (0..out.len()).map(stand).collect();
    let count = |wanted: Stands| all.iter().filter(|one| **one == wanted).count() as u32;
    let n_out = out.iter().filter(|is_out| **is_out).count() as u32;
    let [within, near, between, flipped] =
        [Stands::Within, Stands::Near, Stands::Between, Stands::Flipped].map(count);
    let n_steps = near + between + flipped;
    let n_unexplained = n_out - within - n_steps;
    let is_smoothed = n_steps >= LEAST
        && n_steps * AT_STEPS >= n_out
        && n_unexplained * UNEXPLAINED <= n_out
        && between * BETWEEN >= n_steps
        && flipped * FLIPPED <= n_steps;
    is_smoothed.then(|| all.iter().map(|one| *one != Stands::Apart).collect())
}

/// How the pixel `n` stands to the 3 × 3 pixels around it in the answer.
fn stands(actual: &Image, answer: &ImageAnswer, n: usize) -> Stands {
    let colour = actual.pixels()[n];
    if !colour.is_finite() {
        return Stands::Apart;
    }
    let around = around(n, actual.width() as usize, actual.height() as usize);
    let slack = answer.limits.slack;
    let is_within = |channel: usize| {
        let lo = around.iter().map(|at| answer.lo[*at][channel]).min().map_or(0.0, f64::from);
        let hi = around.iter().map(|at| answer.hi[*at][channel]).max().map_or(255.0, f64::from);
        (lo - slack..=hi + slack).contains(&level(colour[channel]))
    };
    if !(0..3).all(is_within) {
        return Stands::Apart;
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
        return Stands::Within;
    }
    let expected = level(answer.expected.pixels()[n][steepest]);
    match (level(colour[steepest]) - expected).abs() / step {
        moved if moved < FLAT => Stands::Near,
        moved if moved <= 1.0 - FLAT => Stands::Between,
        _ => Stands::Flipped,
    }
}

/// The pixel `n` and those beside it, corners included.
fn around(n: usize, width: usize, height: usize) -> Vec<usize> {
    let (x, y) = (n % width, n / width);
    let columns = x.saturating_sub(1)..(x + 2).min(width);
    (y.saturating_sub(1)..(y + 2).min(height))
        .flat_map(|row| columns.clone().map(move |x| row * width + x))
        .collect()
}

#[cfg(test)]
mod tests;
