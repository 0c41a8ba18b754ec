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
    n = (b - a).cross(c - a)
    n_dot_d = n.dot(ray.direction)
    if n_dot_d == 0.0:
        return None
    t = n.dot(a - ray.origin) / n_dot_d
    if not ray.contains(t):
        return None
    q = ray.at(t)
    if is_left_of(a, b, q, n) and is_left_of(b, c, q, n) and is_left_of(c, a, q, n):
        return SurfaceHit(t, n.normalized())
    return None


def is_left_of(a, b, q, n):
    """Returns whether `q` lies to the left of, or on, the edge from `a` to `b`, seen from the side
    to which `n` points. [rule 16]
    """
    return (b - a).cross(q - a).dot(n) >= 0.0
