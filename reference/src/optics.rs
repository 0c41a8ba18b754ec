//! Mirrored and transmitted directions. [rule 7] [rule 8] [rule 9] [rule 10] [rule 19]
//!
//! d is the ray's direction, a unit vector; normals are turned against it.

use crate::real::Real;
use crate::rules::{
    Bend, Leaving, Mirror, ReflectBy, RefractBy, Robustness, RuleSource, Snell, TotalReflection,
};
use crate::snell::transmitted;
use crate::vec3::Vec3;

/// R = d − 2 (d·N) N; as the reference does it, divided by N·N, which keeps the length of d
/// whatever that of N. [rule 7]
#[inline(always)]
pub fn reflect<T: Real, R: RuleSource>(rules: R, d: Vec3<T>, n: Vec3<T>) -> Vec3<T> {
    let along = match rules.get().style.robustness {
        Robustness::Certified if n.dot(n).is_safe() => n * (d.dot(n) / n.dot(n)),
        Robustness::Certified => n.normalised() * d.dot(n.normalised()),
        Robustness::Plain => n * d.dot(n),
    };
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

/// T by Snell's law, or `None` for total internal reflection; exactly at the critical angle the ray
/// goes along the surface. [rule 8] [rule 10]
///
/// cos²θ_t is written as a sum of two terms that do not cancel where η_i and η_t are nearly equal.
/// The reference's own way is [`transmitted`].
#[inline(always)]
pub fn refract<T: Real, R: RuleSource>(
    rules: R,
    d: Vec3<T>,
    n: Vec3<T>,
    eta_i: T,
    eta_t: T,
) -> Option<Vec3<T>> {
    let (eta_i, eta_t) = match rules.get().bend {
        Bend::Snell => (eta_i, eta_t),
        Bend::Inverted => (eta_t, eta_i),
        Bend::Straight => return Some(d),
    };
    let style = &rules.get().style;
    if style.robustness == Robustness::Certified && style.snell == Snell::Factored {
        let t = transmitted(d, n, eta_i, eta_t);
        if t.is_some() || rules.get().total_reflection == TotalReflection::ReflectOnly {
            return t;
        }
    }
    let cos_i = -d.dot(n);
    let eta = eta_i / eta_t;
    // cos²θ_t, times the square of `scale`
    let (square, scale) = match style.snell {
        Snell::Factored => {
            ((eta_t - eta_i) * (eta_t + eta_i) + (eta_i * cos_i) * (eta_i * cos_i), eta_t)
        }
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

/// How much of v·n rounding may have made: 3u of the amounts of its terms, u half a ulp, and as
/// much again for v itself.
#[inline(always)]
fn doubt<T: Real>(v: Vec3<T>, n: Vec3<T>) -> T {
    v.abs().dot(n.abs()) * (T::of(4.0) * T::ULP)
}

/// Whether v goes to the side of a surface to which `n` points, for certain in the reference's own
/// way. [rule 19]
#[inline(always)]
fn goes_to<T: Real, R: RuleSource>(rules: R, v: Vec3<T>, n: Vec3<T>) -> bool {
    let certified = rules.get().style.robustness == Robustness::Certified;
    v.dot(n) > if certified { doubt(v, n) } else { T::ZERO }
}

/// The unit vector v; where it runs along the surface but for roundings, turned by as many, so that
/// it goes to the side to which `n` points for certain.
#[inline(always)]
fn kept_on<T: Real, R: RuleSource>(rules: R, v: Vec3<T>, n: Vec3<T>) -> Vec3<T> {
    let (along, roundings) = (v.dot(n), T::of(16.0) * T::ULP);
    if rules.get().style.robustness == Robustness::Plain
        || along.abs() > roundings
        || goes_to(rules, v, n)
    {
        return v;
    }
    v + n * (roundings - along)
}

/// R where normals are interpolated: about `n_shading`, or about `n_geom` where that would enter
/// the object. [rule 19]
#[inline(always)]
pub fn smooth_reflect<T: Real, R: RuleSource>(
    rules: R,
    d: Vec3<T>,
    n_geom: Vec3<T>,
    n_shading: Vec3<T>,
) -> Vec3<T> {
    match rules.get().reflect_by {
        ReflectBy::Geometric => reflect(rules, d, n_geom),
        ReflectBy::Interpolated => reflect(rules, d, n_shading),
        ReflectBy::WithFallback => {
            let r = reflect(rules, d, n_shading);
            if goes_to(rules, r, n_geom) {
                r
            } else {
                kept_on(rules, reflect(rules, d, n_geom), n_geom)
            }
        }
    }
}

/// T where normals are interpolated: by `n_shading`, whose total internal reflection is final; by
/// `n_geom` where T would not cross the surface, or where `n_shading` faces away from the ray.
/// [rule 19]
#[inline(always)]
pub fn smooth_refract<T: Real, R: RuleSource>(
    rules: R,
    d: Vec3<T>,
    n_geom: Vec3<T>,
    n_shading: Vec3<T>,
    (eta_i, eta_t): (T, T),
) -> Option<Vec3<T>> {
    let by = |n| refract(rules, d, n, eta_i, eta_t);
    let across = || by(n_geom).map(|t| kept_on(rules, t, -n_geom));
    match rules.get().refract_by {
        RefractBy::Geometric => by(n_geom),
        RefractBy::Interpolated => by(n_shading),
        RefractBy::WithFallback if d.dot(n_shading) >= T::ZERO => across(),
        RefractBy::WithFallback => {
            let t = by(n_shading)?;
            if goes_to(rules, t, -n_geom) { Some(t) } else { across() }
        }
    }
}
