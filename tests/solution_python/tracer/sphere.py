"""The sphere. Stage 01."""

from math import sqrt

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
    # The roots of a t² + 2 half_b t + c.
    from_center = ray.origin - center
    a = ray.direction.dot(ray.direction)
    half_b = from_center.dot(ray.direction)
    c = from_center.dot(from_center) - radius * radius
    discriminant = half_b * half_b - a * c
    if discriminant < 0.0:
        return None
    # Only one of −b ± √D is computed, the one that does not cancel. The other root follows from
    # their product c / a.
    root = sqrt(discriminant)
    q = root - half_b if half_b < 0.0 else -root - half_b
    one = q / a
    two = c / q if q != 0.0 else one
    for t in (min(one, two), max(one, two)):
        if ray.contains(t):
            return SurfaceHit(t, (ray.at(t) - center).normalized())
    return None
