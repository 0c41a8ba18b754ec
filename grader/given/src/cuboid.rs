//! The box. The file is called `cuboid` because `box` is a reserved word in Rust. Stage 01.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Returns the nearest hit of `ray` with the surface of the box `min` ≤ X ≤ `max`, or `None`.
/// [rule 15]
///
/// - `ray`, corners and hit are in the same frame. The direction may have any length but zero and
///   must not be normalised; some of its components may be 0. [rule 20]
/// - A ray that starts inside hits the side through which it leaves. [rule 2]
/// - The sides belong to the box: a ray that runs within a side hits the box where it reaches the
///   side.
/// - `normal` is one of ±x, ±y, ±z and points outwards, even if the ray starts inside. [rule 11]
pub fn intersect_box(ray: &Ray, min: DVec3, max: DVec3) -> Option<SurfaceHit> {
    todo!("intersect_box [rule 15]: src/cuboid.rs")
}
