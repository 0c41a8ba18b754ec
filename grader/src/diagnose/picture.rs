//! How much of what is wrong with a picture each known mistake explains.

use std::collections::BTreeMap;

use cases::answer::{ImageAnswer, Levels, Wrong};
use cases::film::{Image, level};

/// Two pictures show the same where no channel differs by more levels than this.
const NEAR: f64 = 2.0;

/// For each mistake the share of the pixels that are out, or would be with the mistake, which show what the mistake shows. 0 to 1.
///
/// A pixel shows what the mistake shows where it is [`NEAR`] its picture, or lies between its neighbours there: edges fall a pixel
/// to one side or the other.
///
/// # Panics
/// Where the sizes differ.
pub fn picture(actual: &Image, answer: &ImageAnswer, mistakes: &[Wrong]) -> BTreeMap<String, f64> {
    let seen = Seen {
        width: actual.width() as usize,
        out: answer.out(actual),
        levels: actual.pixels().iter().map(|colour| colour.to_array().map(level)).collect(),
    };
    mistakes.iter().map(|mistake| (mistake.id.clone(), share(&seen, answer, &mistake.levels))).collect()
}

/// The student's picture.
struct Seen {
    width: usize,
    out: Vec<bool>,
    /// NaN where light is.
    levels: Vec<[f64; 3]>,
}

fn share(seen: &Seen, answer: &ImageAnswer, mistake: &[Levels]) -> f64 {
    assert_eq!(seen.out.len(), mistake.len(), "pictures of one size");
    let (mut n_explained, mut n_all) = (0u32, 0u32);
    for (n, levels) in seen.levels.iter().enumerate() {
        if !seen.out[n] && !is_out(answer, n, mistake[n]) {
            continue;
        }
        let is_alike = is_near(*levels, mistake[n]) || is_between(*levels, mistake, seen.width, n);
        n_explained += u32::from(is_alike && seen.out[n]);
        n_all += u32::from(!is_alike || seen.out[n]);
    }
    f64::from(n_explained) / f64::from(n_all.max(1))
}

/// Whether the mistake's pixel is out.
fn is_out(answer: &ImageAnswer, n: usize, mistake: Levels) -> bool {
    let gap =
        |at: usize| answer.lo[n][at].saturating_sub(mistake[at]).max(mistake[at].saturating_sub(answer.hi[n][at]));
    f64::from(gap(0).max(gap(1)).max(gap(2))) > answer.limits.slack
}

fn is_near(levels: [f64; 3], mistake: Levels) -> bool {
    levels.iter().zip(mistake).all(|(level, wrong)| (level - f64::from(wrong)).abs() <= NEAR)
}

/// Whether each channel lies between the least and the most of the 3 × 3 pixels around.
fn is_between(levels: [f64; 3], mistake: &[Levels], width: usize, n: usize) -> bool {
    let (mut lo, mut hi) = ([u8::MAX; 3], [0; 3]);
    let (x, y, height) = (n % width, n / width, mistake.len() / width);
    for j in y.saturating_sub(1)..(y + 2).min(height) {
        for i in x.saturating_sub(1)..(x + 2).min(width) {
            for at in 0..3 {
                let level = mistake[j * width + i][at];
                (lo[at], hi[at]) = (lo[at].min(level), hi[at].max(level));
            }
        }
    }
    (0..3).all(|at| (f64::from(lo[at]) - NEAR..=f64::from(hi[at]) + NEAR).contains(&levels[at]))
}
