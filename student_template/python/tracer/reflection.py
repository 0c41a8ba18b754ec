"""Reflected rays. Stage 03."""

from tracer import trace
from tracer.ray import Ray


def reflect(direction, normal):
    """Returns R = d − 2 (d·N) N, the direction of the reflected ray. [rule 7]

    - `direction` d and `normal` N are unit vectors in the same frame; d points *towards* the
      surface. R is a unit vector in this frame too, and points away from the surface.
    - N and −N give the same R.
    """
    raise NotImplementedError("reflect [rule 7]: tracer/reflection.py")


def goes_on(depth, max_depth, weight, threshold):
    """Returns whether a ray may spawn further rays. [rule 13]

    - `depth` is that of the ray that hit the surface; the eye ray's is 0. A ray of depth
      `max_depth` spawns no more.
    - `weight` is the product of the factors (kr or kt) along the path of this ray, (1, 1, 1) for
      the eye ray. A weight below `threshold` in *every* channel spawns no more either; a
      `threshold` of 0 switches this test off.
    """
    raise NotImplementedError("goes_on [rule 13]: tracer/reflection.py")


def reflected_light(scene, at, path):
    """Returns the light that the surface reflects to the viewer: kr · trace(Q, R). [rule 7]

    - `at` is in world space: its point is Q, `at.reflected_direction()` is R, and its material has
      kr. Products are channel by channel.
    - `path` is that of the ray that hit the surface; the reflected ray's is
      `path.extended("reflected", kr)`. `trace.trace(scene, ray, path)` returns the light.
    - The function is called only if kr is not black and the ray `goes_on`.
    """
    raise NotImplementedError("reflected_light [rule 7]: tracer/reflection.py")
