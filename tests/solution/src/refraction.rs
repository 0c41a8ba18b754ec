//! Light through glass and water. Stage 04.

use cases::ray_tree::RayKind;
use cases::{Ray, Scene};
use glam::DVec3;

use crate::surface::Surface;
use crate::trace::{Path, trace};

/// Index of refraction of the air around every object. [rule 9]
pub const AIR_INDEX: f64 = 1.0003;

/// Returns (η_i, η_t): the index on the side of the ray, and on the other side. [rule 9]
///
/// - A ray that enters comes from air and goes into a material of that `index`. A ray that leaves
///   (`inside`) goes the other way.
pub fn indices(inside: bool, index: f64) -> (f64, f64) {
    if inside { (index, AIR_INDEX) } else { (AIR_INDEX, index) }
}

/// Returns T, the direction of the refracted ray, a unit vector, or `None` for total internal
/// reflection. [rule 8] [rule 10]
///
/// - `direction` d and `normal` N are unit vectors in the same frame; d points towards the surface,
///   and N is turned against it (d·N ≤ 0).
/// - η_i sin θ_i = η_t sin θ_t; T lies in the plane of d and N, on the other side of the surface.
/// - No ray is transmitted beyond the critical angle; exactly at it one is, along the surface.
/// - If both indices are equal, T = d.
pub fn refract(direction: DVec3, normal: DVec3, eta_i: f64, eta_t: f64) -> Option<DVec3> {
    let eta_ratio = eta_i / eta_t;
    let cos_i = -direction.dot(normal);
    let cos_t_squared = 1.0 - eta_ratio * eta_ratio * (1.0 - cos_i * cos_i);
    (cos_t_squared >= 0.0)
        .then(|| eta_ratio * direction + (eta_ratio * cos_i - cos_t_squared.sqrt()) * normal)
}

/// Returns the light that comes through the surface to the viewer: kt · trace(Q, T), or black if no
/// ray is transmitted. [rule 8]
///
/// - `at` is in world space: its point is Q, `at.inside` says on which side the ray is, and
///   `at.refracted_direction(eta_i, eta_t)` is T. Products are channel by channel.
/// - `path` is that of the ray that hit the surface; the refracted ray's is
///   `path.extended(RayKind::Refracted, kt)`.
/// - The function is called only if kt is not black and the ray `goes_on`.
pub fn refracted_light(scene: &Scene, at: &Surface, path: &Path) -> DVec3 {
    let kt = at.material.kt;
    let (eta_i, eta_t) = indices(at.inside, at.material.index);
    match at.refracted_direction(eta_i, eta_t) {
        Some(direction) => {
            let ray = Ray::new(at.point, direction);
            kt * trace(scene, &ray, &path.extended(RayKind::Refracted, kt))
        }
        None => DVec3::ZERO,
    }
}
