"""The nearest hit in a scene. Stage 01."""

from tracer.object import intersect_object


def nearest_hit(scene, ray):
    """Returns the nearest hit of `ray` among all objects of the scene, or None. [rule 2]

    - `ray` and the hit are in world space. `intersect_object(scene, index, ray)` returns the hit
      with one object.
    - The least t counts. Of two hits at the same t, the one with the object that is listed first
      wins: a later one replaces it only if it is strictly nearer.
    - An empty scene gives None.
    """
    raise NotImplementedError("nearest_hit [rule 2]: tracer/nearest.py")
