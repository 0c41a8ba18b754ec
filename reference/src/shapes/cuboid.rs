//! The box. [rule 15]

use super::{Meeting, settle};
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::{BoxRoots, Robustness, RuleSource};
use crate::vec3::Vec3;

/// min ≤ X ≤ max, whose surface is met.
#[derive(Clone, Copy, Debug)]
pub struct Cuboid<T> {
    /// Least corner.
    pub min: Vec3<T>,
    /// Greatest corner.
    pub max: Vec3<T>,
}

impl<T: Real> Cuboid<T> {
    /// The first meeting in the ray's interval: where the ray enters, or where it leaves if the entry does not count.
    ///
    /// The slabs of the three axes are cut with one another. A ray that runs along a slab is inside or outside of it all
    /// along; to run within a face is to be inside. On an edge the face of the lower axis is met.
    #[inline(always)]
    pub fn meet<R: RuleSource>(&self, rules: R, ray: &Ray<T>) -> Option<Meeting<T>> {
        let [enter, leave] = self.cut(ray, rules.get().style.robustness == Robustness::Certified)?;
        let met = [enter, leave].into_iter().find(|(t, _)| ray.contains(*t))?;
        if rules.get().box_roots == BoxRoots::NearOnly && met != enter {
            return None;
        }
        Some(Meeting::with(met.0, met.1))
    }

    /// Where the ray's line enters and where it leaves: t and the face.
    ///
    /// A t is off by a difference and a quotient, 2u of itself, u half a ulp: which of two is the greater is certain where they differ by more than
    /// 4u of either. 8u is asked for, and where that leaves an order open, the second step is taken.
    #[inline(always)]
    fn cut(&self, ray: &Ray<T>, is_certified: bool) -> Option<[(T, u32); 2]> {
        let apart = |a: T, b: T| (a - b).abs() > a.abs() * (T::of(4.0) * T::ULP) + T::ULP * T::SAFE[0];
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
            return settle::cuboid(self, ray);
        }
        (enter.0 <= leave.0).then_some([enter, leave])
    }

    /// The outward unit normal of a face.
    pub fn normal(part: u32) -> Vec3<T> {
        let axis = Vec3::axis(part as usize / 2);
        if part % 2 == 1 { axis } else { -axis }
    }
}

fn face(axis: usize, is_max: bool) -> u32 {
    2 * axis as u32 + u32::from(is_max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Lecture;

    /// With 0 ≤ x ≤ 1, 0 ≤ y ≤ 2, 0 ≤ z ≤ 3.
    fn check(origin: [f64; 3], direction: [f64; 3], expected: Option<(f64, [f64; 3])>) {
        let vec = |v: [f64; 3]| Vec3::new(v[0], v[1], v[2]);
        let cuboid = Cuboid { min: vec([0.0; 3]), max: vec([1.0, 2.0, 3.0]) };
        let met = cuboid.meet(Lecture, &Ray::leaving(Lecture, vec(origin), vec(direction)));
        let found = met.map(|m| (m.t, Cuboid::normal(m.part)));
        assert_eq!(found, expected.map(|(t, n)| (t, vec(n))), "from {origin:?} along {direction:?}");
    }

    #[test]
    fn faces_worked_out_on_paper() {
        check([-1.0, 1.0, 1.0], [1.0, 0.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0])));
        check([0.5, 1.0, 1.0], [1.0, 0.0, 0.0], Some((0.5, [1.0, 0.0, 0.0]))); // from inside
        check([0.5, 5.0, 1.0], [0.0, -2.0, 0.0], Some((1.5, [0.0, 1.0, 0.0]))); // t in units of d
        check([0.5, 1.0, -4.0], [0.0, 0.0, 1.0], Some((4.0, [0.0, 0.0, -1.0])));
        check([-1.0, 3.0, 1.0], [1.0, 0.0, 0.0], None);
        check([2.0, 1.0, 1.0], [1.0, 0.0, 0.0], None); // behind
        check([-1.0, 2.0, 1.0], [1.0, 0.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0]))); // within the face y = 2
        check([-1.0, 2.0, 1.0], [1.0, -0.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0])));
        check([-1.0, -1.0, 1.0], [1.0, 1.0, 0.0], Some((1.0, [-1.0, 0.0, 0.0]))); // an edge: the lower axis
    }
}
