//! Smooth meshes: normals that are interpolated between the corners. Stage 06.

use glam::DVec3;

use crate::reflection::reflect;
use crate::refraction::refract;

/// Returns (α, β, γ), the weights of the corners `a`, `b`, `c` at a point `q` of their triangle.
/// [rule 17]
///
/// - All four are in the same frame; `q` lies in the plane of the triangle, up to rounding; the
///   triangle has an area.
/// - α + β + γ = 1 and α a + β b + γ c = q. Outside the triangle, a weight is negative.
pub fn barycentric(a: DVec3, b: DVec3, c: DVec3, q: DVec3) -> DVec3 {
    let n = (b - a).cross(c - a);
    // Twice the signed area of a triangle in the plane, times ‖n‖.
    let area = |u: DVec3, v: DVec3, w: DVec3| (v - u).cross(w - u).dot(n);
    DVec3::new(area(q, b, c), area(a, q, c), area(a, b, q)) / area(a, b, c)
}

/// Returns N̂: the normals of the three corners, weighted by (α, β, γ), then normalised. [rule 18]
///
/// - The normals are unit vectors in the frame of the mesh, and so is the result. The weighted sum
///   is never the zero vector.
pub fn interpolate_normal(weights: DVec3, normals: [DVec3; 3]) -> DVec3 {
    let [a, b, c] = normals;
    (weights.x * a + weights.y * b + weights.z * c).normalize()
}

/// Returns R where normals are interpolated: by the interpolated normal, unless that R would lead
/// into the object. [rule 19]
///
/// - All are unit vectors in world space. d points towards the surface, `n_geom` is turned against
///   it (d·N ≤ 0), and `n_shading` was turned together with it.
/// - R must leave the surface: if R · `n_geom` ≤ 0, it is computed again with `n_geom`.
pub fn smooth_reflect(direction: DVec3, n_geom: DVec3, n_shading: DVec3) -> DVec3 {
    let smooth = reflect(direction, n_shading);
    if smooth.dot(n_geom) > 0.0 { smooth } else { reflect(direction, n_geom) }
}

/// Returns T where normals are interpolated, or `None` for total internal reflection. [rule 19]
///
/// - The vectors are as in `smooth_reflect`, and the indices as in `refract`.
/// - The interpolated normal decides on total internal reflection and gives T. If that T does not
///   go through the surface (T · `n_geom` ≥ 0), both are decided again with `n_geom`.
/// - If the interpolated normal faces away from the ray (d · `n_shading` ≥ 0), `n_geom` is used
///   from the start.
pub fn smooth_refract(
    direction: DVec3,
    n_geom: DVec3,
    n_shading: DVec3,
    eta_i: f64,
    eta_t: f64,
) -> Option<DVec3> {
    let geometric = || refract(direction, n_geom, eta_i, eta_t);
    if direction.dot(n_shading) >= 0.0 {
        return geometric();
    }
    let smooth = refract(direction, n_shading, eta_i, eta_t)?;
    if smooth.dot(n_geom) < 0.0 { Some(smooth) } else { geometric() }
}
