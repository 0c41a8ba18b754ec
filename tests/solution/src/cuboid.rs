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
    // The ray is in the box while it is between the two sides of each of the three pairs: from the
    // last entry to the first exit.
    let (mut entry, mut entry_axis) = (f64::NEG_INFINITY, 0);
    let (mut exit, mut exit_axis) = (f64::INFINITY, 0);
    for axis in 0..3 {
        let (p, d) = (ray.origin[axis], ray.direction[axis]);
        if d == 0.0 {
            if p < min[axis] || max[axis] < p {
                return None;
            }
            continue;
        }
        let (near_side, far_side) =
            if d > 0.0 { (min[axis], max[axis]) } else { (max[axis], min[axis]) };
        let (near, far) = ((near_side - p) / d, (far_side - p) / d);
        if near > entry {
            (entry, entry_axis) = (near, axis);
        }
        if far < exit {
            (exit, exit_axis) = (far, axis);
        }
    }
    if entry > exit {
        None
    } else if ray.contains(entry) {
        Some(SurfaceHit { t: entry, normal: -along(ray, entry_axis) })
    } else if ray.contains(exit) {
        Some(SurfaceHit { t: exit, normal: along(ray, exit_axis) })
    } else {
        None
    }
}

/// Returns the unit vector of an axis, in the direction in which the ray runs along it.
fn along(ray: &Ray, axis: usize) -> DVec3 {
    DVec3::AXES[axis] * ray.direction[axis].signum()
}
