"""Light through glass and water. Stage 04."""

from tracer import trace
from tracer.ray import Ray
from tracer.vec import BLACK

# Index of refraction of the air around every object. [rule 9]
AIR_INDEX = 1.0003


def indices(inside, index):
    """Returns (η_i, η_t): the index on the side of the ray, and on the other side. [rule 9]

    - A ray that enters comes from air and goes into a material of that `index`. A ray that leaves
      (`inside`) goes the other way.
    """
    raise NotImplementedError("indices [rule 9]: tracer/refraction.py")


def refract(direction, normal, eta_i, eta_t):
    """Returns T, the direction of the refracted ray, a unit vector, or None for total internal
    reflection. [rule 8] [rule 10]

    - `direction` d and `normal` N are unit vectors in the same frame; d points towards the surface,
      and N is turned against it (d·N ≤ 0).
    - η_i sin θ_i = η_t sin θ_t; T lies in the plane of d and N, on the other side of the surface.
    - No ray is transmitted beyond the critical angle; exactly at it one is, along the surface.
    - If both indices are equal, T = d.
    """
    raise NotImplementedError("refract [rule 8] [rule 10]: tracer/refraction.py")


def refracted_light(scene, at, path):
    """Returns the light that comes through the surface to the viewer: kt · trace(Q, T), or black if
    no ray is transmitted. [rule 8]

    - `at` is in world space: its point is Q, `at.inside` says on which side the ray is, and
      `at.refracted_direction(eta_i, eta_t)` is T. Products are channel by channel.
    - `path` is that of the ray that hit the surface; the refracted ray's is
      `path.extended("refracted", kt)`. `trace.trace(scene, ray, path)` returns the light.
    - The function is called only if kt is not black and the ray `goes_on`.
    """
    raise NotImplementedError("refracted_light [rule 8]: tracer/refraction.py")
