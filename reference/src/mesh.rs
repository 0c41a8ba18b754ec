//! Triangles over shared vertices, with a tree over them. [rule 16] [rule 18]

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
    vertices: Vec<Vec3<T>>,
    /// One a vertex, where the mesh carries any.
    normals: Option<Vec<Vec3<T>>>,
    /// Corners of the triangles with area, in the order of the tree; the others are never met.
    faces: Vec<[u32; 3]>,
    /// The mesh's own numbers of those.
    numbers: Vec<u32>,
    tree: Option<Bvh<T>>,
    bounds: Bounds<T>,
}

impl<T: Real> Mesh<T> {
    /// The mesh of a scene, in the precision `T`.
    pub fn of(mesh: &cases::Mesh, search: Search) -> Self {
        let vectors = |list: &Vec<glam::DVec3>| list.par_iter().map(|v| Vec3::of(*v)).collect();
        let mut all = Self {
            vertices: vectors(&mesh.vertices),
            normals: mesh.normals.as_ref().map(vectors),
            faces: mesh.triangles.clone(),
            numbers: Vec::new(),
            tree: None,
            bounds: Bounds::empty(),
        };
        let numbers = 0..mesh.triangles.len() as u32;
        all.numbers = numbers.into_par_iter().filter(|n| all.triangle(*n).has_area()).collect();
        let bounds = |n: &u32| Bounds::around(all.triangle(*n).corners);
        let bounds: Vec<_> = all.numbers.par_iter().map(bounds).collect();
        all.bounds = bounds.iter().fold(Bounds::empty(), |all, one| all.join(*one));
        if search == Search::Tree {
            let (tree, order) = Bvh::build(&bounds);
            all.numbers = order.into_iter().map(|n| all.numbers[n as usize]).collect();
            all.tree = Some(tree);
        }
        all.faces = all.numbers.iter().map(|n| mesh.triangles[*n as usize]).collect();
        all.sort_vertices();
        all
    }

    /// Puts vertices in the order in which the triangles first need them, so that neighbours share cache lines; the others go.
    fn sort_vertices(&mut self) {
        const UNSEEN: u32 = u32::MAX;
        let mut places = vec![UNSEEN; self.vertices.len()];
        let mut order = Vec::with_capacity(self.vertices.len());
        for i in self.faces.as_flattened_mut() {
            let place = &mut places[*i as usize];
            if *place == UNSEEN {
                *place = order.len() as u32;
                order.push(*i);
            }
            *i = *place;
        }
        let sorted = |list: &Vec<Vec3<T>>| order.iter().map(|i| list[*i as usize]).collect();
        self.normals = self.normals.as_ref().map(sorted);
        self.vertices = sorted(&self.vertices);
    }

    /// The mesh searched by other instructions, which find the same.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        Self { tree: self.tree.map(|tree| tree.with_lanes(lanes)), ..self }
    }

    #[inline(always)]
    fn triangle(&self, n: u32) -> Triangle<T> {
        Triangle { corners: self.faces[n as usize].map(|i| self.vertices[i as usize]) }
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
                (0..self.faces.len() as u32).fold(ray.t_max, |limit, n| {
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
        let triangle = self.triangle(met.part);
        on_triangle(&triangle.corners, met.weights, triangle.normal(rules))
    }

    /// The normals at the corners of the triangle that was met; `None` on a flat mesh.
    #[inline(always)]
    pub fn corner_normals(&self, met: &Meeting<T>) -> Option<[Vec3<T>; 3]> {
        let normals = self.normals.as_ref()?;
        Some(self.faces[met.part as usize].map(|i| normals[i as usize]))
    }

    /// Bytes it takes, its tree included.
    pub fn bytes(&self) -> usize {
        let normals = self.normals.as_ref().map_or(0, |list| size_of_val(&**list));
        let tree = self.tree.as_ref().map_or(0, Bvh::bytes);
        size_of_val(&*self.vertices) + normals + size_of_val(&*self.faces) + size_of_val(&*self.numbers) + tree
    }

    /// The least box around it.
    pub fn bounds(&self) -> Bounds<T> {
        self.bounds
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
        match self.mesh.triangle(n).meet(self.rules, self.ray, &self.shear, n) {
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
        *self.is_met = *self.is_met || self.mesh.triangle(n).meet(self.rules, self.ray, &self.shear, n).is_some();
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
