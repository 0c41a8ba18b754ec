"""Shadow rays. Stage 02."""

from tracer.light import to_light
from tracer.object import intersect_object
from tracer.ray import RAY_EPSILON, Ray
from tracer.vec import BLACK, WHITE


def shadow_attenuation(scene, light, point):
    """Returns S, the share of `light` that reaches `point`, as a colour. It is (1, 1, 1) if nothing
    is in the way, and black behind an opaque object. [rule 5] [rule 6]

    - `point` is in world space, on a surface. The shadow ray starts there, and must not hit that
      surface at t = 0. [rule 21]
    - Only objects in between count: RAY_EPSILON < t < t_light, which is infinite for a directional
      light. `Ray(point, direction, t_max=t_light)` has this interval.
    - Each time the ray crosses a surface, S is multiplied by the kt of that object's material: once
      through a glass pane, twice through a solid glass ball, wherever the light comes from.
    - A scene whose effects lack `tinted_shadows` has no coloured light of this kind: every surface
      blocks. `"tinted_shadows" in scene.effects` says which.
    """
    raise NotImplementedError("shadow_attenuation [rule 5] [rule 6]: tracer/shadow.py")
