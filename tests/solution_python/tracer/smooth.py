"""Smooth meshes: normals that are interpolated between the corners. Stage 06."""

from tracer.reflection import reflect
from tracer.refraction import refract
from tracer.vec import Vec3


def barycentric(a, b, c, q):
    """Returns (α, β, γ) as a Vec3: the weights of the corners `a`, `b`, `c` at a point `q` of their
    triangle. [rule 17]

    - All four are in the same frame; `q` lies in the plane of the triangle, up to rounding; the
      triangle has an area.
    - α + β + γ = 1 and α a + β b + γ c = q. Outside the triangle, a weight is negative.
    """
    n = (b - a).cross(c - a)

    def area(u, v, w):
        """Returns twice the signed area of a triangle in the plane, times ‖n‖."""
        return (v - u).cross(w - u).dot(n)

    return Vec3(area(q, b, c), area(a, q, c), area(a, b, q)) / area(a, b, c)


def interpolate_normal(weights, normals):
    """Returns N̂: the normals of the three corners, weighted by (α, β, γ), then normalised.
    [rule 18]

    - The normals are unit vectors in the frame of the mesh, and so is the result. The weighted sum
      is never the zero vector.
    """
    a, b, c = normals
    return (weights.x * a + weights.y * b + weights.z * c).normalized()


def smooth_reflect(direction, n_geom, n_shading):
    """Returns R where normals are interpolated: by the interpolated normal, unless that R would
    lead into the object. [rule 19]

    - All are unit vectors in world space. d points towards the surface, `n_geom` is turned against
      it (d·N ≤ 0), and `n_shading` was turned together with it.
    - R must leave the surface: if R · `n_geom` ≤ 0, it is computed again with `n_geom`.
    """
    smooth = reflect(direction, n_shading)
    return smooth if smooth.dot(n_geom) > 0.0 else reflect(direction, n_geom)


def smooth_refract(direction, n_geom, n_shading, eta_i, eta_t):
    """Returns T where normals are interpolated, or None for total internal reflection. [rule 19]

    - The vectors are as in `smooth_reflect`, and the indices as in `refract`.
    - The interpolated normal decides on total internal reflection and gives T. If that T does not
      go through the surface (T · `n_geom` ≥ 0), both are decided again with `n_geom`.
    - If the interpolated normal faces away from the ray (d · `n_shading` ≥ 0), `n_geom` is used
      from the start.
    """
    if direction.dot(n_shading) >= 0.0:
        return refract(direction, n_geom, eta_i, eta_t)
    smooth = refract(direction, n_shading, eta_i, eta_t)
    if smooth is not None and smooth.dot(n_geom) >= 0.0:
        return refract(direction, n_geom, eta_i, eta_t)
    return smooth
