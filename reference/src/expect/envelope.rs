//! The envelope of correct tracers, pixel by pixel, and how far each of them lies outside the
//! envelope of the others.

use cases::answer::{ImageAnswer, Levels, Limits, largest_cluster};
use cases::film::{Image, byte, level};

/// Number of 8-bit levels by which a channel may lie beyond the envelope, so that any quantiser is
/// legal.
const SLACK: f64 = 1.0;
/// Least limit on the largest cluster. Clusters up to this size are no sign of a mistake: mistakes
/// leave larger ones.
const MIN_CLUSTER: u32 = 3;
/// Least limit on the count of out pixels, as a share of all pixels. So few single pixels are no
/// sign of a mistake.
const MIN_SHARE: f64 = 0.001;

/// The two least and the two greatest levels of a channel among the members, so that any one member
/// can be left out.
#[derive(Clone, Copy, Debug)]
struct Span {
    least: [f64; 2],
    greatest: [f64; 2],
}

impl Span {
    const EMPTY: Self = Self { least: [f64::INFINITY; 2], greatest: [f64::NEG_INFINITY; 2] };

    fn add(&mut self, level: f64) {
        let [first, second] = self.least;
        self.least = [first.min(level), second.min(first.max(level))];
        let [first, second] = self.greatest;
        self.greatest = [first.max(level), second.max(first.min(level))];
    }

    /// Returns the least and the greatest level of all members except one that has this level, or
    /// of all members for `None`.
    fn without(&self, level: Option<f64>) -> (f64, f64) {
        let pick = |ends: [f64; 2]| if level == Some(ends[0]) { ends[1] } else { ends[0] };
        (pick(self.least), pick(self.greatest))
    }
}

/// Returns the answer whose envelope spans `centre` and `members`, pictures of one size. All pixels
/// have the same weight, and nothing is unearned.
///
/// Where the members agree on a level or on two neighbouring levels, the envelope is the centre's
/// level alone: the slack covers the other one.
///
/// The limits are those of any correct picture, or more where a member leaves more outside the
/// envelope of the others. The limit on the cluster is then one more than the largest cluster of a
/// member, the limit on the count twice the largest count.
pub(super) fn envelope(centre: Image, members: &[Image]) -> ImageAnswer {
    let mut spans = vec![[Span::EMPTY; 3]; centre.pixels().len()];
    for image in std::iter::once(&centre).chain(members) {
        for (span, pixel) in spans.iter_mut().zip(image.pixels()) {
            (0..3).for_each(|at| span[at].add(level(pixel[at])));
        }
    }
    let mut answer = ImageAnswer::exact(centre, SLACK, 0);
    (answer.lo, answer.hi) = bounds(&spans, &answer.expected, None);
    let left: Vec<(u32, u32)> =
        members.iter().map(|member| left_out(&answer, &spans, member)).collect();
    let legal_cluster = left.iter().map(|(cluster, _)| *cluster).max().unwrap_or(0);
    let legal_count = left.iter().map(|(_, count)| *count).max().unwrap_or(0);
    let n_pixels = spans.len() as f64;
    answer.limits = Limits {
        slack: SLACK,
        cluster: MIN_CLUSTER.max(legal_cluster + 1),
        count: ((n_pixels * MIN_SHARE) as u32).max(2 * legal_count).max(MIN_CLUSTER),
        legal_cluster,
        legal_count,
        unearned: 0.0,
    };
    answer
}

/// Returns the envelope in whole levels of all members except `but`: its lower and its upper end.
fn bounds(spans: &[[Span; 3]], centre: &Image, but: Option<&Image>) -> (Vec<Levels>, Vec<Levels>) {
    let ends = |n: usize, at: usize| {
        let (least, greatest) = spans[n][at].without(but.map(|image| level(image.pixels()[n][at])));
        let (lo, hi) = (least.floor() as u8, greatest.ceil() as u8);
        if hi - lo <= 1 { [byte(centre.pixels()[n][at]); 2] } else { [lo, hi] }
    };
    let end =
        |which: usize| (0..spans.len()).map(|n| [0, 1, 2].map(|at| ends(n, at)[which])).collect();
    (end(0), end(1))
}

/// Returns the largest cluster and the count of the pixels of `member` outside the envelope of all
/// others.
fn left_out(answer: &ImageAnswer, spans: &[[Span; 3]], member: &Image) -> (u32, u32) {
    let (lo, hi) = bounds(spans, &answer.expected, Some(member));
    let out = ImageAnswer { lo, hi, ..answer.clone() }.out(member);
    (largest_cluster(&out, member.width()), out.iter().filter(|out| **out).count() as u32)
}

#[cfg(test)]
mod tests {
    use cases::glam::DVec3;

    use super::*;

    /// Returns 10 × 10 grey pixels, of which the listed ones have another level.
    fn grey(changes: &[(u32, u32, f64)]) -> Image {
        Image::from_fn(10, 10, |i, j| {
            let change = changes.iter().find(|(x, y, _)| (*x, *y) == (i, j));
            DVec3::splat(change.map_or(100.0, |(_, _, level)| *level) / 255.0)
        })
    }

    #[test]
    fn it_spans_the_members_and_rounds_outwards() {
        let answer = envelope(grey(&[]), &[grey(&[(4, 0, 90.5)]), grey(&[(4, 0, 120.5)])]);
        assert_eq!((answer.lo[4], answer.hi[4]), ([90; 3], [121; 3]));
        assert_eq!((answer.lo[5], answer.hi[5]), ([100; 3], [100; 3]));
        let close = envelope(grey(&[(4, 0, 99.8)]), &[grey(&[(4, 0, 99.3)])]);
        assert_eq!((close.lo[4], close.hi[4]), ([100; 3], [100; 3]));
        assert!(answer.is_contested(4) && !answer.is_contested(5));
    }

    #[test]
    fn limits_lie_above_what_a_member_leaves_outside_the_others() {
        let alike = envelope(grey(&[]), &[grey(&[]), grey(&[])]);
        let Limits { cluster, count, legal_cluster, legal_count, .. } = alike.limits;
        assert_eq!((cluster, count, legal_cluster, legal_count), (3, 3, 0, 0));
        let blob = [(1, 1, 50.0), (2, 1, 50.0), (1, 2, 50.0), (2, 2, 50.0), (8, 8, 50.0)];
        let strays = envelope(grey(&[]), &[grey(&blob), grey(&[])]);
        let Limits { cluster, count, legal_cluster, legal_count, .. } = strays.limits;
        assert_eq!((cluster, count, legal_cluster, legal_count), (5, 10, 4, 5));
        let agreed = envelope(grey(&[]), &[grey(&blob), grey(&blob)]);
        assert_eq!((agreed.limits.legal_cluster, agreed.limits.legal_count), (0, 0));
    }
}
