//! Rays. Only this module says where a ray's interval begins and ends.

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rules::{Epsilon, RuleSource, Start, ToLight};

/// A ray r(t) = origin + t · direction, for t_min < t < t_max. [rule 2]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<T> {
    /// The point at t = 0.
    pub origin: Vec3<T>,
    /// The direction: of unit length in world space, of any length but zero in object space.
    /// [rule 20]
    pub direction: Vec3<T>,
    /// The open lower end of the interval.
    pub t_min: T,
    /// The open upper end of the interval; may be infinite.
    pub t_max: T,
}

/// A point of a surface, with a bound of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitPoint<T> {
    /// The point.
    pub point: Vec3<T>,
    /// The greatest distance along each axis between the point and the surface. The bound includes
    /// what a ray from here loses to rounding when it is transformed back into object space.
    pub error: Vec3<T>,
    /// The unit normal of the surface itself, pointing to either side.
    pub n_geom: Vec3<T>,
}

impl<T: Real> HitPoint<T> {
    /// Returns the point of `ray` at `t`.
    ///
    /// The point is off the surface by the errors of t and of the sum O + t d. The bound holds if t
    /// is right to a few units in its last place.
    #[inline(always)]
    pub fn along(ray: &Ray<T>, t: T, n_geom: Vec3<T>) -> Self {
        let error = (ray.origin.abs() + (ray.direction * t).abs()) * (T::of(16.0) * T::ULP);
        Self { point: ray.at(t), error, n_geom }
    }

    /// Returns the point moved off the surface, to the side to which `direction` points.
    ///
    /// With S on the surface and |Q − S| ≤ e, the point Q + δ N lies beyond the tangent plane at S
    /// if δ > Σ |N_i| e_i. Rounding Q + δ N loses half a unit in the last place of Q per component;
    /// a whole one is added to e. A component that is 0 is exact and adds nothing, so the point may
    /// stay on the surface in that component.
    #[inline(always)]
    fn moved_off(&self, direction: Vec3<T>) -> Vec3<T> {
        let away = if direction.dot(self.n_geom) < T::ZERO { -self.n_geom } else { self.n_geom };
        let reach =
            away.abs().dot(self.error + self.point.abs() * T::ULP) * (T::ONE + T::of(8.0) * T::ULP);
        self.point + away * reach
    }
}

impl<T: Real> Ray<T> {
    /// Returns the ray over 0 < t < ∞, whatever the rules say about where rays begin.
    #[inline(always)]
    pub fn all_of(origin: Vec3<T>, direction: Vec3<T>) -> Self {
        Self { origin, direction, t_min: T::ZERO, t_max: T::INFINITY }
    }

    /// Returns the ray that leaves `origin`, which lies on no surface. [rule 2] [rule 21]
    ///
    /// The interval is RAY_EPSILON < t < ∞, or 0 < t < ∞ where the style moves origins off
    /// surfaces.
    #[inline(always)]
    pub fn leaving<R: RuleSource>(rules: R, origin: Vec3<T>, direction: Vec3<T>) -> Self {
        let t_min = if start(rules) == Start::Interval { rules.epsilon() } else { T::ZERO };
        Self { origin, direction, t_min, t_max: T::INFINITY }
    }

    /// Returns the ray that leaves a surface at `hit_point`. The style decides how it leaves: see
    /// [`Start`]. [rule 2] [rule 21]
    #[inline(always)]
    pub fn spawned<R: RuleSource>(rules: R, hit_point: &HitPoint<T>, direction: Vec3<T>) -> Self {
        let HitPoint { point, n_geom, .. } = *hit_point;
        let origin = match start(rules) {
            Start::OffBound => hit_point.moved_off(direction),
            Start::Interval => point,
            Start::AlongNormal if direction.dot(n_geom) < T::ZERO => {
                point - n_geom * rules.epsilon::<T>()
            }
            Start::AlongNormal => point + n_geom * rules.epsilon::<T>(),
            Start::AlongRay => point + direction * rules.epsilon::<T>(),
        };
        Self::leaving(rules, origin, direction)
    }

    /// Returns the shadow ray from `hit_point` to a light in direction `to_light`, a unit vector,
    /// at distance `r`. [rule 5] [rule 21]
    ///
    /// The ray leaves the surface as in [`Ray::spawned`] and ends before the light. An infinite `r`
    /// gives a ray without an end.
    #[inline(always)]
    pub fn to_light<R: RuleSource>(
        rules: R,
        hit_point: &HitPoint<T>,
        to_light: Vec3<T>,
        r: T,
    ) -> Self {
        let ray = Self { t_max: r, ..Self::spawned(rules, hit_point, to_light) };
        if !r.is_finite() {
            return ray;
        }
        if start(rules) == Start::OffBound {
            return ray.ending_before(ray.origin - hit_point.point, to_light, r);
        }
        if rules.get().style.to_light == ToLight::FromPoint {
            return ray;
        }
        let way = hit_point.point + to_light * r - ray.origin;
        Self { direction: way.normalised(), t_max: way.length(), ..ray }
    }

    /// Returns this ray, aimed at the light that the hit point sees in direction `to_light` at
    /// distance `r`. `step` is the vector from the hit point to the origin.
    ///
    /// The ray is so short that the light lies beyond its end, whatever rounding does: a surface
    /// that touches the light does not occlude it. Nothing occludes a light that is nearer than the
    /// error bound by which the origin was moved.
    ///
    /// r − L·step is the length of the way that is left, except for a share of (|step|/r)², by
    /// which the direction may fail to be of unit length.
    #[inline(always)]
    fn ending_before(self, step: Vec3<T>, to_light: Vec3<T>, r: T) -> Self {
        let left = r - to_light.dot(step);
        let direction = (to_light * r - step) * (T::ONE / left);
        // The coordinates of both ends, along the ray.
        let reach = left + self.origin.abs().dot(to_light.abs());
        let t_max = left - reach * (T::of(32.0) * T::ULP);
        Self { direction, t_max: if left > T::ZERO { t_max } else { T::ZERO }, ..self }
    }

    /// Returns the rest of this ray behind its crossing of an object at `t`. [rule 6]
    ///
    /// Two crossings of one object count as one if they are nearer to each other than RAY_EPSILON,
    /// or than rounding may separate two parameters of one point. A ray through an edge that two
    /// triangles share therefore crosses one surface.
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

    /// Returns `other` over the interval of this ray.
    #[inline(always)]
    pub fn along(&self, other: &Self) -> Self {
        Self { t_min: self.t_min, t_max: self.t_max, ..*other }
    }

    /// Calls `found` with t of every crossing, in ascending order. `first` returns the first
    /// crossing in the interval of this ray, or of a rest of it.
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

    /// Returns the point at parameter `t`.
    #[inline(always)]
    pub fn at(&self, t: T) -> Vec3<T> {
        self.origin + self.direction * t
    }

    /// Returns whether a hit at `t` counts: strictly inside the interval; never for NaN. [rule 2]
    #[inline(always)]
    pub fn contains(&self, t: T) -> bool {
        self.t_min < t && t < self.t_max
    }

    /// Returns whether no hit at `t` or at a lesser parameter counts. [rule 2]
    #[inline(always)]
    pub fn is_before(&self, t: T) -> bool {
        t <= self.t_min
    }

    /// Returns the first of `ts` that counts; `None` if neither does. In ascending order, they give
    /// the nearer hit.
    #[inline(always)]
    pub fn first(&self, ts: [T; 2]) -> Option<T> {
        let [first, second] = ts;
        if self.contains(first) {
            return Some(first);
        }
        self.contains(second).then_some(second)
    }

    /// Returns `ray` in the precision `T`.
    pub fn of(ray: &cases::Ray) -> Self {
        Self {
            origin: Vec3::of(ray.origin),
            direction: Vec3::of(ray.direction),
            t_min: T::of(ray.t_min),
            t_max: T::of(ray.t_max),
        }
    }
}

/// Returns how rays leave surfaces under these rules.
///
/// A negative epsilon is the mistake of counting hits behind the origin; it moves no origin in any
/// style. In a style that needs no epsilon, a mistaken one still counts.
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
