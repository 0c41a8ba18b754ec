//! The triangle. [rule 16] [rule 17]

use super::hit::ShapeHit;
use super::settle;
use super::shear::Shear;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{Robustness, RuleSource, TriangleFormula, TriangleNormal, TriangleTest};

/// A triangle with corners A, B, C and the normal along (B − A) × (C − A).
#[derive(Clone, Copy, Debug)]
pub struct Triangle<T> {
    /// The corners A, B, C.
    pub corners: [Vec3<T>; 3],
}

/// A corner as seen along a ray: x and y across it, z along it.
type RayCorner<T> = (T, T, T);

/// Returns whether, under these rules, areas that exceed their error bound can prove a miss.
#[inline(always)]
pub(crate) fn misses_certainly<R: RuleSource>(rules: R) -> bool {
    let style = &rules.get().style;
    let is_certified =
        style.triangle == TriangleFormula::Sheared && style.robustness == Robustness::Certified;
    is_certified && matches!(rules.get().triangle, TriangleTest::Full | TriangleTest::FrontOnly)
}

impl<T: Real> Triangle<T> {
    /// Returns the hit in the ray's interval, with (α, β, γ) there; `None` for a miss. [rule 16]
    ///
    /// Hits on both sides count. Edges and corners belong to the triangle; of two triangles hit at
    /// one t the caller takes the lower index. A triangle without area, or one seen edge on, is
    /// never hit. `shear` is that of `ray`, and `index` becomes the part of the hit.
    #[inline(always)]
    pub fn intersect<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        shear: &Shear<T>,
        index: u32,
    ) -> Option<ShapeHit<T>> {
        if matches!(rules.get().triangle, TriangleTest::WithoutAb | TriangleTest::WholePlane) {
            return self.loosely(rules, ray, index);
        }
        let tests_bc = rules.get().triangle != TriangleTest::TwoEdges;
        let (t, weights) = match rules.get().style.triangle {
            TriangleFormula::Sheared if rules.get().style.robustness == Robustness::Certified => {
                self.certified(ray, shear, tests_bc)
            }
            TriangleFormula::Sheared => self.sheared(ray, shear, tests_bc),
            TriangleFormula::Edges => self.edges(ray, tests_bc),
            TriangleFormula::MollerTrumbore => self.moller_trumbore(ray, tests_bc),
            TriangleFormula::Areas => self.areas(ray, tests_bc),
        }?;
        if rules.get().triangle == TriangleTest::FrontOnly
            && self.outwards().dot(ray.direction) > T::ZERO
        {
            return None;
        }
        ray.contains(t).then_some(ShapeHit { t, part: index, weights })
    }

    /// Returns t and the weights where the ray's line intersects the triangle; `None` also where t
    /// certainly does not count.
    ///
    /// Most triangles are missed by far, which one bound for the whole ray proves.
    #[inline(always)]
    fn certified(&self, ray: &Ray<T>, shear: &Shear<T>, tests_bc: bool) -> Option<(T, Vec3<T>)> {
        let corners = self.seen_along(ray, shear);
        let areas = areas(corners);
        let (least, most) = extremes(areas, tests_bc);
        if least < -shear.doubt && most > shear.doubt {
            return None;
        }
        self.nearly_hit(ray, shear, corners, areas, tests_bc)
    }

    /// Returns what [`Self::certified`] returns, for a triangle that is not missed by far.
    ///
    /// Where the first look leaves the hit open, or few digits of the weights or of t, the second
    /// step is taken.
    #[inline(never)]
    fn nearly_hit(
        &self,
        ray: &Ray<T>,
        shear: &Shear<T>,
        corners: [RayCorner<T>; 3],
        areas: [T; 3],
        tests_bc: bool,
    ) -> Option<(T, Vec3<T>)> {
        let look = FirstStep::at(corners, areas, shear.scale, tests_bc);
        if look.is_missed {
            return None;
        }
        if look.is_sure {
            return Some((look.t, look.weights));
        }
        let is_behind = look.is_inside && (look.is_behind || self.is_left(ray));
        if is_behind && ray.is_before(T::ZERO) {
            return None;
        }
        settle::triangle(&self.corners, ray, shear.axes, tests_bc)
    }

    /// Returns whether the ray certainly starts on one side of the plane and goes away from it.
    /// Most rays that start at the triangle do.
    ///
    /// With u half a ulp, a component of N is off by 4u of the magnitudes of its terms, so its
    /// products with corner and direction are off by 8u of theirs.
    fn is_left(&self, ray: &Ray<T>) -> bool {
        let (n, terms) = self.outwards_with_terms();
        let sign = |v: Vec3<T>| {
            let (along, doubt) = (n.dot(v), terms.dot(v.abs()) * (T::of(6.0) * T::ULP));
            if along.abs() > doubt && doubt.is_safe() { along } else { T::ZERO }
        };
        let (to_plane, slope) = (sign(self.corners[0] - ray.origin), sign(ray.direction));
        to_plane != T::ZERO && slope != T::ZERO && (to_plane < T::ZERO) != (slope < T::ZERO)
    }

    /// Returns the corners as seen along the ray: x and y across it, z along it.
    #[inline(always)]
    fn seen_along(&self, ray: &Ray<T>, shear: &Shear<T>) -> [RayCorner<T>; 3] {
        match shear.axes {
            [_, _, 0] => self.seen_by::<1, 2, 0>(ray, shear),
            [_, _, 1] => self.seen_by::<2, 0, 1>(ray, shear),
            _ => self.seen_by::<0, 1, 2>(ray, shear),
        }
    }

    /// Returns the corners as seen along the ray, for axes that are known at compile time. Axes in
    /// variables would cost nine choices; these cost one branch.
    #[inline(always)]
    fn seen_by<const X: usize, const Y: usize, const Z: usize>(
        &self,
        ray: &Ray<T>,
        shear: &Shear<T>,
    ) -> [RayCorner<T>; 3] {
        let seen = |corner: Vec3<T>| {
            let from = corner - ray.origin;
            (from[X] - shear.shear[0] * from[Z], from[Y] - shear.shear[1] * from[Z], from[Z])
        };
        let [a, b, c] = self.corners;
        [seen(a), seen(b), seen(c)]
    }

    /// Returns t and the weights where the ray's line intersects the triangle, without a bound of
    /// their error. `tests_bc` says whether the edge BC is tested.
    #[inline(always)]
    fn sheared(&self, ray: &Ray<T>, shear: &Shear<T>, tests_bc: bool) -> Option<(T, Vec3<T>)> {
        let corners = self.seen_along(ray, shear);
        let ([a, b, c], [u, v, w]) = (corners, areas(corners));
        let tested = if tests_bc { [u, v, w] } else { [v, v, w] };
        let is_outside = tested.iter().any(|s| *s < T::ZERO) && tested.iter().any(|s| *s > T::ZERO);
        let sum = u + v + w;
        if is_outside || sum == T::ZERO {
            return None;
        }
        Some((
            shear.scale * (u * a.2 + v * b.2 + w * c.2) / sum,
            Vec3::new(u, v, w) * (T::ONE / sum),
        ))
    }

    /// Returns (B − A) × (C − A), not normalised.
    pub(super) fn outwards(&self) -> Vec3<T> {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Returns (B − A) × (C − A), and the sum of the magnitudes of the terms of each component.
    fn outwards_with_terms(&self) -> (Vec3<T>, Vec3<T>) {
        let [a, b, c] = self.corners;
        let (p, q) = (b - a, c - a);
        let (p1, q1) = (p.abs(), q.abs());
        let terms = Vec3::new(
            p1.y * q1.z + p1.z * q1.y,
            p1.z * q1.x + p1.x * q1.z,
            p1.x * q1.y + p1.y * q1.x,
        );
        (p.cross(q), terms)
    }

    /// Returns the outward direction, not normalised, right to a few hundred units in the last
    /// place at worst; `None` where no area is left.
    fn certified_outwards(&self) -> Option<Vec3<T>> {
        let (n, terms) = self.outwards_with_terms();
        let (square, of_terms) = (n.dot(n), terms.dot(terms));
        if square.is_safe() && of_terms.is_safe() && square * T::of(4096.0) > of_terms {
            return Some(n);
        }
        settle::outwards(&self.corners)
    }

    /// Returns whether the triangle has an area; without one it is never hit. [rule 16]
    pub fn has_area(&self) -> bool {
        self.certified_outwards().is_some()
    }

    /// Returns the unit normal along (B − A) × (C − A). [rule 16]
    ///
    /// Without an area, the result means nothing and may be NaN.
    pub fn normal<R: RuleSource>(&self, rules: R) -> Vec3<T> {
        let n = match rules.get().style.robustness {
            Robustness::Certified => self.certified_outwards().unwrap_or_else(|| self.outwards()),
            Robustness::Plain => self.outwards(),
        };
        match rules.get().triangle_normal {
            TriangleNormal::Right => n.normalised(),
            TriangleNormal::Left => -n.normalised(),
            TriangleNormal::NotUnit => n,
        }
    }
}

/// The first look at a triangle, in one word per number, with a bound of the error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstStep<T> {
    /// Whether the ray's line certainly misses the triangle.
    pub is_missed: bool,
    /// Whether the line certainly hits the triangle, and the weights are right to most of their
    /// digits.
    is_inside: bool,
    /// Whether, in addition, t is right to most of its digits.
    pub is_sure: bool,
    /// Whether the hit, if there is one, certainly lies behind the origin.
    is_behind: bool,
    /// The parameter of the hit, if `is_sure`.
    pub t: T,
    /// The weights (α, β, γ) of the hit.
    pub weights: Vec3<T>,
}

impl<T: Real> FirstStep<T> {
    /// Returns the look at `corners`, as seen along a ray. There is no branch, so that the compiler
    /// can look along many rays at once.
    ///
    /// With u half a ulp, x the greatest of the sheared coordinates and z the greatest along the
    /// ray: a sheared coordinate is off by u (2x + 6z), so an area by u x (12x + 24z) at most,
    /// twice that below 48u x (x + z); and Σ area·z is off by z times the sum of these three errors
    /// and 4u Σ|area|.
    #[inline(always)]
    fn at([a, b, c]: [RayCorner<T>; 3], [u, v, w]: [T; 3], scale: T, tests_bc: bool) -> Self {
        let across = |p: RayCorner<T>| greater(p.0.abs(), p.1.abs());
        let x = greater(across(a), greater(across(b), across(c)));
        let z = greater(a.2.abs(), greater(b.2.abs(), c.2.abs()));
        let doubt = x * (x + z) * (T::of(24.0) * T::ULP);
        let (least, most) = extremes([u, v, w], tests_bc);
        let sum = u + v + w;
        let is_missed = doubt.is_safe() & (least < -doubt) & (most > doubt);
        let is_inside = ((least > doubt) | (most < -doubt)) & (sum.abs() > doubt * T::MARGIN);
        let is_inside = is_inside & doubt.is_safe() & scale.is_safe();
        let along = u * a.2 + v * b.2 + w * c.2;
        let in_doubt = z * (T::of(4.0) * (doubt + T::ULP * sum.abs()));
        // A product of five factors: it may leave the range where none of them does.
        let scaled = scale * along;
        let t = scaled / sum;
        let is_sure = is_inside & (along.abs() > in_doubt * T::MARGIN) & scaled.is_safe();
        let is_behind = (along.abs() > in_doubt) & (t < T::ZERO);
        Self {
            is_missed,
            is_inside,
            is_sure,
            is_behind,
            t,
            weights: Vec3::new(u, v, w) * (T::ONE / sum),
        }
    }

    /// Returns the look along a ray with this shear. `corners` are relative to the ray's origin,
    /// along the axes of the shear.
    #[inline(always)]
    pub(crate) fn along([x, y]: [T; 2], scale: T, corners: [[T; 3]; 3]) -> Self {
        let seen = |from: [T; 3]| (from[0] - x * from[2], from[1] - y * from[2], from[2]);
        let corners = [seen(corners[0]), seen(corners[1]), seen(corners[2])];
        Self::at(corners, areas(corners), scale, true)
    }
}

/// Returns twice the signed areas, across the ray, of the triangles between the ray and the sides
/// opposite A, B and C.
#[inline(always)]
fn areas<T: Real>([a, b, c]: [RayCorner<T>; 3]) -> [T; 3] {
    let area = |p: RayCorner<T>, q: RayCorner<T>| p.0 * q.1 - p.1 * q.0;
    [area(b, c), area(c, a), area(a, b)]
}

/// Returns the least and the greatest of the areas that are tested; without `tests_bc`, the first
/// one is not.
#[inline(always)]
fn extremes<T: Real>([u, v, w]: [T; 3], tests_bc: bool) -> (T, T) {
    let (least, most) = (lesser(v, w), greater(v, w));
    if tests_bc { (lesser(u, least), greater(u, most)) } else { (least, most) }
}

/// Returns the greater of both; if one is NaN, either.
#[inline(always)]
fn greater<T: Real>(p: T, q: T) -> T {
    if p > q { p } else { q }
}

/// Returns the lesser of both; if one is NaN, either.
#[inline(always)]
fn lesser<T: Real>(p: T, q: T) -> T {
    if p < q { p } else { q }
}

/// Returns (α, β, γ) of a point Q in the plane of ABC: the signed areas of QBC, AQC, ABQ, over that
/// of ABC. [rule 17]
///
/// All three are NaN where ABC has no area.
pub fn barycentric<T: Real, R: RuleSource>(
    rules: R,
    [a, b, c]: [Vec3<T>; 3],
    q: Vec3<T>,
) -> Vec3<T> {
    if rules.get().style.robustness == Robustness::Certified {
        return settle::barycentric([a, b, c], q);
    }
    let n = (b - a).cross(c - a);
    let area = |p: Vec3<T>, r: Vec3<T>, s: Vec3<T>| (r - p).cross(s - p).dot(n);
    Vec3::new(area(q, b, c), area(a, q, c), area(a, b, q)) * (T::ONE / n.dot(n))
}

#[cfg(test)]
mod tests;
