//! The direction and distance of a light, and the share of it that arrives. Stage 01.

use cases::Light;
use glam::DVec3;

/// Returns L, the unit vector from `point` to the light, and t_light, the distance to it; in world
/// space. [rule 5]
///
/// - A directional light stores the direction in which its light *travels*. L points the other way,
///   and t_light is infinite.
/// - A light exactly at the point has no direction. The result is the zero vector and 0, so that it
///   adds nothing.
pub fn to_light(light: &Light, point: DVec3) -> (DVec3, f64) {
    match light {
        Light::Point { position, .. } => {
            let way = position - point;
            (way.normalize_or_zero(), way.length())
        }
        Light::Directional { direction, .. } => (-direction, f64::INFINITY),
    }
}

/// Returns A = min(1, 1 / (a r² + b r + c)), the share of the light that arrives at distance `r`.
/// [rule 4]
///
/// - `r` is at least 0. a, b, c are the light's `quadratic`, `linear` and `constant`; none is
///   negative, and not all are 0.
/// - Light is never amplified: if the denominator is less than 1 (even 0), the result is 1.
/// - A directional light does not weaken: the result is 1.
pub fn distance_attenuation(light: &Light, r: f64) -> f64 {
    match light {
        Light::Point { attenuation, .. } => {
            let denominator =
                attenuation.quadratic * r * r + attenuation.linear * r + attenuation.constant;
            (1.0 / denominator).min(1.0)
        }
        Light::Directional { .. } => 1.0,
    }
}
