"""The sphere. Stage 01."""

from tracer.ray import SurfaceHit


def intersect_sphere(ray, center, radius):
    """Returns the nearest hit of `ray` with the sphere ‖X − `center`‖ = `radius`, or None.
    [rule 14]

    - `ray`, `center` and the hit, a `SurfaceHit`, are in the same frame. The ray's direction may
      have any length but zero; it must *not* be normalised, because `t` must hold for the ray as
      given. [rule 20]
    - A root counts iff `ray.contains` it. The nearer one is tried first. If it does not count (it
      lies behind, or the ray starts inside), the farther one is tried. [rule 2]
    - `normal` is a unit vector and points outwards, even if the ray starts inside. [rule 11]
    - A grazing ray (double root) is one hit.
    """
    raise NotImplementedError("intersect_sphere [rule 14]: tracer/sphere.py")
