//! Lights: directions to them, and their attenuation. [rule 4] [rule 5]

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{Attenuation, LightVector, RuleSource};
use crate::watch::work::{Tally, Work};

/// A light source.
#[derive(Clone, Copy, Debug)]
pub struct Light<T> {
    /// The colour I_j. [rule 3]
    pub colour: Vec3<T>,
    /// The ambient colour Ia_j. [rule 3]
    pub ambient: Vec3<T>,
    place: Place<T>,
}

#[derive(Clone, Copy, Debug)]
enum Place<T> {
    Point {
        position: Vec3<T>,
        quadratic: T,
        linear: T,
        constant: T,
        /// Whether the light never weakens, so that the division is skipped: unclamped, and
        /// clamped to 1. [rule 4]
        is_steady: [bool; 2],
    },
    /// A directional light, with the direction in which the light travels.
    Far { direction: Vec3<T> },
}

impl<T: Real> Light<T> {
    /// Returns the light in the precision `T`.
    pub fn of(light: &cases::Light) -> Self {
        let place = match light {
            cases::Light::Point { position, attenuation, .. } => Place::Point {
                position: Vec3::of(*position),
                quadratic: T::of(attenuation.quadratic),
                linear: T::of(attenuation.linear),
                constant: T::of(attenuation.constant),
                is_steady: [
                    *attenuation == cases::scene::Attenuation::NONE,
                    attenuation.quadratic == 0.0
                        && attenuation.linear == 0.0
                        && T::of(attenuation.constant) <= T::ONE,
                ],
            },
            cases::Light::Directional { direction, .. } => {
                Place::Far { direction: Vec3::of(*direction) }
            }
        };
        Self { colour: Vec3::of(light.colour()), ambient: Vec3::of(light.ambient()), place }
    }

    /// Returns whether the light may weaken with distance, clamped to 1 or not. [rule 4]
    pub fn weakens(&self) -> bool {
        matches!(self.place, Place::Point { is_steady: [unclamped, clamped], .. }
            if !(unclamped && clamped))
    }

    /// Returns L, the unit vector towards the light, and t_light, which is infinite for a
    /// directional light. The result is `None` if `point` is the position of the point light.
    /// [rule 5]
    #[inline(always)]
    pub fn direction_from<R: RuleSource>(&self, rules: R, point: Vec3<T>) -> Option<(Vec3<T>, T)> {
        match self.place {
            Place::Point { position, .. } => {
                let way = position - point;
                let r = way.length();
                (r > T::ZERO).then(|| match rules.get().light_vector {
                    LightVector::Unit => (way * (T::ONE / r), r),
                    LightVector::NotUnit => (way, r),
                    LightVector::Reversed => (way * (-T::ONE / r), r),
                })
            }
            Place::Far { direction } if rules.get().towards_light => Some((-direction, sun(rules))),
            Place::Far { direction } => Some((direction, sun(rules))),
        }
    }

    /// Returns A_j = min(1, 1/(a r² + b r + c)) at the distance `r`. [rule 4]
    ///
    /// The result is 1 for a directional light, and at every distance for (a, b, c) = (0, 0, 1). At
    /// infinite distance it is the limit: 0 if a or b is positive, otherwise min(1, 1/c).
    #[inline(always)]
    pub fn attenuation<R: RuleSource>(&self, rules: R, r: T, tally: &mut impl Tally) -> T {
        let Place::Point { quadratic, linear, constant, is_steady, .. } = self.place else {
            return T::ONE;
        };
        let [unclamped, clamped] = is_steady;
        let is_steady = match rules.get().attenuation {
            Attenuation::Clamped => clamped,
            Attenuation::Unclamped | Attenuation::Absent | Attenuation::NotSquared => unclamped,
            Attenuation::WithoutLinear | Attenuation::LinearSquared => unclamped,
            Attenuation::Swapped
            | Attenuation::WithoutConstant
            | Attenuation::OnePlus
            | Attenuation::InverseSquare => false,
        };
        if is_steady {
            return T::ONE;
        }
        tally.did(Work::Attenuation);
        let weakened =
            |a: T, r_squared: T, c: T| T::ONE / distance_sum([a, linear, c], [r_squared, r]);
        let cut = |sum: [T; 3]| (T::ONE / distance_sum(sum, [r * r, r])).least(T::ONE);
        match rules.get().attenuation {
            Attenuation::Clamped => weakened(quadratic, r * r, constant).least(T::ONE),
            Attenuation::Unclamped => weakened(quadratic, r * r, constant),
            Attenuation::Absent => T::ONE,
            Attenuation::Swapped => weakened(constant, r * r, quadratic).least(T::ONE),
            Attenuation::NotSquared => weakened(quadratic, r, constant).least(T::ONE),
            Attenuation::WithoutLinear => cut([quadratic, T::ZERO, constant]),
            Attenuation::WithoutConstant => cut([quadratic, linear, T::ZERO]),
            Attenuation::LinearSquared => cut([quadratic + linear, T::ZERO, constant]),
            Attenuation::OnePlus => cut([quadratic, linear, constant + T::ONE]),
            Attenuation::InverseSquare => cut([T::ONE, T::ZERO, T::ZERO]),
        }
    }
}

/// Returns t_light of a directional light. [rule 5]
#[inline(always)]
fn sun<T: Real, R: RuleSource>(rules: R) -> T {
    if rules.get().endless_sun { T::INFINITY } else { T::ONE }
}

/// Returns a r² + b r + c. A coefficient of 0 adds 0 even if its power of r overflows.
#[inline(always)]
fn distance_sum<T: Real>([a, b, c]: [T; 3], [r_squared, r]: [T; 2]) -> T {
    let sum = a * r_squared + b * r + c;
    if sum.is_finite() { sum } else { term_by_term([a, b, c], [r_squared, r]) }
}

/// Returns a r² + b r + c without the products of 0 and ∞. The function is cold because no picture
/// needs it: it stays out of the loop over lights.
#[cold]
fn term_by_term<T: Real>([a, b, c]: [T; 3], [r_squared, r]: [T; 2]) -> T {
    let term = |coefficient: T, power: T| {
        if coefficient == T::ZERO { T::ZERO } else { coefficient * power }
    };
    term(a, r_squared) + term(b, r) + c
}
