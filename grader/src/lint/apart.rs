//! Which known mistakes the stored answers do not distinguish from each other.
//!
//! A check distinguishes two mistakes if the answer of one would fail where that of the other is
//! expected. A case distinguishes them if the picture of one would. Each pair is compared until a
//! question distinguishes it, so that few layers are compared pixel by pixel.

use cases::answer::{CheckAnswer, ImageAnswer, Levels, Wrong, largest_cluster};
use cases::probe::Answer;
use cases::stage::{Case, Check};

use crate::exam::{Exam, Questions};
use crate::judge;
use crate::record::Verdict;

use super::layers::{LayersError, layers};

/// The greatest difference in levels between two colours of stored layers that counts as equal: the
/// step to which they are rounded.
const STEP: u8 = 8;

/// The pairs of mistakes, by their indices, that no question so far distinguishes.
struct Pairs(Vec<[usize; 2]>);

impl Pairs {
    /// Returns all pairs of `n` mistakes.
    fn all(n: usize) -> Self {
        Self((0..n).flat_map(|b| (0..b).map(move |a| [a, b])).collect())
    }

    /// Keeps the pairs that a question does not distinguish. `of_mistakes` holds what it stores of
    /// each mistake, `None` for one that it does not show.
    fn keep<S>(&mut self, of_mistakes: &[Option<S>], is_alike: impl Fn(&S, &S) -> bool) {
        self.0.retain(|[a, b]| match (&of_mistakes[*a], &of_mistakes[*b]) {
            (None, None) => true,
            (Some(one), Some(other)) => is_alike(one, other),
            _ => false,
        });
    }
}

/// Returns the pairs of known mistakes that no case and no check of the exam distinguishes.
///
/// # Errors
/// The stored mistakes of a case cannot be read.
pub fn alike(exam: &Exam) -> Result<Vec<[&str; 2]>, LayersError> {
    let mistakes = &exam.mistakes;
    let mut pairs = Pairs::all(mistakes.len());
    for (function, right) in exam.stages.iter().flat_map(checks) {
        let given: Vec<_> = mistakes.iter().map(|one| right.wrong.get(&one.id)).collect();
        pairs.keep(&given, |one, other| answers_alike(right, function, one, other));
    }
    for (case, answer) in exam.stages.iter().flat_map(cases) {
        if pairs.0.is_empty() {
            break;
        }
        let layers = layers(exam, case)?;
        let of_id = |id: &str| layers.iter().find(|layer| layer.id == id);
        let stored: Vec<_> = mistakes.iter().map(|one| of_id(&one.id)).collect();
        pairs.keep(&stored, |one, other| layers_alike(answer, one, other));
    }
    Ok(pairs.0.into_iter().map(|pair| pair.map(|n| mistakes[n].id.as_str())).collect())
}

/// Returns the function that each check of a stage calls, with its answer.
fn checks(of_stage: &Questions) -> impl Iterator<Item = (&'static str, &CheckAnswer)> {
    let answered =
        move |check: &Check| Some((check.ask.function(), of_stage.units.get(&check.id)?));
    of_stage.stage.checks.iter().filter_map(answered)
}

/// Returns the image cases of a stage with their answers.
fn cases(of_stage: &Questions) -> impl Iterator<Item = (&Case, &ImageAnswer)> {
    of_stage.stage.cases.iter().filter_map(|case| Some((case, of_stage.images.get(&case.id)?)))
}

/// Returns whether the answer of one mistake passes where that of the other is expected.
fn answers_alike(right: &CheckAnswer, function: &str, one: &Answer, other: &Answer) -> bool {
    let expected = CheckAnswer { answer: one.clone(), also: vec![], ..right.clone() };
    judge::unit(other, &expected, function).verdict == Verdict::Pass
}

/// Returns whether a picture of one mistake would pass where that of the other is expected.
fn layers_alike(answer: &ImageAnswer, one: &Wrong, other: &Wrong) -> bool {
    let differs = |pair: (&Option<Levels>, &Option<Levels>)| match pair {
        (Some(a), Some(b)) => a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > STEP),
        (a, b) => a.is_some() != b.is_some(),
    };
    let n_pixels = answer.expected.pixels().len();
    let [one, other] = [one, other].map(|layer| by_pixel(layer, n_pixels));
    let out: Vec<bool> = one.iter().zip(&other).map(differs).collect();
    let count = out.iter().filter(|out| **out).count() as u32;
    answer.allows(largest_cluster(&out, answer.expected.width()), count)
}

/// Returns the change of each pixel of the picture.
fn by_pixel(layer: &Wrong, n_pixels: usize) -> Vec<Option<Levels>> {
    let mut changes = vec![None; n_pixels];
    for (pixel, levels) in layer.pixels.iter().zip(&layer.colours) {
        changes[*pixel as usize] = Some(*levels);
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_is_kept_until_a_question_distinguishes_it() {
        let mut pairs = Pairs::all(4);
        assert_eq!(pairs.0.len(), 6);
        let is_alike = |one: &i32, other: &i32| (one - other).abs() <= 1;
        pairs.keep(&[Some(1), Some(2), Some(3), None], is_alike);
        assert_eq!(pairs.0, [[0, 1], [1, 2]]);
        pairs.keep(&[None, None, Some(1), Some(1)], is_alike);
        assert_eq!(pairs.0, [[0, 1]]);
    }

    #[test]
    fn layers_differ_where_more_pixels_differ_than_pass() {
        let image = cases::film::Image::from_fn(10, 10, |_, _| cases::glam::DVec3::ZERO);
        let answer = ImageAnswer::exact(image, 1.0, 3);
        let wrong =
            |n: usize, level: u8| Wrong::new("", (0..100).map(|at| (at < n).then_some([level; 3])));
        let table =
            [(10, 80, true), (13, 80, true), (14, 80, false), (10, 88, true), (10, 96, false)];
        for (n, level, expected) in table {
            let found = layers_alike(&answer, &wrong(10, 80), &wrong(n, level));
            assert_eq!(found, expected, "{n} pixels of level {level}");
        }
    }

    #[test]
    fn answers_differ_by_more_than_what_is_allowed() {
        let right = CheckAnswer {
            id: "r".to_owned(),
            made_from: cases::answer::Digest::default(),
            answer: Answer::Value(1.0),
            allowed: 0.1,
            also: vec![],
            wrong: [].into(),
        };
        for (one, other, expected) in [(2.0, 2.05, true), (2.0, 2.2, false), (1.0, 2.0, false)] {
            let [a, b] = [one, other].map(Answer::Value);
            assert_eq!(answers_alike(&right, "attenuation", &a, &b), expected, "{one} {other}");
        }
    }
}
