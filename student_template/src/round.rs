//! Cylinder and cone, which are not part of the assignment. Given: nothing to write here.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Returns the nearest hit with x² + y² = radius², z in the closed range `ends`. Discs close it if
/// `capped`.
pub fn intersect_cylinder(
    ray: &Ray,
    radius: f64,
    ends: [f64; 2],
    capped: bool,
) -> Option<SurfaceHit> {
    intersect_cone(ray, [radius, radius], ends, capped)
}

/// Returns the nearest hit with a cone, whose radius changes linearly from `radii[0]` at `ends[0]`
/// to `radii[1]` at `ends[1]`. Discs close it if `capped`.
pub fn intersect_cone(
    ray: &Ray,
    radii: [f64; 2],
    ends: [f64; 2],
    capped: bool,
) -> Option<SurfaceHit> {
    let side = intersect_side(ray, radii, ends);
    let caps = if capped {
        [
            intersect_cap(ray, radii[0], ends[0], -DVec3::Z),
            intersect_cap(ray, radii[1], ends[1], DVec3::Z),
        ]
    } else {
        [None, None]
    };
    [side, caps[0], caps[1]].into_iter().flatten().min_by(|a, b| a.t.total_cmp(&b.t))
}

/// Intersects x² + y² = (r₀ + slope · (z − z₀))², a quadratic equation in t.
fn intersect_side(ray: &Ray, radii: [f64; 2], ends: [f64; 2]) -> Option<SurfaceHit> {
    let slope = (radii[1] - radii[0]) / (ends[1] - ends[0]);
    let radius_at = |z: f64| radii[0] + slope * (z - ends[0]);
    let (p, d) = (ray.origin, ray.direction);
    let (r, dr) = (radius_at(p.z), slope * d.z);
    let a = d.x * d.x + d.y * d.y - dr * dr;
    let half_b = p.x * d.x + p.y * d.y - r * dr;
    let c = p.x * p.x + p.y * p.y - r * r;
    let t = roots(a, half_b, c).into_iter().find(|&t| {
        let z = ray.at(t).z;
        ray.contains(t) && ends[0] <= z && z <= ends[1]
    })?;
    let q = ray.at(t);
    let tip = if slope < 0.0 { DVec3::Z } else { -DVec3::Z };
    Some(SurfaceHit { t, normal: DVec3::new(q.x, q.y, -slope * radius_at(q.z)).normalize_or(tip) })
}

/// Returns the roots of a t² + 2 `half_b` t + c, the lesser first. They are infinite if there are
/// none, so that they lie in no interval.
///
/// The root that would cancel is computed from the product of the two, which is c / a.
fn roots(a: f64, half_b: f64, c: f64) -> [f64; 2] {
    let discriminant = half_b * half_b - a * c;
    if discriminant < 0.0 {
        return [f64::INFINITY; 2];
    }
    let root = discriminant.sqrt();
    let q = if half_b < 0.0 { root - half_b } else { -root - half_b };
    let [one, two] = [q / a, c / q].map(|t| if t.is_nan() { f64::INFINITY } else { t });
    [one.min(two), one.max(two)]
}

fn intersect_cap(ray: &Ray, radius: f64, z: f64, normal: DVec3) -> Option<SurfaceHit> {
    let t = (z - ray.origin.z) / ray.direction.z;
    let q = ray.at(t);
    (radius > 0.0 && ray.contains(t) && q.x * q.x + q.y * q.y <= radius * radius)
        .then_some(SurfaceHit { t, normal })
}
