//! Tests of the catalogue of hard cases in both precisions: decisions are exact, and values are
//! within the error that the conditioning allows.

use crate::common::catalogue::{self, Hard};
use reference::hard::evaluate;
use reference::hard::oracle::right;
use reference::hard::survey::{Comparison, compare};
use reference::numbers::real::Real;
use reference::rules::{Lecture, Quadratic, Robustness, RuleSource, Rules, Style, TriangleFormula};

/// The number of roundings that a good formula may make, before conditioning.
const ROUNDINGS: f64 = 8.0;
/// The allowed roundings if the conditioning would excuse more than half of the digits: 1e-14 in
/// double precision.
const ROUNDINGS_WHERE_BADLY_CONDITIONED: f64 = 45.0;

const NONE: [&str; 0] = [];

/// Returns the greatest relative error that is allowed in the precision `T`, for the condition
/// number `kappa`.
fn allowed<T: Real>(kappa: f64) -> f64 {
    let allowed = (ROUNDINGS * (1.0 + kappa)).ceil() * T::ULP.f64();
    if allowed > T::ULP.sqrt().f64() {
        ROUNDINGS_WHERE_BADLY_CONDITIONED * T::ULP.f64()
    } else {
        allowed
    }
}

/// Returns what is wrong with the answer to a case in the precision `T`. `None` if it is correct,
/// or if `T` cannot represent the question.
fn wrong<T: Real, R: RuleSource>(rules: R, hard: &Hard) -> Option<String> {
    let question = hard.question.rounded::<T>();
    let mut is_finite = true;
    question.map(&mut |x| {
        is_finite &= x.is_finite();
        x
    });
    if !is_finite {
        return None; // The precision cannot represent the question.
    }
    let reply = evaluate::<T, R>(rules, &question);
    let limit = hard.kappa.map_or(f64::INFINITY, allowed::<T>);
    match compare::<T>(&right(&question), &reply) {
        Comparison::Same { t, vector } if t <= limit && vector <= limit => None,
        other => Some(format!("{}: {other:?}, allowed {limit:.1e}: {reply:?}", hard.id)),
    }
}

/// Returns the ids of the cases that are answered wrongly. Prints the reason of each to the error
/// stream.
fn all_wrong<T: Real, R: RuleSource>(rules: R) -> Vec<String> {
    let cases = catalogue::hard();
    let wrong = cases.iter().filter_map(|hard| Some((hard, wrong::<T, R>(rules, hard)?)));
    wrong
        .map(|(hard, why)| {
            eprintln!("{why}");
            hard.id.clone()
        })
        .collect()
}

#[test]
fn the_oracle_agrees_with_the_catalogue() {
    let cases = catalogue::hard();
    assert_eq!(cases.len(), 140, "cases that are calls of one function");
    for hard in &cases {
        let found = right(&hard.question);
        assert_eq!(found.is_some(), hard.is_hit, "{}", hard.id);
        let in_single = hard.question.rounded::<f32>();
        let mut is_finite = true;
        in_single.map(&mut |x| {
            is_finite &= x.is_finite();
            x
        });
        assert!(
            !is_finite || right(&in_single).is_some() == hard.is_hit_in_single,
            "{} in f32",
            hard.id
        );
        let Some(found) = found else { continue };
        let near = |a: f64, b: f64, scale: f64| a == b || (a - b).abs() <= f64::EPSILON * scale;
        if let (Some(t), Some(expected)) = (&found.t, hard.t) {
            assert!(
                near(t.f64(), expected, expected),
                "{}: t = {} is not {expected}",
                hard.id,
                t.f64()
            );
        }
        for (found, expected) in [(found.vector, hard.vector), (found.weights, hard.weights)] {
            let (Some(found), Some(expected)) = (found, expected) else { continue };
            let found = found.map(|x| x.f64());
            let scale = expected.iter().map(|x| x.abs()).fold(0.0, f64::max);
            assert!(
                (0..3).all(|n| near(found[n], expected[n], scale)),
                "{}: {found:?} is not {expected:?}",
                hard.id
            );
        }
    }
}

#[test]
fn every_case_is_answered_correctly() {
    assert_eq!(all_wrong::<f64, _>(Lecture), NONE, "in f64");
    assert_eq!(all_wrong::<f32, _>(Lecture), NONE, "in f32");
}

#[test]
fn of_two_triangles_that_share_an_edge_one_is_hit() {
    let cases = catalogue::hard();
    let is_hit = |id: &str| {
        let hard =
            cases.iter().find(|hard| hard.id == id).unwrap_or_else(|| panic!("no case {id}"));
        [
            evaluate::<f64, _>(Lecture, &hard.question).is_some(),
            evaluate::<f32, _>(Lecture, &hard.question).is_some(),
        ]
    };
    let pairs: Vec<_> =
        cases.iter().filter_map(|hard| Some((&hard.id, hard.pair.as_ref()?))).collect();
    assert!(pairs.len() >= 4, "{pairs:?}");
    for (one, other) in pairs {
        for (one_hit, other_hit) in is_hit(one).into_iter().zip(is_hit(other)) {
            assert!(one_hit || other_hit, "lost between {one} and {other}");
        }
    }
}

#[test]
fn textbook_formulas_fail_where_they_are_known_to() {
    let style = Style { robustness: Robustness::Plain, ..Style::REFERENCE };
    let textbook = Style {
        quadratic: Quadratic::Textbook,
        triangle: TriangleFormula::MollerTrumbore,
        ..style
    };
    let rules = Rules { style: textbook, ..Rules::LECTURE };
    let wrong = all_wrong::<f64, _>(&rules);
    for id in ["S06", "S33", "S52", "S57", "S65", "X14", "F10"] {
        assert!(wrong.iter().any(|wrong| wrong == id), "{id} is no trap: {wrong:?}");
    }
    assert!(
        !wrong
            .iter()
            .any(|id| ["S40", "P01", "X01", "F01", "R01", "C01", "G01"].contains(&id.as_str())),
        "{wrong:?}"
    );
}
