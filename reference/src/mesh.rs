//! Triangles over shared vertices, with a tree over them. [rule 16] [rule 18]

use crate::bounds::Bounds;
use crate::bvh::{Bvh, Tally};
use crate::ray::{Ray, Spot};
use crate::real::Real;
use crate::rules::{Interpolation, RuleSource, Weights};
use crate::shapes::{Meeting, Shear, Triangle, on_triangle};
use crate::vec3::Vec3;
use crate::world::Search;

/// A mesh in object space.
#[derive(Clone, Debug)]
pub struct Mesh<T> {
    triangles: Vec<Triangle<T>>,
    /// Three vertex normals a triangle, where the mesh carries any.
    normals: Option<Vec<[Vec3<T>; 3]>>,
    /// Triangles with area, in order; the others are never met.
    solid: Vec<u32>,
    tree: Option<Bvh<T>>,
    bounds: Bounds<T>,
}

impl<T: Real> Mesh<T> {
    /// The mesh of a scene, in the precision `T`.
    pub fn of(mesh: &cases::Mesh, search: Search) -> Self {
        let at = |corners: &[u32; 3], list: &[glam::DVec3]| corners.map(|i| Vec3::of(list[i as usize]));
        let triangle = |t: &[u32; 3]| Triangle { corners: at(t, &mesh.vertices) };
        let triangles: Vec<Triangle<T>> = mesh.triangles.iter().map(triangle).collect();
        let solid: Vec<u32> = (0..triangles.len() as u32).filter(|i| triangles[*i as usize].has_area()).collect();
        let bounds: Vec<_> = solid.iter().map(|i| Bounds::around(triangles[*i as usize].corners)).collect();
        Self {
            normals: mesh.normals.as_ref().map(|list| mesh.triangles.iter().map(|t| at(t, list)).collect()),
            tree: (search == Search::Tree).then(|| Bvh::build(&bounds)),
            bounds: bounds.into_iter().fold(Bounds::empty(), Bounds::join),
            triangles,
            solid,
        }
    }

    /// The first meeting in the ray's interval; at one t the lower index wins.
    pub fn meet<R: RuleSource, Y: Tally>(&self, rules: R, ray: &Ray<T>, tally: &mut Y) -> Option<Meeting<T>> {
        let shear = Shear::of(ray).within(ray, self.bounds);
        let mut best: Option<Meeting<T>> = None;
        let mut visit = |_: &mut Y, n: u32, limit: T| {
            let i = self.solid[n as usize];
            match self.triangles[i as usize].meet(rules, ray, &shear, i) {
                Some(met) if best.is_none_or(|b| met.t < b.t || (met.t == b.t && i < b.part)) => {
                    best = Some(met);
                    met.t
                }
                _ => limit,
            }
        };
        match &self.tree {
            Some(tree) => tree.walk(ray, tally, visit),
            None => (0..self.solid.len() as u32).for_each(|n| {
                tally.thing();
                visit(tally, n, ray.t_max);
            }),
        }
        best
    }

    /// The place of a meeting, with the triangle's own unit normal. [rule 16]
    pub fn place<R: RuleSource>(&self, rules: R, met: &Meeting<T>) -> Spot<T> {
        let triangle = &self.triangles[met.part as usize];
        on_triangle(&triangle.corners, met.weights, triangle.normal(rules))
    }

    /// The normals at the corners of the triangle that was met; `None` on a flat mesh.
    #[inline(always)]
    pub fn corner_normals(&self, met: &Meeting<T>) -> Option<[Vec3<T>; 3]> {
        self.normals.as_ref().map(|normals| normals[met.part as usize])
    }

    /// Bytes it takes, its tree included.
    pub fn bytes(&self) -> usize {
        let normals = self.normals.as_ref().map_or(0, |list| size_of_val(&**list));
        let tree = self.tree.as_ref().map_or(0, Bvh::bytes);
        size_of_val(&*self.triangles) + normals + size_of_val(&*self.solid) + tree
    }

    /// The least box around it.
    pub fn bounds(&self) -> Bounds<T> {
        self.bounds
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
