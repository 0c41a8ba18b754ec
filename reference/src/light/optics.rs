//! Directions of reflected and transmitted rays. [rule 7] [rule 8] [rule 9] [rule 10] [rule 19]
//!
//! d is the ray's direction, a unit vector. Normals are turned against it.

use crate::light::snell::transmitted;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{
    Bend, Index, Leaving, Mirror, ReflectBy, RefractBy, Robustness, RuleSource, Snell,
    TotalReflection,
};

/// Returns the reflected direction R = d − 2 (d·N) N. [rule 7]
///
/// In the reference's own style the product is divided by N·N. R then has the length of d for an N
/// of any length.
///
/// ```
/// use reference::{light::optics::reflect, numbers::vec3::Vec3, rules::Lecture};
///
/// // The component along N = (0, 1, 0) changes its sign.
/// let r = reflect(Lecture, Vec3::new(0.6, -0.8, 0.0), Vec3::new(0.0, 1.0, 0.0));
/// assert_eq!(r, Vec3::new(0.6, 0.8, 0.0));
/// ```
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
        Mirror::Plus => d + along * T::TWO,
    }
}

/// Returns (η_i, η_t) at the surface between air and a material with this index of refraction.
/// [rule 9]
#[inline(always)]
pub fn indices<T: Real, R: RuleSource>(rules: R, is_inside: bool, index: T) -> (T, T) {
    let air = T::of(rules.get().air);
    let index = if rules.get().index == Index::Glass { T::of(1.5) } else { index };
    match rules.get().leaving {
        Leaving::Swapped if is_inside => (index, air),
        _ => (air, index),
    }
}

/// Returns the transmitted direction T by Snell's law, or `None` for total internal reflection.
/// Exactly at the critical angle T runs along the surface. [rule 8] [rule 10]
///
/// cos²θ_t is a sum of two terms that do not cancel where η_i and η_t are nearly equal. The
/// reference's own style uses [`transmitted`].
///
/// ```
/// use reference::{light::optics::refract, numbers::vec3::Vec3, rules::Lecture};
///
/// // sin θ_t = (3/4) sin θ_i = (3/4) (4/5) = 3/5
/// let (d, n) = (Vec3::new(0.8, -0.6, 0.0), Vec3::new(0.0, 1.0, 0.0));
/// let t = refract(Lecture, d, n, 3.0, 4.0).expect("the ray enters a denser medium");
/// assert!((t - Vec3::new(0.6, -0.8, 0.0)).length() < 1e-15);
/// assert_eq!(refract(Lecture, d, n, 5.0, 3.0), None); // sin θ_t would be 4/3
/// ```
#[inline(always)]
pub fn refract<T: Real, R: RuleSource>(
    rules: R,
    d: Vec3<T>,
    n: Vec3<T>,
    eta_i: T,
    eta_t: T,
) -> Option<Vec3<T>> {
    let (eta_i, eta_t) = match rules.get().bend {
        Bend::Snell | Bend::CosineReversed | Bend::RatioNotSquared | Bend::PlusRoot => {
            (eta_i, eta_t)
        }
        Bend::Inverted => (eta_t, eta_i),
        Bend::Straight => return Some(d),
    };
    let (style, bend) = (&rules.get().style, rules.get().bend);
    let is_law = matches!(bend, Bend::Snell | Bend::Inverted);
    if is_law && style.robustness == Robustness::Certified && style.snell == Snell::Factored {
        let t = transmitted(d, n, eta_i, eta_t);
        if t.is_some() || rules.get().total_reflection == TotalReflection::ReflectOnly {
            return t;
        }
    }
    let cos_i = -d.dot(n);
    let eta = eta_i / eta_t;
    // cos²θ_t, times the square of `scale`
    let (square, scale) = match style.snell {
        _ if bend == Bend::RatioNotSquared => (T::ONE - eta * (T::ONE - cos_i * cos_i), T::ONE),
        Snell::Factored => {
            ((eta_t - eta_i) * (eta_t + eta_i) + (eta_i * cos_i) * (eta_i * cos_i), eta_t)
        }
        Snell::Textbook => (T::ONE - eta * eta * (T::ONE - cos_i * cos_i), T::ONE),
    };
    let leave = |root: T| match bend {
        Bend::CosineReversed => d * eta - n * (eta * cos_i + root / scale),
        Bend::PlusRoot => d * eta + n * (eta * cos_i + root / scale),
        _ => d * eta + n * (eta * cos_i - root / scale),
    };
    if square >= T::ZERO {
        return Some(leave(square.sqrt()));
    }
    match rules.get().total_reflection {
        TotalReflection::ReflectOnly
        | TotalReflection::Black
        | TotalReflection::MirroredByKt
        | TotalReflection::Background => None,
        TotalReflection::Straight => Some(d),
        TotalReflection::Grazing => Some(leave(T::ZERO).normalised()),
    }
}

/// Returns the largest part of v·n that rounding may have caused. With u half an ulp, it is 3u of
/// the absolute values of the terms, and as much again for v itself.
#[inline(always)]
fn doubt<T: Real>(v: Vec3<T>, n: Vec3<T>) -> T {
    v.abs().dot(n.abs()) * (T::of(4.0) * T::ULP)
}

/// Returns whether v points to the side of a surface to which `n` points. In the reference's own
/// style a true result is certain. [rule 19]
#[inline(always)]
fn goes_to<T: Real, R: RuleSource>(rules: R, v: Vec3<T>, n: Vec3<T>) -> bool {
    let certified = rules.get().style.robustness == Robustness::Certified;
    v.dot(n) > if certified { doubt(v, n) } else { T::ZERO }
}

/// Returns the unit vector v. Where v runs along the surface within rounding, it is turned by a few
/// roundings, so that it certainly points to the side to which `n` points.
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

/// Returns R at a point with an interpolated normal: about `n_shading`, or about `n_geom` where R
/// would otherwise enter the object. [rule 19]
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

/// Returns T at a point with an interpolated normal, or `None` for total internal reflection.
/// [rule 19]
///
/// T is computed by `n_shading`, and `None` is then final. It is computed by `n_geom` where T would
/// not cross the surface, or where `n_shading` faces away from the ray.
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
