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
    raise NotImplementedError("barycentric [rule 17]: tracer/smooth.py")


def interpolate_normal(weights, normals):
    """Returns N̂: the normals of the three corners, weighted by (α, β, γ), then normalised.
    [rule 18]

    - The normals are unit vectors in the frame of the mesh, and so is the result. The weighted sum
      is never the zero vector.
    """
    raise NotImplementedError("interpolate_normal [rule 18]: tracer/smooth.py")


def smooth_reflect(direction, n_geom, n_shading):
    """Returns R where normals are interpolated: by the interpolated normal, unless that R would
    lead into the object. [rule 19]

    - All are unit vectors in world space. d points towards the surface, `n_geom` is turned against
      it (d·N ≤ 0), and `n_shading` was turned together with it.
    - R must leave the surface: if R · `n_geom` ≤ 0, it is computed again with `n_geom`.
    """
    raise NotImplementedError("smooth_reflect [rule 19]: tracer/smooth.py")


def smooth_refract(direction, n_geom, n_shading, eta_i, eta_t):
    """Returns T where normals are interpolated, or None for total internal reflection. [rule 19]

    - The vectors are as in `smooth_reflect`, and the indices as in `refract`.
    - The interpolated normal decides on total internal reflection and gives T. If that T does not
      go through the surface (T · `n_geom` ≥ 0), both are decided again with `n_geom`.
    - If the interpolated normal faces away from the ray (d · `n_shading` ≥ 0), `n_geom` is used
      from the start.
    """
    raise NotImplementedError("smooth_refract [rule 19]: tracer/smooth.py")
