//! The plane and the square. Stage 01.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Returns the hit of `ray` with the plane N·X = `k`, or `None`. [rule 15]
///
/// - `normal` is N, a unit vector. It is also the normal of the hit, whichever side the ray comes
///   from. [rule 11]
/// - The ray's direction may have any length but zero and must not be normalised. [rule 20]
/// - t counts iff `ray.contains` it. [rule 2]
/// - If N·d = 0, the ray is parallel and misses, even if it lies in the plane. Only an exact 0 is
///   parallel: a nearly parallel ray hits far away.
pub fn intersect_plane(ray: &Ray, normal: DVec3, k: f64) -> Option<SurfaceHit> {
    let n_dot_d = normal.dot(ray.direction);
    if n_dot_d == 0.0 {
        return None;
    }
    let t = (k - normal.dot(ray.origin)) / n_dot_d;
    ray.contains(t).then_some(SurfaceHit { t, normal })
}

/// Returns the hit of `ray` with the unit square |x| ≤ 0.5, |y| ≤ 0.5, z = 0, or `None`. [rule 15]
///
/// - The ray and the hit are in the square's frame. The direction may have any length but zero.
///   [rule 20]
/// - The edges belong to the square. A ray in the plane of the square misses it.
/// - The normal is (0, 0, 1), whichever side the ray comes from. [rule 11]
pub fn intersect_square(ray: &Ray) -> Option<SurfaceHit> {
    let hit = intersect_plane(ray, DVec3::Z, 0.0)?;
    let q = ray.at(hit.t);
    (q.x.abs() <= 0.5 && q.y.abs() <= 0.5).then_some(hit)
}
