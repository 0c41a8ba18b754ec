// Smooth meshes: normals that are interpolated between the corners. Stage 06.
#include "functions.hpp"
#include "todo.hpp"

// Returns (α, β, γ), the weights of the corners `a`, `b`, `c` at a point `q` of their triangle.
// [rule 17]
//
// - All four are in the same frame; `q` lies in the plane of the triangle, up to rounding; the
//   triangle has an area.
// - α + β + γ = 1 and α a + β b + γ c = q. Outside the triangle, a weight is negative.
Vec3 barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q) {
    const Vec3 n = cross(b - a, c - a);
    // Twice the signed area of a triangle in the plane, times ‖n‖.
    const auto area = [&n](const Vec3& u, const Vec3& v, const Vec3& w) {
        return dot(cross(v - u, w - u), n);
    };
    return Vec3{area(q, b, c), area(a, q, c), area(a, b, q)} / area(a, b, c);
}

// Returns N̂: the normals of the three corners, weighted by (α, β, γ), then normalised. [rule 18]
//
// - The normals are unit vectors in the frame of the mesh, and so is the result. The weighted sum
//   is never the zero vector.
Vec3 interpolate_normal(const Vec3& weights, const std::array<Vec3, 3>& normals) {
    const auto& [a, b, c] = normals;
    return normalized(weights.x * a + weights.y * b + weights.z * c);
}

// Returns R where normals are interpolated: by the interpolated normal, unless that R would lead
// into the object. [rule 19]
//
// - All are unit vectors in world space. d points towards the surface, `n_geom` is turned against
//   it (d·N ≤ 0), and `n_shading` was turned together with it.
// - R must leave the surface: if R · `n_geom` ≤ 0, it is computed again with `n_geom`.
Vec3 smooth_reflect(const Vec3& direction, const Vec3& n_geom, const Vec3& n_shading) {
    const Vec3 smooth = reflect(direction, n_shading);
    return dot(smooth, n_geom) > 0.0 ? smooth : reflect(direction, n_geom);
}

// Returns T where normals are interpolated, or nothing for total internal reflection. [rule 19]
//
// - The vectors are as in `smooth_reflect`, and the indices as in `refract`.
// - The interpolated normal decides on total internal reflection and gives T. If that T does not
//   go through the surface (T · `n_geom` ≥ 0), both are decided again with `n_geom`.
// - If the interpolated normal faces away from the ray (d · `n_shading` ≥ 0), `n_geom` is used
//   from the start.
std::optional<Vec3> smooth_refract(const Vec3& direction, const Vec3& n_geom, const Vec3& n_shading,
                                   double eta_i, double eta_t) {
    if (dot(direction, n_shading) >= 0.0) {
        return refract(direction, n_geom, eta_i, eta_t);
    }
    const std::optional<Vec3> smooth = refract(direction, n_shading, eta_i, eta_t);
    if (smooth && dot(*smooth, n_geom) >= 0.0) {
        return refract(direction, n_geom, eta_i, eta_t);
    }
    return smooth;
}
