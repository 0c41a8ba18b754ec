//! One object: takes the ray to object space, intersects it with the object's shape, and brings the
//! hit back. Given: nothing to write here.

use cases::{Effect, Hit, Mesh, Object, Ray, Scene, Shape, SurfaceHit};
use glam::DVec3;

use crate::cuboid::intersect_box;
use crate::plane::{intersect_plane, intersect_square};
use crate::round::{intersect_cone, intersect_cylinder};
use crate::smooth::{barycentric, interpolate_normal};
use crate::sphere::intersect_sphere;
use crate::transform::{normal_to_world, ray_to_object};
use crate::triangle::intersect_triangle;

/// A hit with its two unit normals, both outwards; they differ only on smooth meshes. [rule 18]
struct TwoNormals {
    t: f64,
    n_geom: DVec3,
    n_shading: DVec3,
}

/// Returns the nearest hit of `ray` with the object of that index, or `None`, all in world space.
pub fn intersect_object(scene: &Scene, index: usize, ray: &Ray) -> Option<Hit> {
    let object = &scene.objects[index];
    let smooth = scene.effects.has(Effect::SmoothNormals);
    let hit = in_world(object, &scene.meshes, smooth, ray)?;
    Some(Hit {
        t: hit.t,
        point: ray.at(hit.t),
        n_geom: hit.n_geom,
        n_shading: hit.n_shading,
        object: index,
    })
}

/// Returns the nearest hit of a world-space `ray` with an `object` that is no mesh, or `None`.
pub fn intersect_transformed(object: &Object, ray: &Ray) -> Option<SurfaceHit> {
    in_world(object, &[], false, ray).map(|hit| SurfaceHit { t: hit.t, normal: hit.n_geom })
}

/// Intersects a world-space ray with an object. If the object's matrix is the identity, world space
/// is object space, so that stages 1 to 4 need no transform. [rule 20]
fn in_world(object: &Object, meshes: &[Mesh], smooth: bool, ray: &Ray) -> Option<TwoNormals> {
    if object.is_untransformed() {
        return in_object(&object.shape, meshes, smooth, ray);
    }
    let hit =
        in_object(&object.shape, meshes, smooth, &ray_to_object(ray, &object.object_from_world))?;
    let n_geom = normal_to_world(hit.n_geom, &object.object_from_world);
    let n_shading = if hit.n_shading == hit.n_geom {
        n_geom
    } else {
        normal_to_world(hit.n_shading, &object.object_from_world)
    };
    Some(TwoNormals { t: hit.t, n_geom, n_shading })
}

fn in_object(shape: &Shape, meshes: &[Mesh], smooth: bool, ray: &Ray) -> Option<TwoNormals> {
    let hit = match *shape {
        Shape::Sphere { center, radius } => intersect_sphere(ray, center, radius),
        Shape::Plane { normal, k } => intersect_plane(ray, normal, k),
        Shape::Square {} => intersect_square(ray),
        Shape::Box { min, max } => intersect_box(ray, min, max),
        Shape::Cylinder { radius, z_min, z_max, capped } => {
            intersect_cylinder(ray, radius, [z_min, z_max], capped)
        }
        Shape::Cone { bottom_radius, top_radius, z_min, z_max, capped } => {
            intersect_cone(ray, [bottom_radius, top_radius], [z_min, z_max], capped)
        }
        Shape::Mesh { mesh } => return intersect_mesh(&meshes[mesh], smooth, ray),
    };
    hit.map(|hit| TwoNormals { t: hit.t, n_geom: hit.normal, n_shading: hit.normal })
}

/// Tests every triangle in turn. Of two hits at equal t, the earlier triangle's counts. [rule 2]
/// [rule 16]
fn intersect_mesh(mesh: &Mesh, smooth: bool, ray: &Ray) -> Option<TwoNormals> {
    let mut nearest: Option<(SurfaceHit, [usize; 3])> = None;
    for triangle in &mesh.triangles {
        let corners = triangle.map(|corner| corner as usize);
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner]);
        if let Some(hit) = intersect_triangle(ray, a, b, c)
            && nearest.is_none_or(|(best, _)| hit.t < best.t)
        {
            nearest = Some((hit, corners));
        }
    }
    let (hit, corners) = nearest?;
    let n_shading = match &mesh.normals {
        Some(normals) if smooth => {
            let [a, b, c] = corners.map(|corner| mesh.vertices[corner]);
            interpolate_normal(
                barycentric(a, b, c, ray.at(hit.t)),
                corners.map(|corner| normals[corner]),
            )
        }
        _ => hit.normal,
    };
    Some(TwoNormals { t: hit.t, n_geom: hit.normal, n_shading })
}
