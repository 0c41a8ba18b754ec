//! Triangles with a tree over them, and the normals at their corners. [rule 16] [rule 18]

mod repeats;
mod together;

use std::ops::Range;

use rayon::prelude::*;

use crate::bounds::Bounds;
use crate::bvh::{Across, Bvh, Lanes, Search, Tally, Test, Visit};
use crate::ray::{Ray, Spot};
use crate::real::Real;
use crate::rules::{Interpolation, RuleSource, Weights};
use crate::shapes::{self, Meeting, Shear, Triangle, on_triangle};
use crate::triangles::Triangles;
use crate::vec3::Vec3;

/// A mesh in object space.
#[derive(Clone, Debug)]
pub struct Mesh<T> {
    /// Those with area, in the order of the tree; the others are never hit. A tree holds no
    /// triangle that repeats an earlier one.
    triangles: Triangles,
    /// The mesh's own numbers of those, that of the last of a leaf also where a leaf of four has
    /// room for more.
    numbers: Vec<u32>,
    /// Where the mesh carries any.
    normals: Option<Normals<T>>,
    tree: Option<Bvh>,
    bounds: Bounds<T>,
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
        let triangle = |n: &u32| Triangle {
            corners: mesh.triangles[*n as usize].map(|i| vertices[i as usize]),
        };
        let all = 0..mesh.triangles.len() as u32;
        let numbers: Vec<u32> = all.into_par_iter().filter(|n| triangle(n).has_area()).collect();
        let bounds: Vec<_> =
            numbers.par_iter().map(|n| Bounds::around(triangle(n).corners)).collect();
        let (tree, numbers) = match search {
            Search::Scan => (None, numbers),
            Search::Tree => {
                let (tree, order) = repeats::plant(&bounds, |n| triangle(&numbers[n as usize]));
                (Some(tree), order.into_iter().map(|n| numbers[n as usize]).collect())
            }
        };
        Self {
            triangles: Triangles::of(&numbers, triangle),
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
    pub fn meet<R: RuleSource, Y: Tally>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut Y,
    ) -> Option<Meeting<T>> {
        let mut first = None;
        self.each(ray, tally, First { asked: Asked::new(self, rules, ray), best: &mut first });
        first
    }

    /// Whether anything is met in the ray's interval; the first triangle found ends the search.
    pub fn is_met<R: RuleSource, Y: Tally>(&self, rules: R, ray: &Ray<T>, tally: &mut Y) -> bool {
        let mut is_met = false;
        self.each(ray, tally, Any { asked: Asked::new(self, rules, ray), is_met: &mut is_met });
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
        let of =
            |normals: &Normals<T>| size_of_val(&*normals.list) + size_of_val(&*normals.corners);
        let normals = self.normals.as_ref().map_or(0, of);
        let tree = self.tree.as_ref().map_or(0, Bvh::bytes);
        self.triangles.bytes() + size_of_val(&*self.numbers) + normals + tree
    }

    /// The least box around it.
    pub fn bounds(&self) -> Bounds<T> {
        self.bounds
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

/// A mesh asked for what a ray meets.
struct Asked<'a, T, R> {
    mesh: &'a Mesh<T>,
    rules: R,
    ray: &'a Ray<T>,
    /// Worked out where the first triangle is asked.
    shear: Option<(Shear<T>, Across)>,
}

impl<'a, T: Real, R: RuleSource> Asked<'a, T, R> {
    #[inline(always)]
    fn new(mesh: &'a Mesh<T>, rules: R, ray: &'a Ray<T>) -> Self {
        Self { mesh, rules, ray, shear: None }
    }

    #[inline(always)]
    fn shear(&mut self) -> &(Shear<T>, Across) {
        self.shear.get_or_insert_with(|| {
            let shear = Shear::of(self.ray).within(self.ray, self.mesh.bounds);
            (shear, shear.across(self.ray))
        })
    }

    #[inline(always)]
    fn meet(&mut self, n: u32) -> Option<Meeting<T>> {
        let (shear, _) = *self.shear();
        self.mesh.triangles.get(n).meet(self.rules, self.ray, &shear, n)
    }

    /// A bit for each triangle of a leaf that the ray does not certainly miss.
    #[inline(always)]
    fn left<P: Test>(&mut self, things: &Range<u32>) -> u32 {
        let all = (1 << things.len()) - 1;
        if !shapes::misses_certainly(self.rules) {
            return all;
        }
        let (_, across) = *self.shear();
        self.mesh.triangles.left::<P>(things.start, &across) & all
    }
}

/// Looks for the first meeting.
struct First<'a, T, R> {
    asked: Asked<'a, T, R>,
    best: &'a mut Option<Meeting<T>>,
}

impl<T: Real, R: RuleSource, Y> Visit<T, Y> for First<'_, T, R> {
    #[inline(always)]
    fn visit(&mut self, _: &mut Y, n: u32, limit: T) -> T {
        let mesh = self.asked.mesh;
        match self.asked.meet(n) {
            Some(met)
                if self
                    .best
                    .is_none_or(|b| met.t < b.t || (met.t == b.t && mesh.is_earlier(met, b))) =>
            {
                *self.best = Some(met);
                met.t
            }
            _ => limit,
        }
    }

    #[inline(always)]
    fn left<P: Test>(&mut self, things: &Range<u32>) -> u32 {
        self.asked.left::<P>(things)
    }
}

/// Looks for any meeting.
struct Any<'a, T, R> {
    asked: Asked<'a, T, R>,
    is_met: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y> Visit<T, Y> for Any<'_, T, R> {
    #[inline(always)]
    fn visit(&mut self, _: &mut Y, n: u32, limit: T) -> T {
        *self.is_met = *self.is_met || self.asked.meet(n).is_some();
        if *self.is_met { -T::INFINITY } else { limit }
    }

    #[inline(always)]
    fn left<P: Test>(&mut self, things: &Range<u32>) -> u32 {
        self.asked.left::<P>(things)
    }
}

/// α N_A + β N_B + γ N_C, normalised; `None` where it is zero. [rule 18]
pub fn interpolate<T: Real, R: RuleSource>(
    rules: R,
    weights: Vec3<T>,
    normals: [Vec3<T>; 3],
) -> Option<Vec3<T>> {
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
