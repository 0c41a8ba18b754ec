//! Triangles with a tree over them, and the normals at their corners. [rule 16] [rule 18]

use rayon::prelude::*;

use crate::bounds::Bounds;
use crate::bvh::{Bvh, Lanes, Tally, Visit};
use crate::ray::{Ray, Spot};
use crate::real::Real;
use crate::rules::{Interpolation, RuleSource, Weights};
use crate::shapes::{Meeting, Shear, Triangle, on_triangle};
use crate::vec3::Vec3;
use crate::world::Search;

/// A mesh in object space.
#[derive(Clone, Debug)]
pub struct Mesh<T> {
    /// Those with area, in the order of the tree; the others are never met.
    triangles: Triangles<T>,
    /// The mesh's own numbers of those.
    numbers: Vec<u32>,
    /// Where the mesh carries any.
    normals: Option<Normals<T>>,
    tree: Option<Bvh<T>>,
    bounds: Bounds<T>,
}

/// Triangles, each with corners of its own, so that those of a leaf lie side by side.
#[derive(Clone, Debug)]
enum Triangles<T> {
    /// Where single precision holds every coordinate exactly, as those of most files are.
    Single(Vec<Triangle<f32>>),
    Full(Vec<Triangle<T>>),
}

/// Normals at vertices.
#[derive(Clone, Debug)]
struct Normals<T> {
    /// In the order in which the triangles first need them, so that neighbours share cache lines.
    list: Vec<Vec3<T>>,
    /// Which of them each triangle has at its corners.
    corners: Vec<[u32; 3]>,
}

impl<T: Real> Mesh<T> {
    /// The mesh of a scene, in the precision `T`.
    pub fn of(mesh: &cases::Mesh, search: Search) -> Self {
        let vertices: Vec<Vec3<T>> = mesh.vertices.par_iter().map(|v| Vec3::of(*v)).collect();
        let triangle = |n: &u32| Triangle { corners: mesh.triangles[*n as usize].map(|i| vertices[i as usize]) };
        let all = 0..mesh.triangles.len() as u32;
        let numbers: Vec<u32> = all.into_par_iter().filter(|n| triangle(n).has_area()).collect();
        let bounds: Vec<_> = numbers.par_iter().map(|n| Bounds::around(triangle(n).corners)).collect();
        let (tree, numbers) = match search {
            Search::Scan => (None, numbers),
            Search::Tree => {
                let (tree, order) = Bvh::build(&bounds);
                (Some(tree), order.into_iter().map(|n| numbers[n as usize]).collect())
            }
        };
        Self {
            triangles: Triangles::of(numbers.par_iter().map(triangle).collect()),
            normals: mesh.normals.as_ref().map(|list| Normals::of(list, &mesh.triangles, &numbers)),
            numbers,
            tree,
            bounds: bounds.iter().fold(Bounds::empty(), |all, one| all.join(*one)),
        }
    }

    /// The mesh searched by other instructions, which find the same.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        Self { tree: self.tree.map(|tree| tree.with_lanes(lanes)), ..self }
    }

    /// The first meeting in the ray's interval; at one t the lower index wins.
    pub fn meet<R: RuleSource, Y: Tally>(&self, rules: R, ray: &Ray<T>, tally: &mut Y) -> Option<Meeting<T>> {
        let shear = Shear::of(ray).within(ray, self.bounds);
        let mut first = None;
        self.each(ray, tally, First { mesh: self, rules, ray, shear, best: &mut first });
        first
    }

    /// Whether anything is met in the ray's interval; the first triangle found ends the search.
    pub fn is_met<R: RuleSource, Y: Tally>(&self, rules: R, ray: &Ray<T>, tally: &mut Y) -> bool {
        let shear = Shear::of(ray).within(ray, self.bounds);
        let mut is_met = false;
        self.each(ray, tally, Any { mesh: self, rules, ray, shear, is_met: &mut is_met });
        is_met
    }

    /// Has every triangle visited that the ray may meet before the limit.
    #[inline(always)]
    fn each<Y: Tally>(&self, ray: &Ray<T>, tally: &mut Y, mut visitor: impl Visit<T, Y>) {
        match &self.tree {
            Some(tree) => tree.walk(ray, tally, visitor),
            None => {
                (0..self.numbers.len() as u32).fold(ray.t_max, |limit, n| {
                    tally.thing();
                    visitor.visit(tally, n, limit)
                });
            }
        }
    }

    #[inline(always)]
    fn is_earlier(&self, met: Meeting<T>, other: Meeting<T>) -> bool {
        self.numbers[met.part as usize] < self.numbers[other.part as usize]
    }

    /// The place of a meeting, with the triangle's own unit normal. [rule 16]
    pub fn place<R: RuleSource>(&self, rules: R, met: &Meeting<T>) -> Spot<T> {
        let triangle = self.triangles.get(met.part);
        on_triangle(&triangle.corners, met.weights, triangle.normal(rules))
    }

    /// The normals at the corners of the triangle that was met; `None` on a flat mesh.
    #[inline(always)]
    pub fn corner_normals(&self, met: &Meeting<T>) -> Option<[Vec3<T>; 3]> {
        let Normals { list, corners } = self.normals.as_ref()?;
        Some(corners[met.part as usize].map(|i| list[i as usize]))
    }

    /// Bytes it takes, its tree included.
    pub fn bytes(&self) -> usize {
        let of = |normals: &Normals<T>| size_of_val(&*normals.list) + size_of_val(&*normals.corners);
        let normals = self.normals.as_ref().map_or(0, of);
        let tree = self.tree.as_ref().map_or(0, Bvh::bytes);
        self.triangles.bytes() + size_of_val(&*self.numbers) + normals + tree
    }

    /// The least box around it.
    pub fn bounds(&self) -> Bounds<T> {
        self.bounds
    }
}

impl<T: Real> Triangles<T> {
    fn of(triangles: Vec<Triangle<T>>) -> Self {
        let single = |x: T| x.f64() as f32;
        let is_single = |x: T| f64::from(single(x)) == x.f64();
        let fits = |triangle: &Triangle<T>| {
            triangle.corners.iter().all(|c| is_single(c.x) && is_single(c.y) && is_single(c.z))
        };
        if size_of::<T>() == size_of::<f32>() || !triangles.par_iter().all(fits) {
            return Self::Full(triangles);
        }
        let corner = |c: Vec3<T>| Vec3::new(single(c.x), single(c.y), single(c.z));
        Self::Single(triangles.par_iter().map(|triangle| Triangle { corners: triangle.corners.map(corner) }).collect())
    }

    #[inline(always)]
    fn get(&self, n: u32) -> Triangle<T> {
        let full = |x: f32| T::of(f64::from(x));
        match self {
            Self::Full(triangles) => triangles[n as usize],
            Self::Single(triangles) => {
                let corner = |c: Vec3<f32>| Vec3::new(full(c.x), full(c.y), full(c.z));
                let [a, b, c] = triangles[n as usize].corners;
                Triangle { corners: [corner(a), corner(b), corner(c)] }
            }
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Single(triangles) => size_of_val(&**triangles),
            Self::Full(triangles) => size_of_val(&**triangles),
        }
    }
}

impl<T: Real> Normals<T> {
    /// Those of the triangles with these numbers; normals that none of them has go.
    fn of(list: &[glam::DVec3], triangles: &[[u32; 3]], numbers: &[u32]) -> Self {
        const UNSEEN: u32 = u32::MAX;
        let mut corners: Vec<[u32; 3]> = numbers.iter().map(|n| triangles[*n as usize]).collect();
        let mut places = vec![UNSEEN; list.len()];
        let mut sorted = Vec::with_capacity(list.len());
        for i in corners.as_flattened_mut() {
            let place = &mut places[*i as usize];
            if *place == UNSEEN {
                *place = sorted.len() as u32;
                sorted.push(Vec3::of(list[*i as usize]));
            }
            *i = *place;
        }
        Self { list: sorted, corners }
    }
}

/// Looks for the first meeting.
struct First<'a, T, R> {
    mesh: &'a Mesh<T>,
    rules: R,
    ray: &'a Ray<T>,
    shear: Shear<T>,
    best: &'a mut Option<Meeting<T>>,
}

impl<T: Real, R: RuleSource, Y> Visit<T, Y> for First<'_, T, R> {
    #[inline(always)]
    fn visit(&mut self, _: &mut Y, n: u32, limit: T) -> T {
        match self.mesh.triangles.get(n).meet(self.rules, self.ray, &self.shear, n) {
            Some(met) if self.best.is_none_or(|b| met.t < b.t || (met.t == b.t && self.mesh.is_earlier(met, b))) => {
                *self.best = Some(met);
                met.t
            }
            _ => limit,
        }
    }
}

/// Looks for any meeting.
struct Any<'a, T, R> {
    mesh: &'a Mesh<T>,
    rules: R,
    ray: &'a Ray<T>,
    shear: Shear<T>,
    is_met: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y> Visit<T, Y> for Any<'_, T, R> {
    #[inline(always)]
    fn visit(&mut self, _: &mut Y, n: u32, limit: T) -> T {
        *self.is_met = *self.is_met || self.mesh.triangles.get(n).meet(self.rules, self.ray, &self.shear, n).is_some();
        if *self.is_met { -T::INFINITY } else { limit }
    }
}

/// α N_A + β N_B + γ N_C, normalised; `None` where it is zero. [rule 18]
pub fn interpolate<T: Real, R: RuleSource>(rules: R, weights: Vec3<T>, normals: [Vec3<T>; 3]) -> Option<Vec3<T>> {
    let w = match rules.get().weights {
        Weights::Lecture => weights,
        Weights::Swapped => Vec3::new(weights.x, weights.z, weights.y),
        Weights::Rotated => Vec3::new(weights.z, weights.x, weights.y),
    };
    let mixed = normals[0] * w.x + normals[1] * w.y + normals[2] * w.z;
    match rules.get().interpolation {
        Interpolation::Unit => (mixed.dot(mixed) > T::ZERO).then(|| mixed.normalised()),
        Interpolation::NotUnit => Some(mixed),
        Interpolation::Absent => None,
        Interpolation::NearestVertex if w.x >= w.y && w.x >= w.z => Some(normals[0]),
        Interpolation::NearestVertex => Some(if w.y >= w.z { normals[1] } else { normals[2] }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(x: f64, is_single: bool) {
        let corners = [[x, 0.0, -0.0], [1.0, 2.5, 0.0], [0.0, 1.0, f64::from(f32::MIN_POSITIVE)]]
            .map(|[x, y, z]| Vec3::new(x, y, z));
        let triangles = Triangles::of(vec![Triangle { corners }]);
        assert_eq!(matches!(triangles, Triangles::Single(_)), is_single, "{x}");
        let bits = |corners: [Vec3<f64>; 3]| corners.map(|c| [c.x, c.y, c.z].map(f64::to_bits));
        assert_eq!(bits(triangles.get(0).corners), bits(corners), "{x}");
    }

    #[test]
    fn corners_keep_every_bit() {
        check(0.5, true);
        check(16_777_216.0, true);
        check(16_777_217.0, false);
        check(0.1, false);
        check(1e300, false);
        check(1e-300, false);
    }
}
