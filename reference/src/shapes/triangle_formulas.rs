//! The triangle as students intersect it: other formulas within [`Triangle::intersect`]. [rule 16]
//! [rule 17]
//!
//! Each formula returns t and (α, β, γ) where the ray's line intersects the triangle. `None` means
//! that the line passes beside it, or that the triangle is seen edge on or has no area. Without
//! `tests_bc`, the edge BC is not tested.

use super::{ShapeHit, Triangle};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{RuleSource, TriangleTest};

impl<T: Real> Triangle<T> {
    /// Intersects the plane in Q, then tests ((B − A) × (Q − A))·N ≥ 0 and so on round, as rule 16
    /// has it.
    pub(super) fn edges(&self, ray: &Ray<T>, tests_bc: bool) -> Option<(T, Vec3<T>)> {
        let (t, q, n) = self.in_plane(ray)?;
        let [a, b, c] = self.corners;
        let side = |from: Vec3<T>, to: Vec3<T>| (to - from).cross(q - from).dot(n);
        let (of_a, of_b, of_c) = (side(b, c), side(c, a), side(a, b));
        let weights = Vec3::new(of_a, of_b, of_c) * (T::ONE / n.dot(n));
        is_inside(weights, tests_bc).then_some((t, weights))
    }

    /// Uses the formulas of Möller and Trumbore, 1997.
    pub(super) fn moller_trumbore(&self, ray: &Ray<T>, tests_bc: bool) -> Option<(T, Vec3<T>)> {
        let [a, b, c] = self.corners;
        let (ab, ac) = (b - a, c - a);
        let p = ray.direction.cross(ac);
        let det = ab.dot(p);
        if det == T::ZERO {
            return None;
        }
        let inverse = T::ONE / det;
        let from_a = ray.origin - a;
        let q = from_a.cross(ab);
        let (beta, gamma) = (from_a.dot(p) * inverse, ray.direction.dot(q) * inverse);
        let weights = Vec3::new(T::ONE - beta - gamma, beta, gamma);
        is_inside(weights, tests_bc).then_some((ac.dot(q) * inverse, weights))
    }

    /// Intersects the plane in Q, then takes areas without the axis along which N is longest, as
    /// rule 17 allows.
    pub(super) fn areas(&self, ray: &Ray<T>, tests_bc: bool) -> Option<(T, Vec3<T>)> {
        let (t, q, n) = self.in_plane(ray)?;
        let size = n.abs();
        let z =
            if size.x > size.y && size.x > size.z { 0 } else { 1 + usize::from(size.z >= size.y) };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let area = |a: Vec3<T>, b: Vec3<T>, c: Vec3<T>| {
            (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x])
        };
        let [a, b, c] = self.corners;
        let all = area(a, b, c);
        let (beta, gamma) = (area(a, q, c) / all, area(a, b, q) / all);
        let weights = Vec3::new(T::ONE - beta - gamma, beta, gamma);
        is_inside(weights, tests_bc).then_some((t, weights))
    }

    /// Returns the hit in the ray's interval where the edge AB, or no edge, is tested.
    pub(super) fn loosely<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        index: u32,
    ) -> Option<ShapeHit<T>> {
        let (t, q, n) = self.in_plane(ray)?;
        let [a, b, c] = self.corners;
        let side = |from: Vec3<T>, to: Vec3<T>| (to - from).cross(q - from).dot(n);
        let weights = Vec3::new(side(b, c), side(c, a), side(a, b)) * (T::ONE / n.dot(n));
        let is_inside = rules.get().triangle == TriangleTest::WholePlane
            || weights.x.least(weights.y) >= T::ZERO;
        (is_inside && ray.contains(t)).then_some(ShapeHit { t, part: index, weights })
    }

    /// Returns t, Q and N, not normalised, where the ray's line intersects the plane of the
    /// triangle; `None` for a parallel ray.
    fn in_plane(&self, ray: &Ray<T>) -> Option<(T, Vec3<T>, Vec3<T>)> {
        let n = self.outwards();
        let slope = n.dot(ray.direction);
        if slope == T::ZERO {
            return None;
        }
        let t = n.dot(self.corners[0] - ray.origin) / slope;
        Some((t, ray.at(t), n))
    }
}

/// Returns whether the weights are those of a point in the triangle. Borders belong to it; NaN does
/// not.
fn is_inside<T: Real>(weights: Vec3<T>, tests_bc: bool) -> bool {
    (weights.x >= T::ZERO || !tests_bc) && weights.y >= T::ZERO && weights.z >= T::ZERO
}
