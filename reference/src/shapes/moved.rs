//! Shapes under a matrix: hits decided for the exact ray in object space. [rule 20]
//!
//! Where the bound of what rounding does to the ray shows that it changes no decision, the rounded
//! ray is intersected. Elsewhere the decision is made in two words, from the ray in world space.

use super::settle::{self, Ball};
use super::{Cuboid, Plane, Round, ShapeHit, Solid, Sphere, Square};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::frame::Frame;
use crate::rays::moved::MovedRay;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{ObjectRay, PlaneSide, Quadratic, Robustness, RuleSource, SquareSize};

/// Returns whether, under these rules, hits on transformed shapes are decided for the exact ray.
#[inline(always)]
pub(crate) fn is_exact<R: RuleSource>(rules: R) -> bool {
    let rules = rules.get();
    rules.style.robustness == Robustness::Certified && rules.object_ray == ObjectRay::AsIs
}

impl<T: Real> Solid<T> {
    /// Returns the first hit of a ray that a matrix has moved here, decided for the exact ray;
    /// `None` for a miss.
    #[inline(always)]
    pub fn intersect_moved<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
    ) -> Option<ShapeHit<T>> {
        match self {
            Self::Sphere(sphere) => {
                let roots = sphere.moved_roots(rules, moved)?;
                sphere.first(rules, &moved.ray, roots).map(|t| ShapeHit::with(t, 0))
            }
            Self::Cuboid(cuboid) => cuboid.first(rules, &moved.ray, cuboid.moved_ends(moved)?),
            Self::Plane(plane) => plane.intersect_moved(rules, moved),
            Self::Square(square) => square.intersect_moved(rules, moved),
            Self::Round(round) => round.intersect_moved(rules, moved),
        }
    }

    /// Returns t and the outward unit normal in world space of the first hit on this shape,
    /// transformed by `frame`; `None` for a miss. `ray` is in world space.
    pub fn hit_under<R: RuleSource>(
        &self,
        rules: R,
        frame: &Frame<T>,
        ray: &Ray<T>,
    ) -> Option<(T, Vec3<T>)> {
        let (hit, normal) = if is_exact(rules) {
            let moved = frame.moved_ray(ray);
            let hit = self.intersect_moved(rules, &moved)?;
            (hit, self.normal_at_moved_hit(rules, &moved, &hit))
        } else {
            let moved = Frame::ray_to_object(rules, &frame.object_from_world, ray);
            let hit = self.intersect(rules, &moved)?;
            (hit, self.normal_at_hit(rules, &moved, &hit))
        };
        Some((hit.t, frame.normal_to_world(rules, normal)))
    }

    /// Returns the outward unit normal, in object space, at the hit of a ray that a matrix has
    /// moved here. By rules that move no hits back onto surfaces, the normal is that at the point
    /// along the rounded ray.
    #[inline(always)]
    fn normal_at_moved_hit<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
        hit: &ShapeHit<T>,
    ) -> Vec3<T> {
        match rules.get().places_hits() {
            true => self.place_moved(rules, moved, hit).n_geom,
            false => self.normal(rules, moved.ray.at(hit.t), hit.part),
        }
    }

    /// Calls `found` with t of every crossing of a ray that a matrix has moved here, in ascending
    /// order. [rule 6]
    #[inline(always)]
    pub fn moved_crossings<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
        mut found: impl FnMut(T),
    ) {
        match self {
            Self::Sphere(sphere) => {
                if let Some(roots) = sphere.moved_roots(rules, moved) {
                    moved.in_world.cross(rules, |rest| sphere.first(rules, rest, roots), found);
                }
            }
            Self::Cuboid(cuboid) => {
                if let Some(ends) = cuboid.moved_ends(moved) {
                    let first = |rest: &Ray<T>| cuboid.first(rules, rest, ends).map(|hit| hit.t);
                    moved.in_world.cross(rules, first, found);
                }
            }
            Self::Plane(_) | Self::Square(_) => {
                if let Some(hit) = self.intersect_moved(rules, moved) {
                    found(hit.t);
                }
            }
            Self::Round(round) => {
                let first = |rest: &Ray<T>| {
                    let rest = MovedRay { ray: rest.along(&moved.ray), ..*moved };
                    round.intersect_moved(rules, &rest).map(|hit| hit.t)
                };
                moved.in_world.cross(rules, first, found);
            }
        }
    }

    /// Returns the hit point, in object space, of a ray that a matrix has moved here.
    ///
    /// Where the ray comes from so far away that the point along the rounded ray has too few
    /// digits, the point follows from the exact one.
    #[inline(always)]
    pub fn place_moved<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
        hit: &ShapeHit<T>,
    ) -> HitPoint<T> {
        let point = match self {
            Self::Sphere(sphere) if sphere.is_far(moved) => sphere.exact_point(moved, hit.t),
            Self::Round(round) if round.cap_height(hit.part).is_none() => {
                match round.is_blurred(moved, hit.t) {
                    true => round.exact_point(moved, hit.t),
                    false => None,
                }
            }
            _ => None,
        };
        match point {
            None => self.place(rules, &moved.ray, hit),
            Some(point) => {
                let near = Ray { origin: point, ..moved.ray };
                self.place(rules, &near, &ShapeHit { t: T::ZERO, ..*hit })
            }
        }
    }
}

impl<T: Real> Sphere<T> {
    #[inline(always)]
    fn moved_roots<R: RuleSource>(&self, rules: R, moved: &MovedRay<'_, T>) -> Option<[T; 2]> {
        let is_own = rules.get().style.quadratic == Quadratic::NearestPoint
            && rules.get().has_right_spheres();
        if !is_own || self.is_clear(moved) {
            return self.roots(rules, &moved.ray);
        }
        // Destructured and built again, so that the roots of the first step stay in registers.
        let [near, far] = self.moved_roots_in_doubt(rules, moved)?;
        Some([near, far])
    }

    #[cold]
    #[inline(never)]
    fn moved_roots_in_doubt<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
    ) -> Option<[T; 2]> {
        if self.is_clear_by_axes(moved) {
            return self.roots(rules, &moved.ray);
        }
        Ball::new(&self.center, &self.radius, moved)?.ts()
    }

    #[cold]
    #[inline(never)]
    fn exact_point(&self, moved: &MovedRay<'_, T>, t: T) -> Option<Vec3<T>> {
        let out = Ball::new(&self.center, &self.radius, moved)?.outwards(t)?;
        let out = out.normalised();
        let out = Vec3::new(T::of(out.x), T::of(out.y), T::of(out.z));
        (self.radius > T::ZERO).then(|| self.center + out * self.radius)
    }
}

impl<T: Real> Plane<T> {
    #[inline(always)]
    fn intersect_moved<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
    ) -> Option<ShapeHit<T>> {
        let (side, k) = (rules.get().plane, self.offset(rules));
        if self.is_clear(k, moved) {
            return self.intersect(rules, &moved.ray);
        }
        if side == PlaneSide::FrontOnly && self.normal.dot(moved.ray.direction) > T::ZERO {
            return None;
        }
        let t = settle::plane(&self.normal, k, moved)?;
        moved.ray.contains(t).then(|| ShapeHit::with(t, 0))
    }
}

impl Square {
    #[inline(always)]
    fn intersect_moved<T: Real, R: RuleSource>(
        self,
        rules: R,
        moved: &MovedRay<'_, T>,
    ) -> Option<ShapeHit<T>> {
        let half = match rules.get().square {
            SquareSize::Half => T::HALF,
            SquareSize::One => T::ONE,
            SquareSize::Disc | SquareSize::FromZero => return self.intersect(rules, &moved.ray),
        };
        if self.is_clear(half, moved) {
            return self.intersect(rules, &moved.ray);
        }
        let t = settle::square_at(half, moved)?;
        moved.ray.contains(t).then(|| ShapeHit::with(t, 0))
    }
}

impl<T: Real> Cuboid<T> {
    #[inline(always)]
    fn moved_ends(&self, moved: &MovedRay<'_, T>) -> Option<[(T, u32); 2]> {
        if self.is_missed(moved) {
            return None;
        }
        if self.is_clear(moved) {
            return self.cut(&moved.ray, true);
        }
        // Destructured and built again, so that the ends of the first step stay in registers.
        let [(enter, first), (leave, last)] = settle::cuboid(&self.min, &self.max, moved)?;
        Some([(enter, first), (leave, last)])
    }
}

impl<T: Real> Round<T> {
    #[inline(always)]
    fn intersect_moved<R: RuleSource>(
        &self,
        rules: R,
        moved: &MovedRay<'_, T>,
    ) -> Option<ShapeHit<T>> {
        let style = &rules.get().style;
        let is_own =
            style.quadratic == Quadratic::NearestPoint || style.quadratic == Quadratic::Geometric;
        if !is_own || !rules.get().has_right_rounds() || self.is_clear(moved) {
            return self.intersect(rules, &moved.ray);
        }
        self.settled(&moved.ray, moved).map(|(t, part)| ShapeHit::with(t, part))
    }
}
