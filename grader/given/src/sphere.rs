//! The sphere. Stage 01.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Nearest hit of `ray` with the sphere ‖X − `center`‖ = `radius`, or `None`. [rule 14]
///
/// - `ray`, `center` and the hit are in the same frame. The ray's direction may have any length but
///   zero; it is *not* to be normalised, because `t` must hold for the ray as given. [rule 20]
/// - A root counts iff `ray.contains` it. The nearer one is tried first; where it does not count
///   (it lies behind, or the ray starts inside) the farther one answers. [rule 2]
/// - `normal` is a unit vector and points outwards, from inside as well. [rule 11]
/// - A grazing ray (double root) is one hit.
pub fn intersect_sphere(ray: &Ray, center: DVec3, radius: f64) -> Option<SurfaceHit> {
    todo!("intersect_sphere [rule 14]: src/sphere.rs")
}
