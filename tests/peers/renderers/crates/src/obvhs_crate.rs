//! obvhs: its binary tree of the medium quality, single precision.

use std::time::Duration;

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

use crate::Searcher;
use crate::input::Mesh;

pub struct Obvhs {
    tree: Bvh2,
    /// In the tree's order.
    triangles: Vec<Triangle>,
}

pub fn build(mesh: Mesh) -> Obvhs {
    let corner = |i: u32| Vec3A::from_array(mesh.vertices[i as usize]);
    let all = mesh.triangles.iter().map(|[a, b, c]| Triangle {
        v0: corner(*a),
        v1: corner(*b),
        v2: corner(*c),
    });
    let all: Vec<Triangle> = all.collect();
    let tree = build_bvh2_from_tris(&all, BvhBuildParams::medium_build(), &mut Duration::default());
    let triangles = tree.primitive_indices.iter().map(|i| all[*i as usize]).collect();
    Obvhs { tree, triangles }
}

impl Searcher for Obvhs {
    #[inline(always)]
    fn trace(&self, ray: &[f32; 7], is_any_hit: bool) -> f32 {
        let [x, y, z, dx, dy, dz, length] = *ray;
        let ray = Ray::new(Vec3A::new(x, y, z), Vec3A::new(dx, dy, dz), 0.0, length);
        let test = |ray: &Ray, i: usize| self.triangles[i].intersect(ray);
        if is_any_hit {
            return if self.tree.ray_traverse_miss(ray, test) { f32::INFINITY } else { 0.0 };
        }
        let mut hit = RayHit::none();
        if self.tree.ray_traverse(ray, &mut hit, test) { hit.t } else { f32::INFINITY }
    }

    fn bytes(&self) -> Option<usize> {
        Some(size_of_val(&*self.tree.nodes) + size_of_val(&*self.triangles))
    }
}
