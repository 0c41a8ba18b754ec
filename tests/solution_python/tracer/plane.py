"""The plane and the square. Stage 01."""

from tracer.ray import SurfaceHit
from tracer.vec import Vec3


def intersect_plane(ray, normal, k):
    """Returns the hit of `ray` with the plane N·X = `k`, or None. [rule 15]

    - `normal` is N, a unit vector. It is also the normal of the hit, whichever side the ray comes
      from. [rule 11]
    - The ray's direction may have any length but zero and must not be normalised. [rule 20]
    - t counts iff `ray.contains` it. [rule 2]
    - If N·d = 0, the ray is parallel and misses, even if it lies in the plane. Only an exact 0 is
      parallel: a nearly parallel ray hits far away.
    """
    n_dot_d = normal.dot(ray.direction)
    if n_dot_d == 0.0:
        return None
    t = (k - normal.dot(ray.origin)) / n_dot_d
    return SurfaceHit(t, normal) if ray.contains(t) else None


def intersect_square(ray):
    """Returns the hit of `ray` with the unit square |x| ≤ 0.5, |y| ≤ 0.5, z = 0, or None. [rule 15]

    - The ray and the hit are in the square's frame. The direction may have any length but zero.
      [rule 20]
    - The edges belong to the square. A ray in the plane of the square misses it.
    - The normal is (0, 0, 1), whichever side the ray comes from. [rule 11]
    """
    hit = intersect_plane(ray, Vec3(0.0, 0.0, 1.0), 0.0)
    if hit is None:
        return None
    q = ray.at(hit.t)
    return hit if abs(q.x) <= 0.5 and abs(q.y) <= 0.5 else None
