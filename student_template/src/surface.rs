//! The surface that a ray hit, as shading and new rays need it. Given: nothing to write here.

use cases::{Hit, Material, Ray, Scene};
use glam::DVec3;

use crate::reflection::reflect;
use crate::refraction::refract;
use crate::shade::facing_normal;
use crate::smooth::{smooth_reflect, smooth_refract};

/// A point on an object, seen along a ray; all in world space.
pub struct Surface<'a> {
    /// Q, the point where the ray hit the object.
    pub point: DVec3,
    /// d, the unit vector along which the ray came; the viewer lies along −d.
    pub direction: DVec3,
    /// Unit normal of the surface itself, turned against the ray. [rule 11]
    pub n_geom: DVec3,
    /// Unit normal for shading, turned along with `n_geom`. It differs from `n_geom` only on smooth
    /// meshes. [rule 18]
    pub n_shading: DVec3,
    /// Whether the ray came from inside the object. [rule 11]
    pub inside: bool,
    /// The material of the object.
    pub material: &'a Material,
}

impl<'a> Surface<'a> {
    /// Returns the surface that `ray` hit, with the normals turned against the ray. [rule 11]
    pub fn new(scene: &'a Scene, ray: &Ray, hit: &Hit) -> Self {
        let (n_geom, inside) = facing_normal(ray.direction, hit.n_geom);
        Self {
            point: hit.point,
            direction: ray.direction,
            n_geom,
            n_shading: if inside { -hit.n_shading } else { hit.n_shading },
            inside,
            material: &scene.materials[scene.objects[hit.object].material],
        }
    }

    /// Returns R, the unit direction of the reflected ray. [rule 7] [rule 19]
    pub fn reflected_direction(&self) -> DVec3 {
        if self.is_smooth() {
            smooth_reflect(self.direction, self.n_geom, self.n_shading)
        } else {
            reflect(self.direction, self.n_geom)
        }
    }

    /// Returns T, the unit direction of the refracted ray, or `None` for total internal reflection.
    /// [rule 8] [rule 10] [rule 19]
    pub fn refracted_direction(&self, eta_i: f64, eta_t: f64) -> Option<DVec3> {
        if self.is_smooth() {
            smooth_refract(self.direction, self.n_geom, self.n_shading, eta_i, eta_t)
        } else {
            refract(self.direction, self.n_geom, eta_i, eta_t)
        }
    }

    fn is_smooth(&self) -> bool {
        self.n_shading != self.n_geom
    }
}
