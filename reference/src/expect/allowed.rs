//! The allowed error of an answer, from the conditioning of the question in single precision.
//!
//! Each number x of the question is changed by a relative u = 2⁻²³, one at a time. If the answer f
//! changes by Δ, then a program in single precision may be off by as much: it cannot even store x
//! more accurately. A well-made formula rounds a handful of times:
//!
//! ```text
//! allowed = 8 (u ‖f‖ + Σ_x max |Δ|)
//! ```
//!
//! where u ‖f‖ is the rounding of the answer itself. `Nudges` says which numbers are changed.

use std::iter;

use cases::probe::{Answer, Ask};

use super::nudges::Nudges;
use crate::rules::Rules;
use crate::trace::answers::answer;

/// The relative size of one rounding in single precision.
const SINGLE: f64 = 1.0 / (1u32 << 23) as f64;
/// The number of roundings that a well-made formula may use.
const ROUNDINGS: f64 = 8.0;

/// The answers that are accepted beside the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct Allowance {
    /// The allowed absolute error of each number.
    pub allowed: f64,
    /// The correct answers that decide otherwise, because the decision flips within rounding.
    pub also: Vec<Answer>,
}

impl Allowance {
    /// Returns whether `given` is accepted if `right` is the correct answer.
    pub fn takes(&self, right: &Answer, given: &Answer) -> bool {
        iter::once(right).chain(&self.also).any(|legal| is_near(legal, given, self.allowed))
    }
}

/// The reason why the error of an answer has no bound.
#[derive(Debug, thiserror::Error)]
pub enum AllowanceError {
    /// The answer jumps.
    #[error(
        "the answer jumps where {place} is rounded to single precision: choose numbers farther \
         from the edge"
    )]
    Jump {
        /// The place of the number in the question.
        place: String,
    },
    /// The question has no JSON form.
    #[error("the question cannot be encoded")]
    Encode(#[from] serde_json::Error),
}

/// Returns the allowance of a question and its answer.
///
/// Where a changed number leads to another decision, the answer with that decision is correct as
/// well. Changed numbers that lead to about the same other answer are counted towards its error.
/// The greatest of all errors is allowed of every answer.
///
/// # Errors
/// The answer jumps without a change of decision, such as from one object's colour to another's. No
/// error bound describes a jump, and the author must choose other numbers.
pub fn allowance(rules: &Rules, ask: &Ask, exact: &Answer) -> Result<Allowance, AllowanceError> {
    let nudges = Nudges::of(ask)?;
    let mut allowed = SINGLE * size(exact);
    let mut others: Vec<(Answer, f64)> = Vec::new();
    for place in nudges.places() {
        let moved = |relative: f64| Some(answer(rules, &nudges.nudged(place, relative)?));
        let mut most = 0.0f64;
        for sign in [-1.0, 1.0] {
            let Some(other) = moved(sign * SINGLE) else { continue };
            let Some(distance) = distance(exact, &other) else {
                add_other(&mut others, other);
                continue;
            };
            let nearer =
                moved(sign * SINGLE / 16.0).and_then(|nearer| self::distance(exact, &nearer));
            if is_jump(distance, exact) && nearer.is_some_and(|nearer| nearer > distance / 2.0) {
                return Err(AllowanceError::Jump { place: place.join(", ") });
            }
            most = most.max(distance);
        }
        allowed += most;
    }
    let allowed = others.iter().map(|(_, error)| *error).fold(allowed, f64::max);
    let also = others.into_iter().map(|(other, _)| other).collect();
    Ok(Allowance { allowed: ROUNDINGS * allowed, also })
}

/// Adds an answer with another decision to those found before, each with its error: as one more, or
/// to the error of one from which it does not jump.
fn add_other(others: &mut Vec<(Answer, f64)>, other: Answer) {
    for (known, error) in others.iter_mut() {
        if let Some(distance) = distance(known, &other).filter(|far| !is_jump(*far, known)) {
            *error += distance;
            return;
        }
    }
    let error = SINGLE * size(&other);
    others.push((other, error));
}

/// Returns whether a change of an answer by `distance` is more than rounding explains.
fn is_jump(distance: f64, answer: &Answer) -> bool {
    distance > 1e-4 * size(answer).max(1e-3)
}

/// Returns the size of the greatest finite number of an answer.
fn size(answer: &Answer) -> f64 {
    numbers(answer).into_iter().filter(|n| n.is_finite()).fold(0.0, |most, n| n.abs().max(most))
}

/// Returns whether two answers decide alike, and their numbers are at most `allowed` apart.
fn is_near(one: &Answer, other: &Answer, allowed: f64) -> bool {
    let is_near = |(a, b): (f64, f64)| a == b || (a - b).abs() <= allowed;
    decision(one) == decision(other) && numbers(one).into_iter().zip(numbers(other)).all(is_near)
}

/// Returns the greatest finite difference of two answers' numbers, or `None` if they decide
/// differently.
fn distance(one: &Answer, other: &Answer) -> Option<f64> {
    if decision(one) != decision(other) {
        return None;
    }
    let pairs = numbers(one).into_iter().zip(numbers(other));
    Some(
        pairs
            .filter(|(a, b)| a != b)
            .map(|(a, b)| (a - b).abs())
            .filter(|d| d.is_finite())
            .fold(0.0, f64::max),
    )
}

/// Returns what an answer decides: its kind, its object, its yes or no.
fn decision(answer: &Answer) -> (&'static str, usize) {
    match answer {
        Answer::Hit { .. } => ("hit", 0),
        Answer::Found { object, .. } => ("found", *object),
        Answer::Miss(_) => ("miss", 0),
        Answer::Ray { .. } => ("ray", 0),
        Answer::Value(_) => ("value", 0),
        Answer::Vector(_) => ("vector", 0),
        Answer::Colour(_) => ("colour", 0),
        Answer::Facing { inside, .. } => ("facing", usize::from(*inside)),
        Answer::ToLight { .. } => ("to_light", 0),
        Answer::Indices { .. } => ("indices", 0),
        Answer::GoesOn(goes_on) => ("goes_on", usize::from(*goes_on)),
        Answer::Todo(_) => ("todo", 0),
        Answer::Panic(_) => ("panic", 0),
    }
}

/// Returns the numbers of an answer, in order.
pub fn numbers(answer: &Answer) -> Vec<f64> {
    match answer {
        Answer::Hit { t, normal } => [vec![*t], normal.to_array().to_vec()].concat(),
        Answer::Found { t, .. } => vec![*t],
        Answer::Ray { origin, direction } => [origin.to_array(), direction.to_array()].concat(),
        Answer::Value(value) => vec![*value],
        Answer::Vector(vector) | Answer::Colour(vector) => vector.to_array().to_vec(),
        Answer::Facing { normal, .. } => normal.to_array().to_vec(),
        Answer::ToLight { direction, t } => [direction.to_array().to_vec(), vec![*t]].concat(),
        Answer::Indices { eta_i, eta_t } => vec![*eta_i, *eta_t],
        Answer::Miss(_) | Answer::GoesOn(_) | Answer::Todo(_) | Answer::Panic(_) => vec![],
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn sphere(x: f64) -> Ask {
        let ray = cases::Ray::new(DVec3::new(x, 0.0, 2.0), DVec3::NEG_Z);
        Ask::Sphere { ray, center: DVec3::ZERO, radius: 0.5 }
    }

    fn check(ask: &Ask) -> Result<Allowance, AllowanceError> {
        allowance(&Rules::LECTURE, ask, &answer(&Rules::LECTURE, ask))
    }

    #[test]
    fn a_plain_question_is_allowed_a_few_roundings() {
        // t = (2 − 0.5) / 1: origin, direction and radius move it by 2u, 1.5u, 0.5u; t itself
        // rounds by 1.5u. t_min moves nothing.
        let allowance = check(&sphere(0.0)).unwrap();
        assert_eq!(allowance.also, []);
        assert!((allowance.allowed / (8.0 * 5.5 * SINGLE) - 1.0).abs() < 1e-3, "{allowance:?}");
    }

    #[test]
    fn a_touching_ray_may_also_miss() {
        let touching = check(&sphere(0.5)).unwrap();
        assert_eq!(touching.also, [Answer::Miss(true)]);
        assert!(touching.allowed > 1e-3, "a double root is badly conditioned: {touching:?}");
        assert_eq!(check(&sphere(0.4)).unwrap().also, []);
    }

    #[test]
    fn corners_in_a_line_may_also_be_hit_from_either_side() {
        let [a, b, c] = [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::new(2.0, 2.0, 0.0)];
        let ray = cases::Ray::new(DVec3::ONE, DVec3::NEG_Z);
        let sliver = check(&Ask::Triangle { ray, a, b, c }).unwrap();
        assert!(sliver.allowed < 1e-5, "{sliver:?}");
        for normal in [DVec3::Z, DVec3::NEG_Z] {
            assert!(sliver.takes(&Answer::Miss(true), &Answer::Hit { t: 1.0, normal }));
        }
        for wrong in [Answer::Hit { t: 2.0, normal: DVec3::Z }, Answer::Value(1.0)] {
            assert!(!sliver.takes(&Answer::Miss(true), &wrong), "{wrong:?}");
        }
    }

    #[test]
    fn a_question_at_the_edge_of_a_shadow_is_refused() {
        let scene = crate::testing::scene(
            r#"
            [scene.materials]
            chalk = { kd = [0.8, 0.8, 0.8] }
            [[scene.lights]]
            point = { position = [0, 2, 0], colour = [1, 1, 1] }
            [[scene.objects]]
            box = { min = [-0.5, -0.5, -0.5], max = [0.5, 0.5, 0.5] }
            material = "chalk"
            [[scene.objects]]
            plane = { normal = [0, 1, 0], k = -1 }
            material = "chalk"
            "#,
        );
        // The shadow of the corner (0.5, 0.5) of the box's top, 1.5 below the lamp, ends at 0.5 · 3
        // / 1.5 on the floor.
        let ask =
            Ask::Shadow { scene: Box::new(scene), light: 0, point: DVec3::new(1.0, -1.0, 0.0) };
        let error = check(&ask).unwrap_err();
        assert!(matches!(error, AllowanceError::Jump { .. }), "{error}");
    }
}
