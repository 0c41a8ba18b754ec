//! The triangle. [rule 16] [rule 17]

use super::meeting::Meeting;
use super::settle;
use crate::bounds::Bounds;
use crate::bvh::Across;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::{Robustness, RuleSource, TriangleFormula, TriangleNormal, TriangleTest};
use crate::vec3::Vec3;

/// Corners A, B, C; the normal is along (B − A) × (C − A).
#[derive(Clone, Copy, Debug)]
pub struct Triangle<T> {
    /// A, B, C.
    pub corners: [Vec3<T>; 3],
}

/// What the test needs to know of a ray, worked out once for all triangles.
///
/// Corners are moved so that the ray starts at the origin, then sheared so that it runs along one
/// axis: there the three edge tests are signs of areas in a plane. Two triangles that share an edge
/// compute the same area for it with opposite signs, so no ray slips between them (Woop, Benthin,
/// Wald 2013).
#[derive(Clone, Copy, Debug)]
pub struct Shear<T> {
    axes: [usize; 3],
    shear: [T; 2],
    scale: T,
    /// By how much any area may be off.
    doubt: T,
}

/// A corner as seen along a ray: x and y across it, z along it.
type Seen<T> = (T, T, T);

impl<T: Real> Shear<T> {
    /// The shear of `ray`: along the axis where its direction is longest.
    pub fn of(ray: &Ray<T>) -> Self {
        let d = ray.direction;
        let size = d.abs();
        let z =
            if size.x > size.y && size.x > size.z { 0 } else { 1 + usize::from(size.z >= size.y) };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        Self {
            axes: [x, y, z],
            shear: [d[x] / d[z], d[y] / d[z]],
            scale: T::ONE / d[z],
            doubt: T::INFINITY,
        }
    }

    /// Two axes across the ray, and the one along which its direction is longest.
    #[inline(always)]
    pub(crate) fn axes(&self) -> [usize; 3] {
        self.axes
    }

    /// How far along the first two the ray goes for each step along the third.
    #[inline(always)]
    pub(crate) fn slopes(&self) -> [T; 2] {
        self.shear
    }

    /// 1 over the direction along the third axis.
    #[inline(always)]
    pub(crate) fn scale(&self) -> T {
        self.scale
    }

    /// Whether one bound settles nearly everything: all coordinates in play, their products and
    /// quotients are far from leaving the range of numbers.
    #[inline(always)]
    pub(crate) fn is_bounded(&self) -> bool {
        self.doubt.is_finite()
    }

    /// That of another ray from the same origin along the same axis.
    #[inline(always)]
    pub(crate) fn of_other(&self, slopes: [T; 2], scale: T) -> Self {
        Self { shear: slopes, scale, ..*self }
    }

    /// The same for triangles within `all`: one bound for all of them settles nearly everything,
    /// see [`Triangle::meet`].
    ///
    /// With f the greatest coordinate of a corner as seen from the origin, sheared ones are 2f at
    /// most and so their bound 48u 2f (2f + f).
    pub fn within(self, ray: &Ray<T>, all: Bounds<T>) -> Self {
        let far = (all.min - ray.origin).abs().greatest((all.max - ray.origin).abs()).max_element();
        let doubt = far * far * (T::of(144.0) * T::ULP);
        Self { doubt: if doubt.is_safe() { doubt } else { T::INFINITY }, ..self }
    }

    /// What the test of four triangles at once needs to know of `ray`.
    #[inline(always)]
    pub(crate) fn across(&self, ray: &Ray<T>) -> Across {
        let origin = [ray.origin.x.f64(), ray.origin.y.f64(), ray.origin.z.f64()];
        Across { origin, axes: self.axes, shear: self.shear.map(T::f64), doubt: self.doubt.f64() }
    }
}

/// Whether by these rules a triangle is not met where all its areas, whatever they are off by, tell
/// that it is missed.
#[inline(always)]
pub(crate) fn misses_certainly<R: RuleSource>(rules: R) -> bool {
    let style = &rules.get().style;
    let is_certified =
        style.triangle == TriangleFormula::Sheared && style.robustness == Robustness::Certified;
    is_certified && rules.get().triangle != TriangleTest::TwoEdges
}

impl<T: Real> Triangle<T> {
    /// The meeting in the ray's interval, with (α, β, γ) there. [rule 16]
    ///
    /// Both sides are seen. Edges and corners belong to it; of two triangles met at one t the
    /// caller takes the lower index. A triangle without area, or one seen edge on, is never met.
    #[inline(always)]
    pub fn meet<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        shear: &Shear<T>,
        index: u32,
    ) -> Option<Meeting<T>> {
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
        ray.contains(t).then_some(Meeting { t, part: index, weights })
    }

    /// t and the weights where the ray's line meets the triangle; `None` also where t certainly
    /// does not count.
    ///
    /// Most triangles are missed by far, as one bound for the whole ray can tell.
    #[inline(always)]
    fn certified(&self, ray: &Ray<T>, shear: &Shear<T>, tests_bc: bool) -> Option<(T, Vec3<T>)> {
        let corners = self.seen_along(ray, shear);
        let areas = areas(corners);
        let (least, most) = extremes(areas, tests_bc);
        if least < -shear.doubt && most > shear.doubt {
            return None;
        }
        self.nearly_met(ray, shear, corners, areas, tests_bc)
    }

    /// The same for a triangle that is not missed by far.
    ///
    /// Where the first look leaves open whether it is met, or few digits of the weights or of t,
    /// the second step is taken.
    #[inline(never)]
    fn nearly_met(
        &self,
        ray: &Ray<T>,
        shear: &Shear<T>,
        corners: [Seen<T>; 3],
        areas: [T; 3],
        tests_bc: bool,
    ) -> Option<(T, Vec3<T>)> {
        let look = Look::at(corners, areas, shear.scale, tests_bc);
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

    /// Whether the ray certainly starts on one side of the plane and goes away from it, as most do
    /// that start at the triangle.
    ///
    /// With u half a ulp, a component of N is off by 4u of the amounts of its terms, so what it
    /// makes of corner and direction by 8u of theirs.
    fn is_left(&self, ray: &Ray<T>) -> bool {
        let (n, terms) = self.outwards_with_terms();
        let sign = |v: Vec3<T>| {
            let (along, doubt) = (n.dot(v), terms.dot(v.abs()) * (T::of(6.0) * T::ULP));
            if along.abs() > doubt && doubt.is_safe() { along } else { T::ZERO }
        };
        let (to_plane, slope) = (sign(self.corners[0] - ray.origin), sign(ray.direction));
        to_plane != T::ZERO && slope != T::ZERO && (to_plane < T::ZERO) != (slope < T::ZERO)
    }

    /// The corners as seen along the ray: x and y across it, z along it.
    #[inline(always)]
    fn seen_along(&self, ray: &Ray<T>, shear: &Shear<T>) -> [Seen<T>; 3] {
        match shear.axes {
            [_, _, 0] => self.seen_by::<1, 2, 0>(ray, shear),
            [_, _, 1] => self.seen_by::<2, 0, 1>(ray, shear),
            _ => self.seen_by::<0, 1, 2>(ray, shear),
        }
    }

    /// The same with axes that are known when the program is compiled: one branch in the place of
    /// nine choices.
    #[inline(always)]
    fn seen_by<const X: usize, const Y: usize, const Z: usize>(
        &self,
        ray: &Ray<T>,
        shear: &Shear<T>,
    ) -> [Seen<T>; 3] {
        let seen = |corner: Vec3<T>| {
            let from = corner - ray.origin;
            (from[X] - shear.shear[0] * from[Z], from[Y] - shear.shear[1] * from[Z], from[Z])
        };
        let [a, b, c] = self.corners;
        [seen(a), seen(b), seen(c)]
    }

    /// t and the weights where the ray's line meets the triangle, whatever rounding makes of them;
    /// the edge BC need not be tested.
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

    /// (B − A) × (C − A), not normalised.
    pub(super) fn outwards(&self) -> Vec3<T> {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// The same, and what the terms of each component amount to.
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

    /// The outward direction, of some length and right to a few hundred last places at worst;
    /// `None` where no area is left.
    fn certified_outwards(&self) -> Option<Vec3<T>> {
        let (n, terms) = self.outwards_with_terms();
        let (square, of_terms) = (n.dot(n), terms.dot(terms));
        if square.is_safe() && of_terms.is_safe() && square * T::of(4096.0) > of_terms {
            return Some(n);
        }
        settle::outwards(&self.corners)
    }

    /// Whether it has an area; without one it is never met. [rule 16]
    pub fn has_area(&self) -> bool {
        self.certified_outwards().is_some()
    }

    /// The unit normal along (B − A) × (C − A). [rule 16]
    pub fn normal<R: RuleSource>(&self, rules: R) -> Vec3<T> {
        let n = match rules.get().style.robustness {
            Robustness::Certified => self.certified_outwards().unwrap_or_else(|| self.outwards()),
            Robustness::Plain => self.outwards(),
        };
        let n = n.normalised();
        if rules.get().triangle_normal == TriangleNormal::Left { -n } else { n }
    }
}

/// What the first look at a triangle tells, in plain numbers and with a bound of their error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look<T> {
    /// Whether the ray's line certainly misses it.
    pub is_missed: bool,
    /// Whether the line certainly meets it, and the weights are right to most of their digits.
    is_inside: bool,
    /// Whether t is as well.
    pub is_sure: bool,
    /// Whether it certainly lies behind the origin, if it is met.
    is_behind: bool,
    /// Where the line meets it, if that is sure.
    pub t: T,
    /// (α, β, γ) there.
    pub weights: Vec3<T>,
}

impl<T: Real> Look<T> {
    /// A look at `corners`, as seen along a ray: without a branch, so that many rays can be looked
    /// along at once.
    ///
    /// With u half a ulp, x the greatest of sheared coordinates and z that along the ray: a sheared
    /// coordinate is off by u (2x + 6z), so an area by u x (12x + 24z) at most, twice that below
    /// 48u x (x + z); and Σ area·z by z times the three of them and 4u Σ|area|.
    #[inline(always)]
    fn at([a, b, c]: [Seen<T>; 3], [u, v, w]: [T; 3], scale: T, tests_bc: bool) -> Self {
        let across = |p: Seen<T>| greater(p.0.abs(), p.1.abs());
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
        // of five factors: it may leave the range where none of them does
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

    /// The same along a ray with that shear, for corners as they lie from its origin along the
    /// shear's axes.
    #[inline(always)]
    pub(crate) fn along([x, y]: [T; 2], scale: T, corners: [[T; 3]; 3]) -> Self {
        let seen = |from: [T; 3]| (from[0] - x * from[2], from[1] - y * from[2], from[2]);
        let corners = [seen(corners[0]), seen(corners[1]), seen(corners[2])];
        Self::at(corners, areas(corners), scale, true)
    }
}

/// Twice the signed areas of the triangles between the ray and the sides across from A, B and C,
/// across the ray.
#[inline(always)]
fn areas<T: Real>([a, b, c]: [Seen<T>; 3]) -> [T; 3] {
    let area = |p: Seen<T>, q: Seen<T>| p.0 * q.1 - p.1 * q.0;
    [area(b, c), area(c, a), area(a, b)]
}

/// The least and the greatest of those that are tested.
#[inline(always)]
fn extremes<T: Real>([u, v, w]: [T; 3], tests_bc: bool) -> (T, T) {
    let (least, most) = (lesser(v, w), greater(v, w));
    if tests_bc { (lesser(u, least), greater(u, most)) } else { (least, most) }
}

/// The greater; where one is NaN, either.
#[inline(always)]
fn greater<T: Real>(p: T, q: T) -> T {
    if p > q { p } else { q }
}

/// The lesser; where one is NaN, either.
#[inline(always)]
fn lesser<T: Real>(p: T, q: T) -> T {
    if p < q { p } else { q }
}

/// (α, β, γ) of a point Q in the plane of ABC: signed areas of QBC, AQC, ABQ, over that of ABC.
/// [rule 17]
///
/// NaN where ABC has no area.
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
