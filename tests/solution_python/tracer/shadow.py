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
    tinted = "tinted_shadows" in scene.effects
    direction, t_light = to_light(light, point)
    if t_light == 0.0:
        return WHITE
    share = WHITE
    for index, object in enumerate(scene.objects):
        ray = Ray(point, direction, RAY_EPSILON, t_light)
        while (hit := intersect_object(scene, index, ray)) is not None:
            share = share * scene.materials[object.material].kt if tinted else BLACK
            if share == BLACK:
                return BLACK
            # The interval is open: this excludes the hit that was just found, and nothing else.
            ray = Ray(point, direction, hit.t, t_light)
    return share
