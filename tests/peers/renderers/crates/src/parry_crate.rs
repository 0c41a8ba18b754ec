//! parry3d: its mesh, single precision. It has no any-hit query.

use parry3d::math::Vector;
use parry3d::query::{Ray, RayCast};
use parry3d::shape::TriMesh;

use crate::Searcher;
use crate::input::Mesh;

pub struct Parry(TriMesh);

pub fn build(mesh: Mesh) -> Parry {
    let vertices = mesh.vertices.into_iter().map(|[x, y, z]| Vector::new(x, y, z)).collect();
    Parry(TriMesh::new(vertices, mesh.triangles).expect("the mesh is valid"))
}

impl Searcher for Parry {
    #[inline(always)]
    fn trace(&self, ray: &[f32; 7], _is_any_hit: bool) -> f32 {
        let [x, y, z, dx, dy, dz, length] = *ray;
        let ray = Ray::new(Vector::new(x, y, z), Vector::new(dx, dy, dz));
        self.0.cast_local_ray(&ray, length.min(f32::MAX), false).unwrap_or(f32::INFINITY)
    }

    fn bytes(&self) -> Option<usize> {
        Some(self.0.total_memory_size())
    }
}
