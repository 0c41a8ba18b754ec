//! Rays, and the one place that says where a ray's interval begins and ends.

use crate::real::Real;
use crate::rules::{Epsilon, RuleSource, Start, ToLight};
use crate::vec3::Vec3;

/// r(t) = origin + t · direction, for t_min < t < t_max. [rule 2]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<T> {
    /// Where t = 0.
    pub origin: Vec3<T>,
    /// Of unit length in world space, of any length but zero in object space. [rule 20]
    pub direction: Vec3<T>,
    /// Open lower end of the interval.
    pub t_min: T,
    /// Open upper end of the interval.
    pub t_max: T,
}

/// A point of a surface, as well as it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot<T> {
    /// The point.
    pub point: Vec3<T>,
    /// How far along each axis the surface may lie from it, at most; what a ray from here loses to
    /// rounding on its way back into object space is counted in.
    pub error: Vec3<T>,
    /// Unit normal of the surface itself, whichever way it points.
    pub n_geom: Vec3<T>,
}

impl<T: Real> Spot<T> {
    /// A point of `ray` itself: off the surface by what t and the sum O + t d lose, if t is right
    /// to a few of its last places.
    #[inline(always)]
    pub fn along(ray: &Ray<T>, t: T, n_geom: Vec3<T>) -> Self {
        let error = (ray.origin.abs() + (ray.direction * t).abs()) * (T::of(16.0) * T::ULP);
        Self { point: ray.at(t), error, n_geom }
    }

    /// The point moved off the surface, to the side to which `direction` points.
    ///
    /// With S on the surface and |Q − S| ≤ e, the point Q + δ N lies beyond the tangent plane at S
    /// if δ > Σ |N_i| e_i. Rounding Q + δ N loses half a last place of Q a component; a whole one
    /// is added to e. A component that is 0 is exact, and so stays one that may be left on the
    /// surface.
    #[inline(always)]
    fn moved_off(&self, direction: Vec3<T>) -> Vec3<T> {
        let away = if direction.dot(self.n_geom) < T::ZERO { -self.n_geom } else { self.n_geom };
        let reach =
            away.abs().dot(self.error + self.point.abs() * T::ULP) * (T::ONE + T::of(8.0) * T::ULP);
        self.point + away * reach
    }
}

impl<T: Real> Ray<T> {
    /// The whole ray, over 0 < t < ∞, whatever the rules say of its beginning.
    #[inline(always)]
    pub fn all_of(origin: Vec3<T>, direction: Vec3<T>) -> Self {
        Self { origin, direction, t_min: T::ZERO, t_max: T::INFINITY }
    }

    /// The ray that leaves `origin`, which lies on no surface: over RAY_EPSILON < t < ∞, or over 0
    /// < t < ∞ where the style moves origins off surfaces. [rule 2] [rule 21]
    #[inline(always)]
    pub fn leaving<R: RuleSource>(rules: R, origin: Vec3<T>, direction: Vec3<T>) -> Self {
        let t_min = if start(rules) == Start::Interval { rules.epsilon() } else { T::ZERO };
        Self { origin, direction, t_min, t_max: T::INFINITY }
    }

    /// The ray that leaves a surface. [rule 2] [rule 21]
    #[inline(always)]
    pub fn spawned<R: RuleSource>(rules: R, spot: &Spot<T>, direction: Vec3<T>) -> Self {
        let Spot { point, n_geom, .. } = *spot;
        let origin = match start(rules) {
            Start::OffBound => spot.moved_off(direction),
            Start::Interval => point,
            Start::AlongNormal if direction.dot(n_geom) < T::ZERO => {
                point - n_geom * rules.epsilon::<T>()
            }
            Start::AlongNormal => point + n_geom * rules.epsilon::<T>(),
            Start::AlongRay => point + direction * rules.epsilon::<T>(),
        };
        Self::leaving(rules, origin, direction)
    }

    /// The ray that leaves a surface and ends before a light in direction `to_light` at distance
    /// `r`. [rule 5] [rule 21]
    #[inline(always)]
    pub fn to_light<R: RuleSource>(rules: R, spot: &Spot<T>, to_light: Vec3<T>, r: T) -> Self {
        let ray = Self { t_max: r, ..Self::spawned(rules, spot, to_light) };
        if !r.is_finite() {
            return ray;
        }
        if start(rules) == Start::OffBound {
            return ray.ending_before(ray.origin - spot.point, to_light, r);
        }
        if rules.get().style.to_light == ToLight::FromPoint {
            return ray;
        }
        let way = spot.point + to_light * r - ray.origin;
        Self { direction: way.normalised(), t_max: way.length(), ..ray }
    }

    /// This ray turned to the light that its point sees in direction `to_light` at distance `r`,
    /// and so short that the light itself is beyond its end whatever rounding does: what a light
    /// touches does not hide it. A light nearer than the bound by which the origin was moved by
    /// `step` is hidden by nothing.
    ///
    /// r − L·step is the length of the way that is left, but for a share of (|step|/r)², by which
    /// the direction may fail to be of unit length.
    #[inline(always)]
    fn ending_before(self, step: Vec3<T>, to_light: Vec3<T>, r: T) -> Self {
        let left = r - to_light.dot(step);
        let direction = (to_light * r - step) * (T::ONE / left);
        // the coordinates of both ends, along the ray
        let reach = left + self.origin.abs().dot(to_light.abs());
        let t_max = left - reach * (T::of(32.0) * T::ULP);
        Self { direction, t_max: if left > T::ZERO { t_max } else { T::ZERO }, ..self }
    }

    /// The rest of this ray behind its crossing of an object at `t`. A crossing of that object
    /// nearer behind than RAY_EPSILON, or than rounding may part two of one place, is the same one:
    /// a ray through an edge that two triangles share crosses one surface. [rule 6]
    #[inline(always)]
    pub fn beyond<R: RuleSource>(&self, rules: R, t: T) -> Self {
        let step = match start(rules) {
            Start::OffBound => {
                (t.abs() + self.origin.abs().dot(self.direction.abs())) * (T::of(16.0) * T::ULP)
            }
            _ => rules.epsilon::<T>().greatest(t.abs() * T::ULP),
        };
        Self { t_min: t + step, ..*self }
    }

    /// Another ray over the interval of this one.
    #[inline(always)]
    pub fn along(&self, other: &Self) -> Self {
        Self { t_min: self.t_min, t_max: self.t_max, ..*other }
    }

    /// Has `found` told of every crossing: `first` gives the first in the interval of a ray like
    /// this one.
    #[inline(always)]
    pub fn cross<R: RuleSource>(
        &self,
        rules: R,
        first: impl Fn(&Self) -> Option<T>,
        mut found: impl FnMut(T),
    ) {
        let mut rest = *self;
        while let Some(t) = first(&rest) {
            found(t);
            rest = rest.beyond(rules, t);
        }
    }

    /// The point at parameter `t`.
    #[inline(always)]
    pub fn at(&self, t: T) -> Vec3<T> {
        self.origin + self.direction * t
    }

    /// Whether a hit at `t` counts: strictly inside the interval; never for NaN. [rule 2]
    #[inline(always)]
    pub fn contains(&self, t: T) -> bool {
        self.t_min < t && t < self.t_max
    }

    /// Whether neither a hit at `t` counts nor any at a lesser parameter. [rule 2]
    #[inline(always)]
    pub fn is_before(&self, t: T) -> bool {
        t <= self.t_min
    }

    /// The first of `ts` that counts; they come in ascending order.
    #[inline(always)]
    pub fn first(&self, ts: [T; 2]) -> Option<T> {
        let [first, second] = ts;
        if self.contains(first) {
            return Some(first);
        }
        self.contains(second).then_some(second)
    }

    /// This ray in the precision `T`.
    pub fn of(ray: &cases::Ray) -> Self {
        Self {
            origin: Vec3::of(ray.origin),
            direction: Vec3::of(ray.direction),
            t_min: T::of(ray.t_min),
            t_max: T::of(ray.t_max),
        }
    }
}

/// How rays get away from surfaces. A negative epsilon, the mistake of counting what lies behind,
/// moves no origin in any style; where none is needed a mistaken one still counts.
#[inline(always)]
fn start<R: RuleSource>(rules: R) -> Start {
    let epsilon = match rules.get().epsilon {
        Epsilon::RayEpsilon => return rules.get().style.start,
        Epsilon::Fixed(t) | Epsilon::Mistaken(t) => t,
    };
    let is_mistaken = matches!(rules.get().epsilon, Epsilon::Mistaken(_));
    match rules.get().style.start {
        Start::OffBound if is_mistaken => Start::Interval,
        _ if epsilon < 0.0 => Start::Interval,
        style => style,
    }
}
