//! Meshes: triangles with a tree over them, and the normals at their corners. [rule 16] [rule 18]

mod packet_triangles;
mod repeats;

use std::ops::Range;

use rayon::prelude::*;

use crate::bvh::{Bvh, Search, Visit, VisitCounter};
use crate::lanes::{LaneTests, Lanes, TriangleRay};
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{Interpolation, RuleSource, Weights};
use crate::shapes::{self, ShapeHit, Shear, Triangle, on_triangle};
use crate::world::triangles::Triangles;

/// A mesh in object space.
#[derive(Clone, Debug)]
pub struct Mesh<T> {
    /// The triangles with area, in the order of the tree; the others are never hit. A tree holds no
    /// triangle that repeats an earlier one.
    triangles: Triangles,
    /// The numbers of these triangles in the mesh. Where a leaf of four has room for more, the
    /// number of its last triangle is repeated.
    numbers: Vec<u32>,
    /// The normals, where the mesh has any.
    normals: Option<Normals<T>>,
    tree: Option<Bvh>,
    bounds: Bounds<T>,
}

/// The normals at the vertices of a mesh.
#[derive(Clone, Debug)]
struct Normals<T> {
    /// The normals, in the order in which the triangles first need them, so that neighbours share
    /// cache lines.
    list: Vec<Vec3<T>>,
    /// For each triangle, the indices of the normals at its corners.
    corners: Vec<[u32; 3]>,
}

impl<T: Real> Mesh<T> {
    /// Returns the mesh of a scene in the precision `T`. Triangles without area are left out.
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
                let (tree, order) =
                    repeats::build_tree(&bounds, |n| triangle(&numbers[n as usize]));
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

    /// Returns the mesh, searched with another instruction set, which finds the same hits.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        Self { tree: self.tree.map(|tree| tree.with_lanes(lanes)), ..self }
    }

    /// Returns the first hit in the ray's interval, in object space; `None` for a miss. At one t
    /// the triangle that comes first in the mesh wins.
    ///
    /// The part of the hit is the place of the triangle in the order of the tree.
    pub fn intersect<R: RuleSource, Y: VisitCounter>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut Y,
    ) -> Option<ShapeHit<T>> {
        let mut first = None;
        self.each(ray, tally, FirstHit { leaf: Leaf::new(self, rules, ray), best: &mut first });
        first
    }

    /// Returns whether the ray hits anything in its interval; the first triangle found ends the
    /// search.
    pub fn is_hit<R: RuleSource, Y: VisitCounter>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut Y,
    ) -> bool {
        let mut is_hit = false;
        self.each(ray, tally, AnyHit { leaf: Leaf::new(self, rules, ray), is_hit: &mut is_hit });
        is_hit
    }

    /// Calls `visitor` for every triangle that the ray may hit before the limit.
    #[inline(always)]
    fn each<Y: VisitCounter>(&self, ray: &Ray<T>, tally: &mut Y, mut visitor: impl Visit<T, Y>) {
        match &self.tree {
            Some(tree) => tree.walk(ray, tally, visitor),
            None => {
                (0..self.numbers.len() as u32).fold(ray.t_max, |limit, n| {
                    tally.primitive();
                    visitor.visit(tally, n, limit)
                });
            }
        }
    }

    #[inline(always)]
    fn is_earlier(&self, hit: ShapeHit<T>, other: ShapeHit<T>) -> bool {
        self.numbers[hit.part as usize] < self.numbers[other.part as usize]
    }

    /// Returns the hit point, in object space, with the triangle's own unit normal. [rule 16]
    pub fn place<R: RuleSource>(&self, rules: R, hit: &ShapeHit<T>) -> HitPoint<T> {
        let triangle = self.triangles.get(hit.part);
        on_triangle(&triangle.corners, hit.weights, triangle.normal(rules))
    }

    /// Returns the normals at the corners of the triangle that was hit; `None` for a flat mesh.
    #[inline(always)]
    pub fn corner_normals(&self, hit: &ShapeHit<T>) -> Option<[Vec3<T>; 3]> {
        let Normals { list, corners } = self.normals.as_ref()?;
        Some(corners[hit.part as usize].map(|i| list[i as usize]))
    }

    /// Returns whether a single triangle has an area.
    pub(crate) fn is_single(&self) -> bool {
        self.numbers.first().is_some_and(|first| self.numbers.iter().all(|n| n == first))
    }

    /// Returns the bytes that the mesh takes, its tree included.
    pub fn bytes(&self) -> usize {
        let of =
            |normals: &Normals<T>| size_of_val(&*normals.list) + size_of_val(&*normals.corners);
        let normals = self.normals.as_ref().map_or(0, of);
        let tree = self.tree.as_ref().map_or(0, Bvh::bytes);
        self.triangles.bytes() + size_of_val(&*self.numbers) + normals + tree
    }

    /// Returns the least box around the triangles with area, in object space; the empty box if
    /// there are none.
    pub fn bounds(&self) -> Bounds<T> {
        self.bounds
    }
}

impl<T: Real> Normals<T> {
    /// Returns the normals of the triangles with these numbers. Normals that none of them has are
    /// dropped.
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

/// A mesh and a ray that is tested against the triangles of its leaves.
struct Leaf<'a, T, R> {
    mesh: &'a Mesh<T>,
    rules: R,
    ray: &'a Ray<T>,
    /// The shear of the ray, computed when the first triangle is tested.
    shear: Option<(Shear<T>, TriangleRay)>,
}

impl<'a, T: Real, R: RuleSource> Leaf<'a, T, R> {
    #[inline(always)]
    fn new(mesh: &'a Mesh<T>, rules: R, ray: &'a Ray<T>) -> Self {
        Self { mesh, rules, ray, shear: None }
    }

    #[inline(always)]
    fn shear(&mut self) -> &(Shear<T>, TriangleRay) {
        self.shear.get_or_insert_with(|| {
            let shear = Shear::of(self.ray).within(self.ray, self.mesh.bounds);
            (shear, shear.across(self.ray))
        })
    }

    #[inline(always)]
    fn intersect(&mut self, n: u32) -> Option<ShapeHit<T>> {
        let (shear, _) = *self.shear();
        self.mesh.triangles.get(n).intersect(self.rules, self.ray, &shear, n)
    }

    /// Returns a bit for each triangle of a leaf that the ray does not certainly miss.
    #[inline(always)]
    fn left<P: LaneTests>(&mut self, primitives: &Range<u32>) -> u32 {
        let all = (1 << primitives.len()) - 1;
        if !shapes::misses_certainly(self.rules) {
            return all;
        }
        let (_, across) = *self.shear();
        self.mesh.triangles.left::<P>(primitives.start, &across) & all
    }
}

/// A visitor that finds the first hit.
struct FirstHit<'a, T, R> {
    leaf: Leaf<'a, T, R>,
    best: &'a mut Option<ShapeHit<T>>,
}

impl<T: Real, R: RuleSource, Y> Visit<T, Y> for FirstHit<'_, T, R> {
    #[inline(always)]
    fn visit(&mut self, _: &mut Y, n: u32, limit: T) -> T {
        let mesh = self.leaf.mesh;
        match self.leaf.intersect(n) {
            Some(hit)
                if self
                    .best
                    .is_none_or(|b| hit.t < b.t || (hit.t == b.t && mesh.is_earlier(hit, b))) =>
            {
                *self.best = Some(hit);
                hit.t
            }
            _ => limit,
        }
    }

    #[inline(always)]
    fn left<P: LaneTests>(&mut self, primitives: &Range<u32>) -> u32 {
        self.leaf.left::<P>(primitives)
    }
}

/// A visitor that finds out whether there is a hit.
struct AnyHit<'a, T, R> {
    leaf: Leaf<'a, T, R>,
    is_hit: &'a mut bool,
}

impl<T: Real, R: RuleSource, Y> Visit<T, Y> for AnyHit<'_, T, R> {
    #[inline(always)]
    fn visit(&mut self, _: &mut Y, n: u32, limit: T) -> T {
        *self.is_hit = *self.is_hit || self.leaf.intersect(n).is_some();
        if *self.is_hit { -T::INFINITY } else { limit }
    }

    #[inline(always)]
    fn left<P: LaneTests>(&mut self, primitives: &Range<u32>) -> u32 {
        self.leaf.left::<P>(primitives)
    }
}

/// Returns α N_A + β N_B + γ N_C, normalised; `None` where the sum is zero. [rule 18]
pub fn interpolate<T: Real, R: RuleSource>(
    rules: R,
    weights: Vec3<T>,
    normals: [Vec3<T>; 3],
) -> Option<Vec3<T>> {
    let w = match rules.get().weights {
        Weights::Lecture => weights,
        Weights::Swapped => Vec3::new(weights.x, weights.z, weights.y),
        Weights::Rotated => Vec3::new(weights.z, weights.x, weights.y),
        Weights::FirstSwapped => Vec3::new(weights.y, weights.x, weights.z),
        Weights::Equal => Vec3::ONE * T::of(1.0 / 3.0),
    };
    let mixed = normals[0] * w.x + normals[1] * w.y + normals[2] * w.z;
    match rules.get().interpolation {
        Interpolation::Unit => (mixed.dot(mixed) > T::ZERO).then(|| mixed.normalised()),
        Interpolation::NotUnit => Some(mixed),
        Interpolation::Absent => None,
        Interpolation::FirstVertex => Some(normals[0]),
        Interpolation::Reversed => (mixed.dot(mixed) > T::ZERO).then(|| -mixed.normalised()),
        Interpolation::NearestVertex if w.x >= w.y && w.x >= w.z => Some(normals[0]),
        Interpolation::NearestVertex => Some(if w.y >= w.z { normals[1] } else { normals[2] }),
    }
}
