//! Mirrored and transmitted directions. [rule 7] [rule 8] [rule 9] [rule 10] [rule 19]
//!
//! d is the ray's direction, a unit vector; normals are turned against it.

use crate::real::Real;
use crate::rules::{Bend, Leaving, Mirror, ReflectBy, RefractBy, RuleSource, Snell, TotalReflection};
use crate::vec3::Vec3;

/// R = d − 2 (d·N) N. [rule 7]
#[inline(always)]
pub fn reflect<T: Real, R: RuleSource>(rules: R, d: Vec3<T>, n: Vec3<T>) -> Vec3<T> {
    let along = n * d.dot(n);
    match rules.get().mirror {
        Mirror::Lecture => d - along * T::TWO,
        Mirror::Backwards => along * T::TWO - d,
        Mirror::Tangential => d - along,
    }
}

/// (η_i, η_t) for a material of that index in air. [rule 9]
#[inline(always)]
pub fn indices<T: Real, R: RuleSource>(rules: R, is_inside: bool, index: T) -> (T, T) {
    let air = T::of(rules.get().air);
    match rules.get().leaving {
        Leaving::Swapped if is_inside => (index, air),
        _ => (air, index),
    }
}

/// T by Snell's law, or `None` for total internal reflection; exactly at the critical angle the ray goes along the surface.
/// [rule 8] [rule 10]
///
/// cos²θ_t is written as a sum of two terms that do not cancel where η_i and η_t are nearly equal.
#[inline(always)]
pub fn refract<T: Real, R: RuleSource>(rules: R, d: Vec3<T>, n: Vec3<T>, eta_i: T, eta_t: T) -> Option<Vec3<T>> {
    let (eta_i, eta_t) = match rules.get().bend {
        Bend::Snell => (eta_i, eta_t),
        Bend::Inverted => (eta_t, eta_i),
        Bend::Straight => return Some(d),
    };
    let cos_i = -d.dot(n);
    let eta = eta_i / eta_t;
    // cos²θ_t, times the square of `scale`
    let (square, scale) = match rules.get().style.snell {
        Snell::Factored => ((eta_t - eta_i) * (eta_t + eta_i) + (eta_i * cos_i) * (eta_i * cos_i), eta_t),
        Snell::Textbook => (T::ONE - eta * eta * (T::ONE - cos_i * cos_i), T::ONE),
    };
    let leave = |root: T| d * eta + n * (eta * cos_i - root / scale);
    if square >= T::ZERO {
        return Some(leave(square.sqrt()));
    }
    match rules.get().total_reflection {
        TotalReflection::ReflectOnly | TotalReflection::Black => None,
        TotalReflection::Straight => Some(d),
        TotalReflection::Grazing => Some(leave(T::ZERO).normalised()),
    }
}

/// R where normals are interpolated: about `n_shading`, or about `n_geom` where that would enter the object. [rule 19]
#[inline(always)]
pub fn smooth_reflect<T: Real, R: RuleSource>(rules: R, d: Vec3<T>, n_geom: Vec3<T>, n_shading: Vec3<T>) -> Vec3<T> {
    match rules.get().reflect_by {
        ReflectBy::Geometric => reflect(rules, d, n_geom),
        ReflectBy::Interpolated => reflect(rules, d, n_shading),
        ReflectBy::WithFallback => {
            let r = reflect(rules, d, n_shading);
            if r.dot(n_geom) > T::ZERO { r } else { reflect(rules, d, n_geom) }
        }
    }
}

/// T where normals are interpolated: by `n_shading`, whose total internal reflection is final; by `n_geom` where T would not
/// cross the surface, or where `n_shading` faces away from the ray. [rule 19]
#[inline(always)]
pub fn smooth_refract<T: Real, R: RuleSource>(
    rules: R,
    d: Vec3<T>,
    n_geom: Vec3<T>,
    n_shading: Vec3<T>,
    (eta_i, eta_t): (T, T),
) -> Option<Vec3<T>> {
    let by = |n| refract(rules, d, n, eta_i, eta_t);
    match rules.get().refract_by {
        RefractBy::Geometric => by(n_geom),
        RefractBy::Interpolated => by(n_shading),
        RefractBy::WithFallback if d.dot(n_shading) >= T::ZERO => by(n_geom),
        RefractBy::WithFallback => {
            let t = by(n_shading)?;
            if t.dot(n_geom) < T::ZERO { Some(t) } else { by(n_geom) }
        }
    }
}
