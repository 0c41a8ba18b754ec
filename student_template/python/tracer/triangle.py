"""The triangle. Stage 01."""

from tracer.ray import SurfaceHit


def intersect_triangle(ray, a, b, c):
    """Returns the hit of `ray` with the triangle `a`, `b`, `c`, or None. [rule 16]

    - Corners, ray and hit are in the same frame. The direction may have any length but zero and
      must not be normalised. [rule 20]
    - `normal` is the unit vector along (B − A) × (C − A), whichever side the ray comes from: both
      sides can be hit. [rule 11]
    - Edges and corners belong to the triangle.
    - A triangle without area is never hit, and neither is one that the ray is parallel to. Both are
      decided by an exact 0: a tiny triangle is still a triangle.
    - t counts iff `ray.contains` it. [rule 2]
    """
    raise NotImplementedError("intersect_triangle [rule 16]: tracer/triangle.py")
