"""Direct light: emission, ambient, diffuse and specular. Stage 01."""

from tracer import trace
from tracer.light import distance_attenuation, to_light
from tracer.vec import BLACK


def facing_normal(direction, normal):
    """Returns the normal turned against the ray, and whether the ray is inside the object.
    [rule 11]

    - `direction` is the ray's, `normal` the outward unit normal, both in the same frame.
    - The ray is inside, about to leave, iff d·N > 0. The normal is then negated. At d·N = 0 the ray
      counts as outside.
    """
    raise NotImplementedError("facing_normal [rule 11]: tracer/shade.py")


def ambient(material, light, inside):
    """Returns the ambient part of one light: ka Ia, multiplied by kt if the point is seen from
    `inside` its object. [rule 3] [rule 12]
    """
    raise NotImplementedError("ambient [rule 3] [rule 12]: tracer/shade.py")


def light_term(material, arriving, normal, to_viewer, to_light):
    """Returns the diffuse and specular part of one light: `arriving` B [kd (N·L) + ks (N·H)₊^ns].
    [rule 3]

    - `arriving` is S A I, the light that arrives after shadows and distance.
    - `normal` N is turned against the ray, `to_viewer` is −d, and `to_light` is L. They are unit
      vectors in world space.
    - B is 1 if N·L > 0, else 0: the light is then behind the surface, and there is no highlight
      either.
    - H is the unit vector along L + V (V = −d). If L + V = 0, there is no specular part.
    - (N·H)₊ is N·H, or 0 if that is negative. A power 0⁰ is 1.
    - `to_light` may be the zero vector (see the function `to_light`). The result is then black.
    """
    raise NotImplementedError("light_term [rule 3]: tracer/shade.py")


def shade(scene, at):
    """Returns the light that the surface sends to the viewer without further rays except shadow
    rays. [rule 3]

    - `at` is in world space. Use its normal `n_shading`, which is already turned against the ray.
      The viewer lies along −d.
    - The light is the sum of ke and, for each light of the scene, its ambient part and its diffuse
      and specular part.
    - The light that arrives is S A I: S is `trace.unblocked_share(scene, light, point)`, which is 1
      until a scene has shadows (stage 02), A is `distance_attenuation`, and I is the light's
      colour.
    """
    raise NotImplementedError("shade [rule 3]: tracer/shade.py")
