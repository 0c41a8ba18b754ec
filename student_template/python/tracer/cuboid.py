"""The box. Stage 01."""

from tracer.ray import SurfaceHit
from tracer.vec import Vec3


def intersect_box(ray, min, max):
    """Returns the nearest hit of `ray` with the surface of the box `min` ≤ X ≤ `max`, or None.
    [rule 15]

    - `ray`, corners and hit are in the same frame. The direction may have any length but zero and
      must not be normalised; some of its components may be 0. [rule 20]
    - A ray that starts inside hits the side through which it leaves. [rule 2]
    - The sides belong to the box: a ray that runs within a side hits the box where it reaches the
      side.
    - `normal` is one of ±x, ±y, ±z and points outwards, even if the ray starts inside. [rule 11]
    - `min` and `max` are the corners. They hide Python's functions of these names.
    """
    raise NotImplementedError("intersect_box [rule 15]: tracer/cuboid.py")
