//! The triangle. Stage 01.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Returns the hit of `ray` with the triangle `a`, `b`, `c`, or `None`. [rule 16]
///
/// - Corners, ray and hit are in the same frame. The direction may have any length but zero and
///   must not be normalised. [rule 20]
/// - `normal` is the unit vector along (B − A) × (C − A), whichever side the ray comes from: both
///   sides can be hit. [rule 11]
/// - Edges and corners belong to the triangle.
/// - A triangle without area is never hit, and neither is one that the ray is parallel to. Both are
///   decided by an exact 0: a tiny triangle is still a triangle.
/// - t counts iff `ray.contains` it. [rule 2]
pub fn intersect_triangle(ray: &Ray, a: DVec3, b: DVec3, c: DVec3) -> Option<SurfaceHit> {
    let n = (b - a).cross(c - a);
    let n_dot_d = n.dot(ray.direction);
    if n_dot_d == 0.0 {
        return None;
    }
    let t = n.dot(a - ray.origin) / n_dot_d;
    let q = ray.at(t);
    let is_inside = is_left_of(a, b, q, n) && is_left_of(b, c, q, n) && is_left_of(c, a, q, n);
    (ray.contains(t) && is_inside).then(|| SurfaceHit { t, normal: n.normalize() })
}

/// Returns whether `q` lies to the left of, or on, the edge from `a` to `b`, seen from the side to
/// which `n` points. [rule 16]
fn is_left_of(a: DVec3, b: DVec3, q: DVec3, n: DVec3) -> bool {
    (b - a).cross(q - a).dot(n) >= 0.0
}
