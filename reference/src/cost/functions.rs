//! Measurements of single functions over the hard families: the time of an answer, its error, and
//! the number of wrong decisions.

use super::measure::Outside;
use super::setting::Formula;
use super::times::Times;
use crate::expect::variations::Precision;
use crate::hard::evaluate::{Prepared, answer};
use crate::hard::survey::questions;
use crate::hard::{FAMILIES, Family, Question, SurveyCounts, survey};
use crate::numbers::real::Real;
use crate::rules::{PlaneFormula, Quadratic, Rules, Snell, Style, TriangleFormula};

/// The number of questions of each family in a timed batch.
const BATCH: u64 = 128;
/// The number of times that a batch is answered in a row. This takes some tenths of a millisecond,
/// which every clock can resolve.
const REPEATS: usize = 64;
/// The seed of all draws.
const SEED: u64 = 1;

/// A function, computed by one formula in one precision.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The name of the function, such as `sphere`.
    pub function: &'static str,
    /// The formula in words.
    pub formula: &'static str,
    /// The precision of its scalars.
    pub precision: Precision,
    /// The rules of the lecture, in the style of the formula.
    pub rules: Rules,
}

/// The measurements of one candidate.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The candidate.
    pub candidate: Candidate,
    /// Nanoseconds an answer over the generic family, including the setup of the question.
    pub ns: Times,
    /// Nanoseconds an answer over all families in equal parts.
    pub hard_ns: Times,
    /// The number of rounds that were timed.
    pub rounds: usize,
    /// The tally of each family of the function, in the order of [`FAMILIES`].
    pub tallies: Vec<(&'static str, SurveyCounts)>,
}

/// Returns every function by every formula in both precisions. The reference's own formula comes
/// first.
pub fn candidates() -> Vec<Candidate> {
    let mut functions: Vec<&'static str> = FAMILIES.iter().map(|family| family.function).collect();
    functions.dedup();
    let of = |function: &'static str| {
        let both = [Precision::F64, Precision::F32];
        ways(function).into_iter().flat_map(move |(formula, style)| {
            let rules = Rules { style, ..Rules::LECTURE };
            both.map(|precision| Candidate { function, formula, precision, rules })
        })
    };
    functions.into_iter().flat_map(of).collect()
}

/// Returns the formulas of a function, each with its name. The reference's own comes first.
fn ways(function: &str) -> Vec<(&'static str, Style)> {
    let stable = Formula::Stable.style();
    let quadratics = |n| {
        Quadratic::ALL[..n].iter().map(|q| (q.says(), Style { quadratic: *q, ..stable })).collect()
    };
    let others: Vec<(&'static str, Style)> = match function.trim_start_matches("transformed ") {
        "sphere" => quadratics(Quadratic::ALL.len()),
        // The last quadratic exists only for spheres.
        "cylinder" | "cone" => quadratics(Quadratic::ALL.len() - 1),
        "plane" => {
            PlaneFormula::ALL.iter().map(|p| (p.says(), Style { plane: *p, ..stable })).collect()
        }
        "triangle" => TriangleFormula::ALL
            .iter()
            .map(|t| (t.says(), Style { triangle: *t, ..stable }))
            .collect(),
        "refract" => Snell::ALL.iter().map(|s| (s.says(), Style { snell: *s, ..stable })).collect(),
        _ => vec![("plain", stable)],
    };
    [("robust", Style::REFERENCE)].into_iter().chain(others).collect()
}

/// Returns the number of steps of a measurement, for a progress bar.
pub fn work(candidates: &[Candidate], n_rounds: usize) -> u64 {
    let families: usize = candidates.iter().map(|one| families(one.function).count()).sum();
    (families + candidates.len() * n_rounds) as u64
}

fn families(function: &str) -> impl Iterator<Item = &'static Family> {
    FAMILIES.iter().filter(move |family| family.function == function)
}

/// Surveys every candidate with `n_draws` questions a family, then times all candidates in
/// interleaved rounds.
///
/// Returns `None` if it is stopped before the first round is complete. Later, the complete rounds
/// count. Surveys run in the current `rayon` pool; the timed calls run on this thread.
pub fn measure(
    candidates: &[Candidate],
    n_draws: u64,
    n_rounds: usize,
    outside: &mut impl Outside,
) -> Option<Vec<Measured>> {
    let mut surveyed = Vec::new();
    for candidate in candidates {
        let mut tallies = Vec::new();
        for family in families(candidate.function) {
            if !outside.goes_on() {
                return None;
            }
            let tally = match candidate.precision {
                Precision::F32 => survey::<f32, _>(family, &candidate.rules, n_draws, SEED),
                Precision::F64 => survey::<f64, _>(family, &candidate.rules, n_draws, SEED),
            };
            tallies.push((family.name, tally));
            outside.done(1);
        }
        surveyed.push(tallies);
    }
    let batches: Vec<[Vec<Question>; 2]> = candidates.iter().map(batches).collect();
    let mut times = vec![[Vec::new(), Vec::new()]; candidates.len()];
    for round in 0..n_rounds {
        let Some(one) = one_round(candidates, &batches, round, outside) else { break };
        for (times, [ns, hard_ns]) in times.iter_mut().zip(one) {
            times[0].push(ns);
            times[1].push(hard_ns);
        }
    }
    if times.first().is_none_or(|[ns, _]| ns.is_empty()) {
        return None;
    }
    let measured =
        candidates.iter().zip(surveyed).zip(times).map(|((candidate, tallies), [ns, hard_ns])| {
            Measured {
                candidate: candidate.clone(),
                rounds: ns.len(),
                ns: Times::of(&ns),
                hard_ns: Times::of(&hard_ns),
                tallies,
            }
        });
    Some(measured.collect())
}

/// Returns two batches of questions: of the generic family, which is the first one of its function,
/// and of all families.
fn batches(candidate: &Candidate) -> [Vec<Question>; 2] {
    let drawn = |family: &Family| -> Vec<Question> {
        match candidate.precision {
            Precision::F32 => questions::<f32>(family, 0, BATCH, SEED).collect(),
            Precision::F64 => questions::<f64>(family, 0, BATCH, SEED).collect(),
        }
    };
    let all: Vec<Vec<Question>> = families(candidate.function).map(drawn).collect();
    [all.first().cloned().unwrap_or_default(), all.concat()]
}

/// Returns the nanoseconds an answer for both batches of every candidate. Each round begins with a
/// different candidate. `None` if it was stopped.
fn one_round(
    candidates: &[Candidate],
    batches: &[[Vec<Question>; 2]],
    round: usize,
    outside: &mut impl Outside,
) -> Option<Vec<[f64; 2]>> {
    let n = candidates.len();
    let mut ns = vec![[0.0; 2]; n];
    for at in (0..n).map(|step| (step + round * n.div_ceil(3)) % n) {
        if !outside.goes_on() {
            return None;
        }
        for (batch, ns) in batches[at].iter().zip(&mut ns[at]) {
            *ns = match candidates[at].precision {
                Precision::F32 => timed::<f32>(&candidates[at].rules, batch, outside),
                Precision::F64 => timed::<f64>(&candidates[at].rules, batch, outside),
            };
        }
        outside.done(1);
    }
    Some(ns)
}

/// Returns the nanoseconds an answer. Matrices are inverted before the clock starts.
fn timed<T: Real>(rules: &Rules, batch: &[Question], outside: &mut impl Outside) -> f64 {
    let ready: Vec<Prepared<T>> = batch.iter().map(Prepared::new).collect();
    let start = outside.now_s();
    answer_all(rules, &ready);
    1e9 * (outside.now_s() - start) / (REPEATS * batch.len().max(1)) as f64
}

#[inline(never)]
fn answer_all<T: Real>(rules: &Rules, ready: &[Prepared<T>]) {
    for _ in 0..REPEATS {
        for question in ready {
            std::hint::black_box(answer::<T, _>(std::hint::black_box(rules), question));
        }
    }
}
