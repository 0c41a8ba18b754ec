"""The direction and distance of a light, and the share of it that arrives. Stage 01."""

from tracer.vec import BLACK


def to_light(light, point):
    """Returns (L, t_light): the unit vector from `point` to the light, and the distance to it; in
    world space. [rule 5]

    - A directional light (`light.is_directional`) stores the direction in which its light
      *travels*. L points the other way, and t_light is infinite.
    - A light exactly at the point has no direction. The result is the zero vector and 0, so that it
      adds nothing.
    """
    raise NotImplementedError("to_light [rule 5]: tracer/light.py")


def distance_attenuation(light, r):
    """Returns A = min(1, 1 / (a r² + b r + c)), the share of the light that arrives at distance
    `r`. [rule 4]

    - `r` is at least 0. a, b, c are the light's `quadratic`, `linear` and `constant`; none is
      negative, and not all are 0.
    - Light is never amplified: if the denominator is less than 1 (even 0), the result is 1.
    - A directional light does not weaken: the result is 1.
    """
    raise NotImplementedError("distance_attenuation [rule 4]: tracer/light.py")
