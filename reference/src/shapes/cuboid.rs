//! The box. [rule 15]

use super::Meeting;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::{BoxRoots, RuleSource};
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
        let (mut enter, mut leave) = ((-T::INFINITY, 0), (T::INFINITY, 0));
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
            enter = if first.0 > enter.0 { first } else { enter };
            leave = if last.0 < leave.0 { last } else { leave };
        }
        if enter.0 > leave.0 {
            return None;
        }
        let met = [enter, leave].into_iter().find(|(t, _)| ray.contains(*t))?;
        if rules.get().box_roots == BoxRoots::NearOnly && met != enter {
            return None;
        }
        Some(Meeting::with(met.0, met.1))
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
