"""Between world space and an object's own space. Stage 05."""

from tracer.ray import Ray


def ray_to_object(ray, object_from_world):
    """Returns the same ray in object space. [rule 20]

    - `ray` is in world space, `object_from_world` is M⁻¹, an `Affine`.
    - The origin is a point and moves with the translation; the direction is a vector and does not.
    - The direction is *not* normalised, and the interval stays as it is, so that t means the same
      point in both spaces.
    """
    raise NotImplementedError("ray_to_object [rule 20]: tracer/transform.py")


def normal_to_world(normal, object_from_world):
    """Returns the world-space normal N along A⁻ᵀ N′, a unit vector. [rule 20]

    - `normal` is N′, a unit normal in object space; `object_from_world` is M⁻¹, whose linear part
      is A⁻¹.
    - A N′ would be right for rotations and uniform scaling only.
    - An outward normal stays outward, even if M mirrors.
    """
    raise NotImplementedError("normal_to_world [rule 20]: tracer/transform.py")
