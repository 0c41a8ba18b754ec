"""The box. Stage 01."""

from math import inf

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
    # The ray is in the box while it is between the two sides of each of the three pairs: from the
    # last entry to the first exit.
    entry, entry_axis = -inf, 0
    exit, exit_axis = inf, 0
    for axis, p, d, low, high in zip(range(3), ray.origin, ray.direction, min, max):
        if d == 0.0:
            if p < low or high < p:
                return None
            continue
        near = ((low if d > 0.0 else high) - p) / d
        far = ((high if d > 0.0 else low) - p) / d
        if near > entry:
            entry, entry_axis = near, axis
        if far < exit:
            exit, exit_axis = far, axis
    if entry > exit:
        return None
    if ray.contains(entry):
        return SurfaceHit(entry, -along(ray, entry_axis))
    if ray.contains(exit):
        return SurfaceHit(exit, along(ray, exit_axis))
    return None


def along(ray, axis):
    """Returns the unit vector of an axis, in the direction in which the ray runs along it."""
    components = [0.0, 0.0, 0.0]
    components[axis] = 1.0 if tuple(ray.direction)[axis] > 0.0 else -1.0
    return Vec3(*components)
