//! The sphere. Stage 01.

use cases::{Ray, SurfaceHit};
use glam::DVec3;

/// Returns the nearest hit of `ray` with the sphere ‖X − `center`‖ = `radius`, or `None`. [rule 14]
///
/// - `ray`, `center` and the hit are in the same frame. The ray's direction may have any length but
///   zero; it must *not* be normalised, because `t` must hold for the ray as given. [rule 20]
/// - A root counts iff `ray.contains` it. The nearer one is tried first. If it does not count (it
///   lies behind, or the ray starts inside), the farther one is tried. [rule 2]
/// - `normal` is a unit vector and points outwards, even if the ray starts inside. [rule 11]
/// - A grazing ray (double root) is one hit.
pub fn intersect_sphere(ray: &Ray, center: DVec3, radius: f64) -> Option<SurfaceHit> {
    let from_center = ray.origin - center;
    let a = ray.direction.length_squared();
    let half_b = from_center.dot(ray.direction);
    let c = from_center.length_squared() - radius * radius;
    let t = roots(a, half_b, c)?.into_iter().find(|&t| ray.contains(t))?;
    Some(SurfaceHit { t, normal: (ray.at(t) - center).normalize() })
}

/// Returns the roots of a t² + 2 `half_b` t + c, the lesser first, or `None` if they are not real.
/// [rule 14]
///
/// Only one of −b ± √D is computed, the one that does not cancel. The other root follows from their
/// product c / a.
fn roots(a: f64, half_b: f64, c: f64) -> Option<[f64; 2]> {
    let discriminant = half_b * half_b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let q = if half_b < 0.0 { root - half_b } else { -root - half_b };
    if q == 0.0 {
        return Some([0.0, 0.0]);
    }
    let (one, two) = (q / a, c / q);
    Some([one.min(two), one.max(two)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_small_root_keeps_its_digits() {
        // t² − 2·10⁸ t + 1 = 0 has the roots 10⁸ ± √(10¹⁶ − 1). The lesser one is 5·10⁻⁹, up to
        // 10⁻²⁵.
        let [near, far] = roots(1.0, -1e8, 1.0).unwrap();
        assert!((near / 5e-9 - 1.0).abs() < 1e-15, "{near}");
        assert_eq!(far, 2e8);
    }

    #[test]
    fn no_root_a_double_root_and_roots_at_zero() {
        assert_eq!(roots(1.0, 0.0, 1.0), None);
        assert_eq!(roots(1.0, -2.0, 4.0), Some([2.0, 2.0]));
        assert_eq!(roots(1.0, 0.0, 0.0), Some([0.0, 0.0]));
        assert_eq!(roots(4.0, -2.0, 0.0), Some([0.0, 1.0]));
    }
}
