"""Rays and hits. Given: nothing to write here."""

from math import inf

from tracer.vec import Vec3

# Lower end of a ray's interval. An intersection at this parameter or below does not count, because
# a new ray starts on a surface only up to rounding. [rule 2] [rule 21]
RAY_EPSILON = 1e-6


class Ray:
    """A ray r(t) = origin + t · direction, for t_min < t < t_max. [rule 2]

    Eye, shadow, reflected and refracted rays have unit directions. In object space, the direction
    of a ray has the length that the matrix gives it. [rule 20]

    `Ray(origin, direction)` is the ray over RAY_EPSILON < t < ∞.
    """

    __slots__ = ("origin", "direction", "t_min", "t_max")

    def __init__(self, origin, direction, t_min=RAY_EPSILON, t_max=inf):
        self.origin = origin
        # Never the zero vector.
        self.direction = direction
        # The open ends of the interval; t_max may be infinite.
        self.t_min = t_min
        self.t_max = t_max

    def at(self, t):
        """Returns the point at parameter `t`."""
        o, d = self.origin, self.direction
        return Vec3(o.x + t * d.x, o.y + t * d.y, o.z + t * d.z)

    def contains(self, t):
        """Returns whether a hit at `t` counts: strictly inside the interval; never for NaN.
        [rule 2]
        """
        return self.t_min < t < self.t_max


class SurfaceHit:
    """The intersection of a ray with a single shape, in the frame of the ray. A miss is None."""

    __slots__ = ("t", "normal")

    def __init__(self, t, normal):
        # Parameter along the ray as given, whose direction is not normalised. [rule 20]
        self.t = t
        # Unit normal, which points outwards even if the ray comes from inside. [rule 11]
        self.normal = normal


class Hit:
    """The nearest hit of a ray in a scene, in world space. A miss is None."""

    __slots__ = ("t", "point", "n_geom", "n_shading", "object")

    def __init__(self, t, point, n_geom, n_shading, object):
        # Parameter along the ray, and the point of the hit.
        self.t = t
        self.point = point
        # Outward unit normal of the surface itself. [rule 19]
        self.n_geom = n_geom
        # Unit normal for shading: interpolated on a mesh that has vertex normals, else `n_geom`.
        # [rule 18]
        self.n_shading = n_shading
        # Index into the objects of the scene.
        self.object = object
