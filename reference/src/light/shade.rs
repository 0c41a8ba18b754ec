//! Light at a point. These formulas cast no ray. [rule 3] [rule 11] [rule 12]

use crate::light::lights::Light;
use crate::light::material::Material;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{
    Ambient, Diffuse, Emission, Facing, Highlight, HighlightColour, InsideAmbient, InsideBy, Power,
    RuleSource, Turning, Viewer,
};
use crate::watch::work::{Tally, Work};

/// Returns the outward normal turned against the ray, and whether the ray is inside the object.
/// [rule 11]
///
/// A ray along the surface (d·N = 0) is outside.
#[inline(always)]
pub fn facing_normal<T: Real, R: RuleSource>(
    rules: R,
    d: Vec3<T>,
    normal: Vec3<T>,
) -> (Vec3<T>, bool) {
    let is_inside = is_inside(rules, d, normal);
    (if turns(rules, is_inside) { -normal } else { normal }, is_inside)
}

/// Returns whether the ray is inside the object with the outward normal `outwards`. [rule 11]
#[inline(always)]
pub fn is_inside<T: Real, R: RuleSource>(rules: R, d: Vec3<T>, outwards: Vec3<T>) -> bool {
    let along = d.dot(outwards);
    match rules.get().inside_by {
        InsideBy::Geometric | InsideBy::Interpolated => along > T::ZERO,
        InsideBy::Never => false,
        InsideBy::Reversed => along < T::ZERO,
    }
}

/// Returns whether normals are negated: they are inside an object. [rule 11]
#[inline(always)]
pub fn turns<R: RuleSource>(rules: R, is_inside: bool) -> bool {
    is_inside && rules.get().turning != Turning::Nowhere
}

/// Returns ke, or its multiple where a mistake adds it once for each of `n_lights` lights. [rule 3]
#[inline(always)]
pub fn emission<T: Real, R: RuleSource>(
    rules: R,
    material: &Material<T>,
    n_lights: usize,
) -> Vec3<T> {
    match rules.get().emission {
        Emission::Once => material.ke,
        Emission::PerLight => material.ke * T::of(n_lights as f64),
        Emission::Absent => Vec3::ZERO,
    }
}

/// Returns ka Ia_j for the light with index `j`, multiplied by kt inside an object. Shadows and
/// attenuation do not change it. [rule 3] [rule 12]
#[inline(always)]
pub fn ambient<T: Real, R: RuleSource>(
    rules: R,
    material: &Material<T>,
    light: &Light<T>,
    j: usize,
    is_inside: bool,
) -> Vec3<T> {
    let outside = match rules.get().ambient {
        Ambient::PerLight | Ambient::Shadowed | Ambient::Weakened | Ambient::InShadow => {
            material.ka * light.ambient
        }
        Ambient::FirstLight if j == 0 => material.ka * light.ambient,
        Ambient::FirstLight | Ambient::Absent => Vec3::ZERO,
        Ambient::LightColour => material.ka * light.colour,
        Ambient::Kd => material.kd * light.ambient,
        Ambient::WithoutKa => light.ambient,
        Ambient::KaTwice => material.ka * material.ka * light.ambient,
    };
    match rules.get().ambient_inside {
        InsideAmbient::TimesKt if is_inside => outside * material.kt,
        InsideAmbient::Absent if is_inside => Vec3::ZERO,
        InsideAmbient::OneMinusKt if is_inside => outside * (Vec3::ONE - material.kt),
        _ => outside,
    }
}

/// Returns B_j: whether a light in the direction `to_light` adds anything to a surface of this
/// material and normal. [rule 3]
#[inline(always)]
pub fn is_lit<T: Real, R: RuleSource>(
    rules: R,
    material: &Material<T>,
    normal: Vec3<T>,
    to_light: Vec3<T>,
) -> bool {
    let is_before = normal.dot(to_light) > T::ZERO;
    match rules.get().facing {
        Facing::OnlyFront => is_before,
        Facing::BothSidesOfTransmissive => is_before || material.kt.max_element() > T::ZERO,
        Facing::SpecularFromBehind | Facing::Unclamped | Facing::BothSides => true,
    }
}

/// Returns whether kd (N·L) + ks (N·H)₊^ns is finite, so that its product with 0 is 0.
///
/// The result is false for other highlights than the lecture's, whose value may be infinite or NaN
/// even when multiplied by 0, and where light counts that does not arrive.
#[inline(always)]
pub fn is_bounded<R: RuleSource>(rules: R) -> bool {
    let rules = rules.get();
    rules.highlight == Highlight::Blinn
        && rules.highlight_colour == HighlightColour::Ks
        && rules.coloured_lights
}

/// Returns S_j A_j I_j B_j [kd (N·L_j) + ks (N·H_j)₊^ns]. [rule 3]
///
/// `arriving` is S_j A_j I_j. All directions are unit vectors. Where L = −V there is no half
/// vector, and no highlight.
///
/// ```
/// use reference::light::{material::Material, shade::light_term};
/// use reference::{numbers::vec3::Vec3, rules::Lecture};
///
/// let (zero, up) = (Vec3::<f64>::ZERO, Vec3::new(0.0, 1.0, 0.0));
/// let (kd, ks) = (Vec3::ONE * 0.5, Vec3::ONE * 0.25);
/// let material = Material { ke: zero, ka: zero, kd, ks, kt: zero, kr: zero, ns: 8.0, index: 1.0 };
/// // N = V = L, so that N·L = N·H = 1 and the term is kd + ks.
/// let light = light_term(Lecture, &material, Vec3::ONE, up, up, up, &mut ());
/// assert_eq!(light, Vec3::ONE * 0.75);
/// ```
#[inline(always)]
pub fn light_term<T: Real, R: RuleSource>(
    rules: R,
    material: &Material<T>,
    arriving: Vec3<T>,
    normal: Vec3<T>,
    to_viewer: Vec3<T>,
    to_light: Vec3<T>,
    tally: &mut impl Tally,
) -> Vec3<T> {
    if !is_lit(rules, material, normal, to_light) {
        return Vec3::ZERO;
    }
    let cosine = normal.dot(to_light);
    let cosine = match rules.get().facing {
        Facing::OnlyFront | Facing::Unclamped => cosine,
        Facing::SpecularFromBehind => cosine.greatest(T::ZERO),
        Facing::BothSides | Facing::BothSidesOfTransmissive => cosine.abs(),
    };
    let spread = match rules.get().diffuse {
        Diffuse::Cosine => cosine,
        Diffuse::Flat => T::ONE,
        Diffuse::Absent => T::ZERO,
        Diffuse::Squared => cosine * cosine,
        Diffuse::Wrapped => (cosine + T::ONE) * T::HALF,
        Diffuse::OverPi => cosine * T::of(std::f64::consts::FRAC_1_PI),
    };
    let to_viewer = if rules.get().viewer == Viewer::Reversed { -to_viewer } else { to_viewer };
    let shine = if is_bounded(rules) && material.ks == Vec3::ZERO {
        T::ZERO
    } else {
        highlight(rules, material.ns, normal, to_viewer, to_light, tally)
    };
    match rules.get().highlight_colour {
        HighlightColour::Ks => arriving * (material.kd * spread + material.ks * shine),
        HighlightColour::Kd => arriving * (material.kd * spread + material.kd * shine),
        HighlightColour::Unlit => arriving * (material.kd * spread) + material.ks * shine,
    }
}

/// Returns (N·H)₊^ns. [rule 3]
#[inline(always)]
fn highlight<T: Real, R: RuleSource>(
    rules: R,
    ns: T,
    n: Vec3<T>,
    v: Vec3<T>,
    l: Vec3<T>,
    tally: &mut impl Tally,
) -> T {
    let sum = l + v;
    if sum == Vec3::ZERO {
        return T::ZERO;
    }
    let cosine = n.dot(sum.normalised());
    let ns = match rules.get().highlight {
        Highlight::FourTimesExponent => ns * T::of(4.0),
        Highlight::Times128 => ns * T::of(128.0),
        _ => ns,
    };
    let mut power = |x: T| power(rules, x, ns, tally);
    match rules.get().highlight {
        Highlight::Blinn | Highlight::FourTimesExponent | Highlight::Times128 => {
            power(cosine.greatest(T::ZERO))
        }
        Highlight::Phong => power((n * (T::TWO * n.dot(l)) - l).dot(v).greatest(T::ZERO)),
        Highlight::Unclamped => power(cosine),
        Highlight::HalfNotUnit => power(n.dot(sum).greatest(T::ZERO)),
        Highlight::HalfHalved => power((n.dot(sum) * T::HALF).greatest(T::ZERO)),
        Highlight::Absolute => power(cosine.abs()),
        Highlight::NoExponent => cosine.greatest(T::ZERO),
        Highlight::TimesCosine => n.dot(l) * power(cosine.greatest(T::ZERO)),
        Highlight::Absent => T::ZERO,
    }
}

/// Returns x^ns. [rule 3]
///
/// For x = 0 and ns ≥ 0 no function is called: the result is 0, or 1 for 0^0. The logarithm is used
/// for x > 0 only.
#[inline(always)]
fn power<T: Real, R: RuleSource>(rules: R, x: T, ns: T, tally: &mut impl Tally) -> T {
    if x == T::ZERO && ns >= T::ZERO {
        return if ns == T::ZERO { T::ONE } else { T::ZERO };
    }
    tally.did(Work::Power);
    match rules.get().style.power {
        Power::ExpLog if x > T::ZERO => (ns * x.ln()).exp(),
        Power::ExpLog | Power::Pow => x.pow(ns),
    }
}
