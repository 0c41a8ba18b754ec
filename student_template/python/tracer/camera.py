"""Eye rays. Stage 01."""

from tracer.ray import Ray


def eye_ray(camera, width, height, i, j):
    """Returns the ray from the eye through the centre of a pixel. [rule 1]

    - `camera` is in world space: the eye C, three orthonormal vectors, and `fov_y_deg`, the
      *vertical* angle of view in degrees.
    - The picture has `width` columns and `height` rows of square pixels, so the view plane is
      `width` / `height` times as wide as it is high.
    - `i` counts columns from the left, `j` rows from the *top*; both begin at 0. The centre of a
      pixel lies half a pixel further.
    - The result starts at the eye and has a unit direction. `Ray(origin, direction)` gives it its
      interval.
    """
    raise NotImplementedError("eye_ray [rule 1]: tracer/camera.py")
