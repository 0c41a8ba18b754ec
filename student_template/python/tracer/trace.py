"""The recursion: adds up the light that comes from a surface, from its mirror image and from behind
it. Given: nothing to write here.

Only the effects that the scene lists are simulated, so a scene without mirrors never calls the
functions of that stage.
"""

from tracer import nearest, ray_tree, reflection, refraction, shade, shadow, surface
from tracer.vec import WHITE


class Path:
    """The path that led to a ray."""

    __slots__ = ("kind", "depth", "weight")

    def __init__(self, kind="eye", depth=0, weight=WHITE):
        # "eye", "reflected" or "refracted".
        self.kind = kind
        # Number of rays before it; the eye ray has depth 0. [rule 13]
        self.depth = depth
        # Product of the kr and kt along the path: the factor with which the ray's light enters the
        # pixel. [rule 13]
        self.weight = weight

    def extended(self, kind, factor):
        """Returns the path of a ray that this one spawns. Its light is multiplied by `factor` (kr
        or kt).
        """
        return Path(kind, self.depth + 1, self.weight * factor)


def trace(scene, ray, path):
    """Returns the colour along `ray`: that of the nearest surface, or the background. [rule 2]"""
    is_recording = ray_tree.is_recording()
    if is_recording:
        ray_tree.enter(path.kind, path.depth, ray)
    hit = nearest.nearest_hit(scene, ray)
    colour = scene.background if hit is None else _light_from(scene, ray, hit, path)
    if is_recording:
        ray_tree.leave(colour)
    return colour


def _light_from(scene, ray, hit, path):
    """Returns the direct light at `hit`, and the light of the rays that it spawns. [rule 3]
    [rule 7] [rule 8]
    """
    at = surface.surface_at(scene, ray, hit)
    colour = shade.shade(scene, at)
    if ray_tree.is_recording():
        ray_tree.hit(scene.objects[hit.object].name, hit.t, at, colour)
    if _spawns(scene, "reflection", at.material.kr, path):
        colour = colour + reflection.reflected_light(scene, at, path)
    if _spawns(scene, "refraction", at.material.kt, path):
        colour = colour + refraction.refracted_light(scene, at, path)
    return colour


def _spawns(scene, effect, factor, path):
    """Returns whether a ray of this kind is simulated, adds any light, and may still be cast.
    [rule 13]
    """
    threshold = scene.render.threshold if "adaptive_depth" in scene.effects else 0.0
    return (
        effect in scene.effects
        and factor.max_component() > 0.0
        and reflection.goes_on(path.depth, scene.render.max_depth, path.weight, threshold)
    )


def unblocked_share(scene, light, point):
    """Returns S, the share of `light` that reaches `point`; all of it in a scene that simulates no
    shadows. [rule 5] [rule 6]
    """
    if "shadows" in scene.effects:
        return shadow.shadow_attenuation(scene, light, point)
    return WHITE
