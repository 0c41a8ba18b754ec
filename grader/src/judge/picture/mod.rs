//! Judges pictures: correct, correct as far as correct tracers agree, or worth a part of their
//! points.

mod antialiased;
mod difference;
mod raster;
mod share;
#[cfg(test)]
mod tests;

use cases::answer::ImageAnswer;
use cases::film::{Image, byte};
use cases::glam::DVec3;

use super::Judgement;
use super::numbers::{grouped, percent};
use crate::record::{Finding, FindingKind};
use difference::measure;

pub use difference::{Difference, compare};
pub use raster::{Comparison, RowsCompared};
pub use share::earned;

/// The advice on an anti-aliased picture.
const ONE_RAY: &str = "graded pictures take one ray a pixel, through its centre [rule 1]: turn \
    anti-aliasing (or the filter) off";

/// Judges a picture of the correct size by its answer.
///
/// The picture passes if the number of out pixels and the largest cluster are within the limits of
/// the answer. It also passes if all out pixels are contested; a person should look at it then.
/// Otherwise it earns a part of its points, by the weight of the pixels that are not out. A picture
/// of one colour that is beyond the limits earns nothing. Pixels that are out only because of
/// anti-aliasing do not count as out, but the picture cannot earn all points then.
pub fn picture(actual: &Image, answer: &ImageAnswer) -> Judgement {
    let out = answer.out(actual);
    let all = measure(actual, answer, &out);
    if answer.allows(all.cluster, all.n_out) {
        return Judgement::PASS;
    }
    let message = describe(actual, answer, &all);
    if is_one_colour(actual) {
        let message = format!("{message}; yours is one colour all over, which earns nothing");
        return Judgement::fail(finding(FindingKind::Wrong, message, &all));
    }
    if let Some(smoothed) = antialiased::smoothed(actual, answer, &out) {
        return of_smoothed(actual, answer, &all, &out, &smoothed);
    }
    if all.n_contested == all.n_out {
        let share = percent(answer.contested_share());
        let message = format!(
            "{message}; but correct tracers differ on all of these pixels (and on {share} of the \
             picture), so it counts as right, and a person should look at it"
        );
        return Judgement::pass_with(finding(FindingKind::Contested, message, &all));
    }
    Judgement::partial(finding(FindingKind::Wrong, message, &all), share::earned(answer, &out))
}

/// Judges a picture that is anti-aliased in the pixels marked in `smoothed`. Pixels that are out
/// for another reason count.
fn of_smoothed(
    actual: &Image,
    answer: &ImageAnswer,
    all: &Difference,
    out: &[bool],
    smoothed: &[bool],
) -> Judgement {
    let rest: Vec<bool> =
        out.iter().zip(smoothed).map(|(is_out, is_smoothed)| *is_out && !is_smoothed).collect();
    let others = measure(actual, answer, &rest);
    let n_smoothed = grouped(u64::from(all.n_out - others.n_out));
    let message = format!(
        "it is anti-aliased: {n_smoothed} pixels along edges lie between their neighbours; \
            {ONE_RAY}"
    );
    let is_fine = answer.allows(others.cluster, others.n_out) || others.n_contested == others.n_out;
    let (share, message) = match is_fine {
        true => (share::MOST, message),
        false => (
            share::earned(answer, &rest),
            format!("{message}; besides, {}", describe(actual, answer, &others)),
        ),
    };
    Judgement::partial(finding(FindingKind::Antialiased, message, all), share)
}

fn finding(kind: FindingKind, message: String, all: &Difference) -> Finding {
    Finding {
        wrong_pixels: Some(all.n_out.into()),
        wrong_contested: (all.n_contested > 0).then_some(all.n_contested.into()),
        largest_cluster: Some(all.cluster.into()),
        worst: all.worst,
        ..Finding::new(kind, message)
    }
}

fn is_one_colour(picture: &Image) -> bool {
    let levels = |pixel: &DVec3| pixel.to_array().map(byte);
    let first = picture.pixels().first().map(levels);
    picture.pixels().iter().all(|pixel| Some(levels(pixel)) == first)
}

/// Describes how many pixels differ, where they are, and the worst of them in both pictures.
fn describe(actual: &Image, answer: &ImageAnswer, difference: &Difference) -> String {
    let mut text = extent(difference, actual.pixels().len() as u64);
    if let Some([x, y]) = difference.worst {
        let (yours, right) = (shown(actual.pixel(x, y)), shown(answer.expected.pixel(x, y)));
        text += &format!(", most at ({x}, {y}): yours {yours}, expected {right}");
        let n = (y * actual.width() + x) as usize;
        if answer.is_contested(n) {
            let levels = |levels: [u8; 3]| levels.map(|level| level.to_string()).join(" ");
            text += &format!(", allowed {} to {}", levels(answer.lo[n]), levels(answer.hi[n]));
        }
    }
    if difference.n_contested > 0 && difference.n_contested < difference.n_out {
        let (n_contested, share) =
            (grouped(difference.n_contested.into()), percent(answer.contested_share()));
        text += &format!(
            "; on {n_contested} of them correct tracers differ too (on {share} of the picture)"
        );
    }
    text
}

/// Describes how many of `all` pixels differ, and where they are.
fn extent(difference: &Difference, all: u64) -> String {
    let [n_out, cluster] = [difference.n_out, difference.cluster].map(u64::from);
    let verb = if n_out == 1 { "pixel of {} differs" } else { "pixels of {} differ" };
    let mut text = format!("{} {}", grouped(n_out), verb.replace("{}", &grouped(all)));
    if cluster > 1 && cluster < all {
        text += &format!(", {} of them side by side", grouped(cluster));
    }
    if let Some([x0, y0, x1, y1]) = difference.bounds.filter(|_| n_out < all) {
        text += &format!(" (columns {x0} to {x1}, rows {y0} to {y1})");
    }
    text
}

fn shown(colour: DVec3) -> String {
    let channel =
        |light: f64| if light.is_finite() { byte(light).to_string() } else { light.to_string() };
    colour.to_array().map(channel).join(" ")
}
