//! Between world space and an object's own space. Stage 05.

use cases::Ray;
use glam::{DAffine3, DVec3};

/// Returns the same ray in object space. [rule 20]
///
/// - `ray` is in world space, `object_from_world` is M⁻¹.
/// - The origin is a point and moves with the translation; the direction is a vector and does not.
/// - The direction is *not* normalised, and the interval stays as it is, so that t means the same
///   point in both spaces.
pub fn ray_to_object(ray: &Ray, object_from_world: &DAffine3) -> Ray {
    Ray {
        origin: object_from_world.transform_point3(ray.origin),
        direction: object_from_world.transform_vector3(ray.direction),
        t_min: ray.t_min,
        t_max: ray.t_max,
    }
}

/// Returns the world-space normal N along A⁻ᵀ N′, a unit vector. [rule 20]
///
/// - `normal` is N′, a unit normal in object space; `object_from_world` is M⁻¹, whose linear part
///   is A⁻¹.
/// - A N′ would be right for rotations and uniform scaling only.
/// - An outward normal stays outward, even if M mirrors.
pub fn normal_to_world(normal: DVec3, object_from_world: &DAffine3) -> DVec3 {
    (object_from_world.matrix3.transpose() * normal).normalize()
}
