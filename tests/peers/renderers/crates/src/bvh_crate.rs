//! bvh: its tree, single precision, children visited nearer first. It tests boxes alone; the
//! triangle test is the textbook's.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::ray::Ray;
use nalgebra::{Point3, Vector3};

use crate::Searcher;
use crate::input::Mesh;

struct Triangle {
    corners: [Point3<f32>; 3],
    node: usize,
}

impl Bounded<f32, 3> for Triangle {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.corners.iter().fold(Aabb::empty(), |all, corner| all.grow(corner))
    }
}

impl BHShape<f32, 3> for Triangle {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Triangle {
    /// Möller and Trumbore, both sides.
    fn intersect(&self, ray: &Ray<f32, 3>) -> f32 {
        let [a, b, c] = self.corners;
        let (ab, ac, from) = (b - a, c - a, ray.origin - a);
        let p = ray.direction.cross(&ac);
        let inverse = 1.0 / ab.dot(&p);
        let q = from.cross(&ab);
        let (u, v, t) =
            (from.dot(&p) * inverse, ray.direction.dot(&q) * inverse, ac.dot(&q) * inverse);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 { t } else { f32::INFINITY }
    }
}

pub struct Plain {
    tree: Bvh<f32, 3>,
    triangles: Vec<Triangle>,
}

pub fn build(mesh: Mesh) -> Plain {
    let corner = |i: u32| Point3::from(mesh.vertices[i as usize]);
    let triangles = mesh.triangles.iter().map(|all| Triangle { corners: all.map(corner), node: 0 });
    let mut triangles: Vec<Triangle> = triangles.collect();
    Plain { tree: Bvh::build(&mut triangles), triangles }
}

impl Searcher for Plain {
    #[inline(always)]
    fn trace(&self, ray: &[f32; 7], is_any_hit: bool) -> f32 {
        let [x, y, z, dx, dy, dz, length] = *ray;
        let ray = Ray::new(Point3::new(x, y, z), Vector3::new(dx, dy, dz));
        if is_any_hit {
            let mut hits = self
                .tree
                .traverse_iterator(&ray, &self.triangles)
                .map(|triangle| triangle.intersect(&ray));
            return hits.find(|t| *t < length).unwrap_or(f32::INFINITY);
        }
        let mut nearest = f32::INFINITY;
        for (triangle, (enter, _)) in
            self.tree.nearest_traverse_iterator(&ray, &self.triangles).map(with_box(&ray))
        {
            if enter > nearest {
                break;
            }
            nearest = nearest.min(triangle.intersect(&ray));
        }
        if nearest < length { nearest } else { f32::INFINITY }
    }

    fn bytes(&self) -> Option<usize> {
        Some(size_of_val(&*self.tree.nodes) + size_of_val(&*self.triangles))
    }
}

/// A triangle with the distances at which the ray enters and leaves its box.
fn with_box<'a>(ray: &Ray<f32, 3>) -> impl Fn(&'a Triangle) -> (&'a Triangle, (f32, f32)) {
    move |triangle| {
        (
            triangle,
            ray.intersection_slice_for_aabb(&triangle.aabb()).unwrap_or((0.0, f32::INFINITY)),
        )
    }
}
