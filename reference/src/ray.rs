//! Rays, and the one place that says where a ray's interval begins and ends.

use crate::real::Real;
use crate::rules::{RuleSource, Start, ToLight};
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

impl<T: Real> Ray<T> {
    /// The whole ray, over 0 < t < ∞, whatever the rules say of its beginning.
    #[inline(always)]
    pub fn all_of(origin: Vec3<T>, direction: Vec3<T>) -> Self {
        Self { origin, direction, t_min: T::ZERO, t_max: T::INFINITY }
    }

    /// The ray that leaves `origin`, which lies on no surface: over RAY_EPSILON < t < ∞, or over 0 < t < ∞ where the style moves
    /// origins off surfaces. [rule 2] [rule 21]
    #[inline(always)]
    pub fn leaving<R: RuleSource>(rules: R, origin: Vec3<T>, direction: Vec3<T>) -> Self {
        let t_min = if start::<T, R>(rules) == Start::Interval { rules.epsilon() } else { T::ZERO };
        Self { origin, direction, t_min, t_max: T::INFINITY }
    }

    /// The ray that leaves a point of a surface with that geometric normal, whichever way it points. [rule 2] [rule 21]
    #[inline(always)]
    pub fn spawned<R: RuleSource>(rules: R, point: Vec3<T>, n_geom: Vec3<T>, direction: Vec3<T>) -> Self {
        let origin = match start::<T, R>(rules) {
            Start::Interval => point,
            Start::AlongNormal if direction.dot(n_geom) < T::ZERO => point - n_geom * rules.epsilon::<T>(),
            Start::AlongNormal => point + n_geom * rules.epsilon::<T>(),
            Start::AlongRay => point + direction * rules.epsilon::<T>(),
        };
        Self::leaving(rules, origin, direction)
    }

    /// The ray that leaves a point of a surface and ends before a light in direction `to_light` at distance `r`. [rule 5] [rule 21]
    #[inline(always)]
    pub fn to_light<R: RuleSource>(rules: R, point: Vec3<T>, n_geom: Vec3<T>, to_light: Vec3<T>, r: T) -> Self {
        let ray = Self { t_max: r, ..Self::spawned(rules, point, n_geom, to_light) };
        if rules.get().style.to_light == ToLight::FromPoint || !r.is_finite() {
            return ray;
        }
        let way = point + to_light * r - ray.origin;
        Self { direction: way.normalised(), t_max: way.length(), ..ray }
    }

    /// The rest of this ray behind its crossing of an object at `t`. A crossing of that object nearer than RAY_EPSILON behind is
    /// the same one: a ray through an edge that two triangles share crosses one surface. [rule 6]
    #[inline(always)]
    pub fn beyond<R: RuleSource>(&self, rules: R, t: T) -> Self {
        Self { t_min: t + rules.epsilon::<T>().greatest(t.abs() * T::ULP), ..*self }
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
        ts.into_iter().find(|t| self.contains(*t))
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

/// How rays get away from surfaces. A negative epsilon, the mistake of counting what lies behind, moves no origin in any style.
#[inline(always)]
fn start<T: Real, R: RuleSource>(rules: R) -> Start {
    if rules.epsilon::<T>() < T::ZERO { Start::Interval } else { rules.get().style.start }
}
