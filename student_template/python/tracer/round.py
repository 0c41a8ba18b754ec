"""Cylinder and cone, which are not part of the assignment. Given: nothing to write here."""

from math import inf, sqrt

from tracer.ray import SurfaceHit
from tracer.vec import Vec3


def intersect_cone(ray, bottom_radius, top_radius, z_min, z_max, capped):
    """Returns the nearest hit with a cone, whose radius changes linearly from `bottom_radius` at
    `z_min` to `top_radius` at `z_max`, or None. Discs close it if it is `capped`.
    """
    hits = [_intersect_side(ray, bottom_radius, top_radius, z_min, z_max)]
    if capped:
        hits.append(_intersect_cap(ray, bottom_radius, z_min, Vec3(0.0, 0.0, -1.0)))
        hits.append(_intersect_cap(ray, top_radius, z_max, Vec3(0.0, 0.0, 1.0)))
    return min((hit for hit in hits if hit is not None), key=lambda hit: hit.t, default=None)


def _intersect_side(ray, bottom_radius, top_radius, z_min, z_max):
    """Intersects x² + y² = (r₀ + slope · (z − z₀))², a quadratic equation in t."""
    slope = (top_radius - bottom_radius) / (z_max - z_min)
    p, d = ray.origin, ray.direction
    r, dr = bottom_radius + slope * (p.z - z_min), slope * d.z
    a = d.x * d.x + d.y * d.y - dr * dr
    half_b = p.x * d.x + p.y * d.y - r * dr
    c = p.x * p.x + p.y * p.y - r * r
    for t in _roots(a, half_b, c):
        q = ray.at(t) if ray.contains(t) else None
        if q is not None and z_min <= q.z <= z_max:
            normal = Vec3(q.x, q.y, -slope * (bottom_radius + slope * (q.z - z_min)))
            if normal.length() == 0.0:
                # The tip of the cone.
                normal = Vec3(0.0, 0.0, 1.0 if slope < 0.0 else -1.0)
            return SurfaceHit(t, normal.normalized())
    return None


def _roots(a, half_b, c):
    """Returns the roots of a t² + 2 `half_b` t + c, the lesser first. They are infinite if there
    are none, so that they lie in no interval.

    The root that would cancel is computed from the product of the two, which is c / a.
    """
    discriminant = half_b * half_b - a * c
    if discriminant < 0.0:
        return inf, inf
    root = sqrt(discriminant)
    q = root - half_b if half_b < 0.0 else -root - half_b
    one = q / a if a != 0.0 else inf
    two = c / q if q != 0.0 else inf
    return min(one, two), max(one, two)


def _intersect_cap(ray, radius, z, normal):
    if ray.direction.z == 0.0:
        return None
    t = (z - ray.origin.z) / ray.direction.z
    if not (radius > 0.0 and ray.contains(t)):
        return None
    q = ray.at(t)
    return SurfaceHit(t, normal) if q.x * q.x + q.y * q.y <= radius * radius else None
