//! The axis-aligned box. [rule 15]

use super::hit::ShapeHit;
use super::settle;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::rules::{BoxNormal, BoxRoots, Robustness, RuleSource};

/// The surface of the box min ≤ X ≤ max.
#[derive(Clone, Copy, Debug)]
pub struct Cuboid<T> {
    /// The least corner.
    pub min: Vec3<T>,
    /// The greatest corner.
    pub max: Vec3<T>,
}

impl<T: Real> Cuboid<T> {
    /// Returns the first hit in the ray's interval: where the ray enters, or where it leaves if the
    /// entry does not count. `None` if neither counts.
    ///
    /// The slabs of the three axes are intersected with one another. A ray that runs along a slab
    /// is inside or outside of it all along; to run within a face is to be inside. On an edge, the
    /// hit is on the face of the lower axis.
    #[inline(always)]
    pub fn intersect<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<ShapeHit<T>> {
        let ends = self.cut(ray, rules.get().style.robustness == Robustness::Certified)?;
        self.first(rules, ray, ends)
    }

    /// Returns the hit in the ray's interval, given where the ray enters and leaves.
    #[inline(always)]
    pub(super) fn first<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        ends: [(T, u32); 2],
    ) -> Option<ShapeHit<T>> {
        let [enter, leave] = match rules.get().box_roots {
            BoxRoots::NearThenFar | BoxRoots::NearOnly => ends,
            BoxRoots::FarFirst => [ends[1], ends[0]],
        };
        if ray.contains(enter.0) {
            return Some(ShapeHit::with(enter.0, enter.1));
        }
        (rules.get().box_roots != BoxRoots::NearOnly && ray.contains(leave.0))
            .then(|| ShapeHit::with(leave.0, leave.1))
    }

    /// Returns where the ray's line enters and where it leaves: t and the face. `None` where it
    /// does neither, or the box lies behind the ray.
    ///
    /// A t is off by a difference and a quotient, 2u of itself, u half a ulp: which of two is the
    /// greater is certain where they differ by more than 4u of either. 8u is demanded, and where
    /// that leaves an order open, the second step is taken. The sign of a difference is certain.
    #[inline(always)]
    pub(super) fn cut(&self, ray: &Ray<T>, is_certified: bool) -> Option<[(T, u32); 2]> {
        let (to_min, to_max, along) = (self.min - ray.origin, self.max - ray.origin, ray.direction);
        let leaves = |axis: usize| {
            (to_min[axis] > T::ZERO) & (along[axis] <= T::ZERO)
                | (to_max[axis] < T::ZERO) & (along[axis] >= T::ZERO)
        };
        if (leaves(0) | leaves(1) | leaves(2)) && ray.is_before(T::ZERO) {
            return None;
        }
        if (along.x == T::ZERO) | (along.y == T::ZERO) | (along.z == T::ZERO) {
            let [(enter, first), (leave, last)] = self.cut_one_by_one(ray, is_certified)?;
            return Some([(enter, first), (leave, last)]);
        }
        let ts = |axis: usize| {
            let (to_min, to_max) = (to_min[axis] / along[axis], to_max[axis] / along[axis]);
            if along[axis] > T::ZERO { [to_min, to_max] } else { [to_max, to_min] }
        };
        let [x, y, z] = [ts(0), ts(1), ts(2)];
        let later = |a: T, b: T| if b > a { b } else { a };
        let earlier = |a: T, b: T| if b < a { b } else { a };
        let (enters, leaves) = ([x[0], later(x[0], y[0])], [x[1], earlier(x[1], y[1])]);
        let (enter, leave) = (later(enters[1], z[0]), earlier(leaves[1], z[1]));
        let is_missed = enter > leave;
        if is_missed && (!is_certified || apart(enter, leave)) {
            return None;
        }
        let axis = |n: usize, t: T| {
            if t == x[n] {
                0
            } else if t == y[n] {
                1
            } else {
                2
            }
        };
        let (first, last) = (axis(0, enter), axis(1, leave));
        let is_certain = || {
            let is_begun = x[0].is_finite() & x[1].is_finite();
            let is_clear =
                |n: usize, so_far: [T; 2]| apart(y[n], so_far[0]) & apart(z[n], so_far[1]);
            is_begun
                & is_clear(0, enters)
                & is_clear(1, leaves)
                & ((first == last) | apart(enter, leave))
        };
        if is_certified && !is_certain() {
            // Destructured and built again, so that the results of the certain case stay in
            // registers.
            let [(enter, first), (leave, last)] = settle::cuboid(&self.min, &self.max, ray)?;
            return Some([(enter, first), (leave, last)]);
        }
        Some([
            (enter, face(first, along[first] < T::ZERO)),
            (leave, face(last, along[last] > T::ZERO)),
        ])
    }

    /// Returns what [`Self::cut`] returns, slab by slab, for a ray that runs along one.
    #[cold]
    #[inline(never)]
    fn cut_one_by_one(&self, ray: &Ray<T>, is_certified: bool) -> Option<[(T, u32); 2]> {
        let (mut enter, mut leave) = ((-T::INFINITY, 0), (T::INFINITY, 0));
        let mut is_certain = true;
        for axis in 0..3 {
            let (from, along) = (ray.origin[axis], ray.direction[axis]);
            if along == T::ZERO {
                if from < self.min[axis] || from > self.max[axis] {
                    return None;
                }
                continue;
            }
            let to_min = ((self.min[axis] - from) / along, face(axis, false));
            let to_max = ((self.max[axis] - from) / along, face(axis, true));
            let (first, last) = if along > T::ZERO { (to_min, to_max) } else { (to_max, to_min) };
            is_certain &= apart(first.0, enter.0) & apart(last.0, leave.0);
            enter = if first.0 > enter.0 { first } else { enter };
            leave = if last.0 < leave.0 { last } else { leave };
        }
        let is_one_slab = enter.1 / 2 == leave.1 / 2;
        if is_certified && !(is_certain && (is_one_slab || apart(enter.0, leave.0))) {
            return settle::cuboid(&self.min, &self.max, ray);
        }
        (enter.0 <= leave.0).then_some([enter, leave])
    }

    /// Returns the normal at `point` of a face. [rule 15]
    #[inline(always)]
    pub(super) fn normal_at<R: RuleSource>(rules: R, point: Vec3<T>, part: u32) -> Vec3<T> {
        match rules.get().box_normal {
            BoxNormal::Outwards => Self::normal(part),
            BoxNormal::Inwards => -Self::normal(part),
            BoxNormal::FromOrigin => {
                let (size, most) = (point.abs(), point.abs().max_element());
                let axis = (0..3).find(|axis| size[*axis] == most).unwrap_or(0);
                if point[axis] < T::ZERO { -Vec3::axis(axis) } else { Vec3::axis(axis) }
            }
        }
    }

    /// Returns the outward unit normal of a face: `part` is twice the axis, plus 1 for the greater
    /// of its two faces.
    pub fn normal(part: u32) -> Vec3<T> {
        let axis = Vec3::axis(part as usize / 2);
        if part % 2 == 1 { axis } else { -axis }
    }
}

/// Returns whether two parameters of faces differ by more than rounding, so that their order is
/// certain.
#[inline(always)]
fn apart<T: Real>(a: T, b: T) -> bool {
    (a - b).abs() > a.abs() * (T::of(4.0) * T::ULP) + T::ULP * T::SAFE[0]
}

fn face(axis: usize, is_max: bool) -> u32 {
    2 * axis as u32 + u32::from(is_max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    /// Checks a ray against the box 0 ≤ x ≤ 1, 0 ≤ y ≤ 2, 0 ≤ z ≤ 3.
    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<(f64, [f64; 3])>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let cuboid = Cuboid { min: vec([0.0; 3]), max: vec([1.0, 2.0, 3.0]) };
        let hit = cuboid.intersect(Lecture, &Ray::leaving(Lecture, vec(origin), vec(direction)));
        let found = hit.map(|m| (m.t, Cuboid::normal(m.part)));
        assert_eq!(
            found,
            expected.map(|(t, n)| (t, vec(n))),
            "from {origin:?} along {direction:?}"
        );
    }

    #[test]
    fn faces_worked_out_on_paper() {
        check([-1.0, 1.0, 1.0], [1.0, 0.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0])));
        check([0.5, 1.0, 1.0], [1.0, 0.0, 0.0], Some((0.5, [1.0, 0.0, 0.0]))); // from inside
        check([0.5, 5.0, 1.0], [0.0, -2.0, 0.0], Some((1.5, [0.0, 1.0, 0.0]))); // t in units of d
        check([0.5, 1.0, -4.0], [0.0, 0.0, 1.0], Some((4.0, [0.0, 0.0, -1.0])));
        check([-1.0, 3.0, 1.0], [1.0, 0.0, 0.0], None);
        check([2.0, 1.0, 1.0], [1.0, 0.0, 0.0], None); // behind
        // within the face y = 2
        check([-1.0, 2.0, 1.0], [1.0, 0.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0])));
        check([-1.0, 2.0, 1.0], [1.0, -0.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0])));
        // an edge: the lower axis
        check([-1.0, -1.0, 1.0], [1.0, 1.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0])));
        check([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0], Some((1.0, [-1.0, 0.0, 0.0]))); // a corner
        check([-1.0, -1.0, -0.5], [1.0, 1.0, 1.0], Some((1.0, [-1.0, 0.0, 0.0])));
        check([2.0, 3.0, 4.0], [-1.0, -1.0, -1.0], Some((1.0, [1.0, 0.0, 0.0])));
        check([0.5, -1.0, 1.0], [0.25, 1.0, 0.5], Some((1.0, [0.0, -1.0, 0.0])));
        check([0.5, 1.0, 1.0], [0.25, 0.25, 0.25], Some((2.0, [1.0, 0.0, 0.0]))); // from inside
        check([-1.0, 1.5, 1.0], [1.0, 1.0, 0.5], None);
        check([2.0, 1.0, 1.0], [1.0, 1.0, 1.0], None); // behind
    }
}
