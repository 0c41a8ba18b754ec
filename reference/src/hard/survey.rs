//! Surveys: the reference answers many questions of a family, and each answer is compared with the
//! oracle's.

use rayon::prelude::*;

use super::draws::Draws;
use super::evaluate::{Found, Reply, evaluate};
use super::exact::Exact;
use super::families::Family;
use super::oracle::right;
use super::question::Question;
use crate::numbers::real::Real;
use crate::rules::RuleSource;

/// A t that is off by more than this share is another hit, not an inexact one.
const ELSEWHERE: f64 = 0.1;
/// The number of questions that share one stream of random numbers. The tally does not depend on
/// which thread evaluates which chunk.
const CHUNK: u64 = 1000;

/// The comparison of an answer with the oracle's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Comparison {
    /// The decision is correct. An error is 0 if the answer has no such number.
    Same {
        /// The relative error of t.
        t: f64,
        /// The greater error of the normal or direction, as a vector relative to its length, and of
        /// (α, β, γ), relative to 1.
        vector: f64,
    },
    /// The function reports a hit, the oracle a miss.
    FalseHit,
    /// The function reports a miss, the oracle a hit.
    FalseMiss,
    /// Both report a hit, but at different places.
    Elsewhere,
    /// The answer has a NaN.
    NotANumber,
}

/// The counts and greatest errors of a survey.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurveyCounts {
    /// The number of questions.
    pub n: u64,
    /// Questions whose correct answer is not a miss.
    pub n_hits: u64,
    /// Hits where the oracle has a miss, and where no rounding of an input excuses it.
    pub false_hits: u64,
    /// Misses where the oracle has a hit, and where no rounding of an input excuses it.
    pub false_misses: u64,
    /// Hits at another place that no rounding of an input excuses.
    pub elsewhere: u64,
    /// Answers with NaN.
    pub not_a_number: u64,
    /// Wrong decisions that are correct for a question with one number moved to its neighbour. They
    /// are not the formula's fault.
    pub doubtful: u64,
    /// The greatest relative error of t among the correct decisions.
    pub max_t: f64,
    /// The greatest error of a normal, a direction or (α, β, γ) among the correct decisions.
    pub max_vector: f64,
    /// The first question that was decided wrongly.
    pub first_wrong: Option<Question>,
    /// The question with the greatest error.
    pub worst: Option<Question>,
}

impl SurveyCounts {
    /// Returns the number of wrong answers that no rounding of the question excuses.
    pub fn wrong(&self) -> u64 {
        self.false_hits + self.false_misses + self.elsewhere + self.not_a_number
    }

    /// Returns the greatest relative error of any number.
    pub fn max_error(&self) -> f64 {
        self.max_t.max(self.max_vector)
    }

    /// Returns the greatest relative error in units of the last place of 1 in `T`.
    pub fn ulps<T: Real>(&self) -> f64 {
        self.max_error() / T::ULP.f64()
    }

    /// Returns this tally with another question added.
    fn with<T: Real>(mut self, question: &Question, reply: &Reply) -> Self {
        let right = right(question);
        self.n += 1;
        self.n_hits += u64::from(right.is_some());
        let comparison = compare::<T>(&right, reply);
        if let Comparison::Same { t, vector } = comparison {
            if t.max(vector) > self.max_error() {
                self.worst = Some(*question);
            }
            (self.max_t, self.max_vector) = (self.max_t.max(t), self.max_vector.max(vector));
        } else if comparison != Comparison::NotANumber && is_excused::<T>(question, reply) {
            self.doubtful += 1;
        } else {
            self.first_wrong = self.first_wrong.or(Some(*question));
            *match comparison {
                Comparison::FalseHit => &mut self.false_hits,
                Comparison::FalseMiss => &mut self.false_misses,
                Comparison::Elsewhere => &mut self.elsewhere,
                Comparison::NotANumber | Comparison::Same { .. } => &mut self.not_a_number,
            } += 1;
        }
        self
    }

    /// Returns the sum of both tallies. The questions of `self` came before those of `other`.
    fn and(self, other: Self) -> Self {
        let is_worse = other.max_error() > self.max_error();
        Self {
            n: self.n + other.n,
            n_hits: self.n_hits + other.n_hits,
            false_hits: self.false_hits + other.false_hits,
            false_misses: self.false_misses + other.false_misses,
            elsewhere: self.elsewhere + other.elsewhere,
            not_a_number: self.not_a_number + other.not_a_number,
            doubtful: self.doubtful + other.doubtful,
            max_t: self.max_t.max(other.max_t),
            max_vector: self.max_vector.max(other.max_vector),
            first_wrong: self.first_wrong.or(other.first_wrong),
            worst: if is_worse { other.worst } else { self.worst },
        }
    }
}

/// Answers `n` questions of the family, rounded to the precision `T`, by `rules`, and returns the
/// tally. It is the same on every machine. Runs in the current `rayon` pool.
pub fn survey<T: Real, R: RuleSource>(
    family: &Family,
    rules: R,
    n: u64,
    seed: u64,
) -> SurveyCounts {
    let chunks: Vec<SurveyCounts> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let questions = questions::<T>(family, chunk, CHUNK.min(n - chunk * CHUNK), seed);
            questions.fold(SurveyCounts::default(), |tally, question| {
                tally.with::<T>(&question, &evaluate::<T, R>(rules, &question))
            })
        })
        .collect();
    chunks.into_iter().fold(SurveyCounts::default(), SurveyCounts::and)
}

/// Returns the first `n` questions of a chunk of the family, rounded to the precision `T`.
pub fn questions<T: Real>(
    family: &Family,
    chunk: u64,
    n: u64,
    seed: u64,
) -> impl Iterator<Item = Question> {
    let decades = if T::ULP.f64() == f64::EPSILON { 150.0 } else { 30.0 };
    let mut draws = Draws::new(seed.wrapping_add(chunk << 32), family.name, decades);
    let draw = family.draw;
    (0..n).map(move |_| draw(&mut draws).rounded::<T>())
}

/// Compares a reply with the correct answer, for numbers of the precision `T`. If the correct t
/// overflows in `T`, an infinite t and a miss are correct too.
pub fn compare<T: Real>(right: &Option<Found<Exact>>, reply: &Reply) -> Comparison {
    let numbers = |found: &Found<f64>| {
        found.t.into_iter().chain(found.vector.into_iter().chain(found.weights).flatten()).collect()
    };
    let given: Vec<f64> = reply.as_ref().map(numbers).unwrap_or_default();
    if given.iter().any(|x| x.is_nan()) {
        return Comparison::NotANumber;
    }
    let is_beyond =
        |right: &Found<Exact>| right.t.as_ref().is_some_and(|t| !T::of(t.f64()).is_finite());
    let (right, reply) = match (right, reply) {
        (None, None) => return Comparison::Same { t: 0.0, vector: 0.0 },
        (Some(right), None) if is_beyond(right) => return Comparison::Same { t: 0.0, vector: 0.0 },
        (None, Some(_)) => return Comparison::FalseHit,
        (Some(_), None) => return Comparison::FalseMiss,
        (Some(right), Some(reply)) => (right, reply),
    };
    let t = match (&right.t, reply.t) {
        (Some(right), Some(given)) => t_error::<T>(right, given),
        _ => 0.0,
    };
    if t > ELSEWHERE {
        return Comparison::Elsewhere;
    }
    let vector = right
        .vector
        .as_ref()
        .zip(reply.vector)
        .map_or(0.0, |(right, given)| distance(right, given, true));
    let weights = right
        .weights
        .as_ref()
        .zip(reply.weights)
        .map_or(0.0, |(right, given)| distance(right, given, false));
    Comparison::Same { t, vector: vector.max(weights) }
}

fn t_error<T: Real>(right: &Exact, given: f64) -> f64 {
    if given.is_infinite() {
        return if T::of(right.f64()).is_finite() { f64::INFINITY } else { 0.0 };
    }
    (right - &Exact::of(given)).ratio(right).abs()
}

/// Returns ‖given − right‖, divided by ‖right‖ if `is_relative`. Infinite if a component of `given`
/// is.
fn distance(right: &[Exact; 3], given: [f64; 3], is_relative: bool) -> f64 {
    let squares = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if given.iter().any(|x| x.is_infinite()) {
        return f64::INFINITY;
    }
    let off = squares(std::array::from_fn(|n| (&right[n] - &Exact::of(given[n])).f64()));
    if is_relative { off / squares(std::array::from_fn(|n| right[n].f64())) } else { off }
}

/// Returns whether the reply is correct for a question with one number moved to its neighbour in
/// the precision `T`.
pub fn is_excused<T: Real>(question: &Question, reply: &Reply) -> bool {
    question
        .moved::<T>()
        .any(|moved| matches!(compare::<T>(&right(&moved), reply), Comparison::Same { .. }))
}
