//! Runs and judges the image cases. A case that earns points is rendered twice: pictures that
//! differ come from a race, from unset memory, or from random numbers, and the worse one counts.
//!
//! The system gives each process another layout of addresses, so that a program whose picture
//! depends on them is found as well.

use cases::film::Image;
use cases::stage::Case;

use super::verdicts;
use crate::exam::Questions;
use crate::exercise::Rendered;
use crate::judge::Judgement;
use crate::record::{Finding, FindingKind, Verdict};
use crate::sandbox::{Clock, Outcome};
use crate::score;

/// A picture of the program, or the lack of one, and the judgement on it.
struct Shown {
    judgement: Judgement,
    picture: Option<Image>,
}

/// Judges `first`, and renders the case once more by `again` if its picture earns points.
///
/// Returns the judgement, and the picture that it is about.
pub(super) fn judged(
    first: &Rendered,
    (questions, case): (&Questions, &Case),
    again: impl FnOnce() -> Rendered,
) -> (Judgement, Option<Image>) {
    let shown = Shown::new(first, questions, case);
    if !shown.judgement.earns() {
        return (shown.judgement, shown.picture);
    }
    let shown = shown.beside(&again(), questions, case);
    (shown.judgement, shown.picture)
}

impl Shown {
    fn new(run: &Rendered, questions: &Questions, case: &Case) -> Self {
        let judgement = verdicts::of_shot(run, questions, case);
        Self { judgement, picture: run.picture.as_ref().ok().cloned() }
    }

    /// Returns the worse of two runs, with a remark if they differ.
    fn beside(self, second: &Rendered, questions: &Questions, case: &Case) -> Self {
        if !counts(&second.finished.outcome) {
            return self;
        }
        let n_pixels = match (&self.picture, &second.picture) {
            (Some(one), Ok(other)) => n_different(one, other),
            _ => 0,
        };
        if n_pixels == 0 && second.picture.is_ok() {
            return self;
        }
        let second = Self::new(second, questions, case);
        if second.judgement.verdict == Verdict::Ours {
            return self;
        }
        let worse = if second.worth() < self.worth() { second } else { self };
        Self { judgement: nondeterministic(worse.judgement, n_pixels), ..worse }
    }

    /// Returns the thousandths of its points that the picture earns.
    fn worth(&self) -> u64 {
        score::score(self.judgement.verdict, self.judgement.share, 1000).earned
    }
}

/// Returns whether the end of a second run says something about the program. One that ends at a
/// limit of time or memory may have been just below it before.
fn counts(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Exited(_) | Outcome::Signalled(_) | Outcome::TimedOut(Clock::Idle))
}

/// Returns the number of pixels that differ in any bit.
fn n_different(one: &Image, other: &Image) -> usize {
    let bits = |colour: &cases::glam::DVec3| colour.to_array().map(f64::to_bits);
    one.pixels().iter().zip(other.pixels()).filter(|(a, b)| bits(a) != bits(b)).count()
}

/// Returns `worse` with a finding that says that two runs gave different results, which differ in
/// `n_pixels` if both gave a picture.
fn nondeterministic(worse: Judgement, n_pixels: usize) -> Judgement {
    let differ = match n_pixels {
        0 => "the program gave a picture in one of two runs, and none in the other".to_owned(),
        1 => "two runs of the program gave pictures that differ in 1 pixel".to_owned(),
        n => format!("two runs of the program gave pictures that differ in {n} pixels"),
    };
    let finding = worse.finding.unwrap_or_else(|| {
        Finding::new(FindingKind::Nondeterministic, "both of them count as right")
    });
    let message = match worse.verdict {
        Verdict::Pass => format!("{differ}; {}", finding.message),
        _ => format!("{differ}; the worse one counts: {}", finding.message),
    };
    let finding = Finding { kind: FindingKind::Nondeterministic, message, ..finding };
    Judgement { finding: Some(finding), ..worse }
}

#[cfg(test)]
mod tests {
    use cases::glam::DVec3;

    use super::*;

    #[test]
    fn pictures_that_differ_in_a_bit_are_counted() {
        let grey = Image::from_fn(3, 2, |_, _| DVec3::splat(0.5));
        let next = Image::from_fn(3, 2, |i, _| match i {
            0 => DVec3::new(0.5, 0.5_f64.next_up(), 0.5),
            _ => DVec3::splat(0.5),
        });
        let nan = Image::from_fn(3, 2, |_, _| DVec3::splat(f64::NAN));
        assert_eq!(n_different(&grey, &grey), 0);
        assert_eq!(n_different(&grey, &next), 2);
        assert_eq!(n_different(&nan, &nan), 0, "the same bits");
    }

    fn check(worse: Judgement, n_pixels: usize, expected: &str) {
        let verdict = worse.verdict;
        let judged = nondeterministic(worse, n_pixels);
        let finding = judged.finding.expect("a finding");
        assert_eq!((judged.verdict, &*finding.message), (verdict, expected));
        assert_eq!(finding.kind, FindingKind::Nondeterministic);
    }

    #[test]
    fn the_finding_says_what_differs_and_what_counts() {
        let wrong = || Judgement::partial(Finding::new(FindingKind::Wrong, "1 pixel is out"), 500);
        let crash = Judgement::fail(Finding::new(FindingKind::Crash, "it ended with code 1"));
        let two = "two runs of the program gave pictures that differ in";
        check(Judgement::PASS, 2, &format!("{two} 2 pixels; both of them count as right"));
        check(wrong(), 1, &format!("{two} 1 pixel; the worse one counts: 1 pixel is out"));
        check(
            crash,
            0,
            "the program gave a picture in one of two runs, and none in the other; the worse one \
             counts: it ended with code 1",
        );
    }

    #[test]
    fn a_run_at_a_limit_of_time_or_memory_does_not_count() {
        for (outcome, expected) in [
            (Outcome::Exited(0), true),
            (Outcome::Signalled(11), true),
            (Outcome::TimedOut(Clock::Idle), true),
            (Outcome::TimedOut(Clock::Cpu), false),
            (Outcome::OutOfMemory, false),
            (Outcome::Interrupted, false),
        ] {
            assert_eq!(counts(&outcome), expected, "{outcome:?}");
        }
    }
}
