//! The box (a word that Rust keeps for itself). Stage 01.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Nearest hit of `ray` with the surface of the box `min` ≤ X ≤ `max`, or `None`. [rule 15]
///
/// - `ray`, corners and hit are in the same frame. The direction may have any length but zero and
///   is not to be normalised; some of its components may be 0. [rule 20]
/// - A ray that starts inside hits the side through which it leaves. [rule 2]
/// - The sides belong to the box: a ray that runs within one hits the box where it reaches it.
/// - `normal` is one of ±x, ±y, ±z and points outwards, from inside as well. [rule 11]
pub fn intersect_box(ray: &Ray, min: DVec3, max: DVec3) -> Option<SurfaceHit> {
    todo!("intersect_box [rule 15]: src/cuboid.rs")
}
