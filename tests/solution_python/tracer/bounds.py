"""The box around a mesh: a ray that misses it hits none of the triangles. Given: nothing to write
here.
"""


class Bounds:
    """The box around one point or more, a little larger, so that rounding loses no hit."""

    __slots__ = ("sides",)

    def __init__(self, points):
        margin = 1e-6 * max(abs(x) for point in points for x in point)
        # The two sides along each axis.
        self.sides = [(min(xs) - margin, max(xs) + margin) for xs in zip(*points)]

    def is_missed_by(self, ray):
        """Returns whether the line of the ray misses the box within the interval of the ray."""
        entry, exit = ray.t_min, ray.t_max
        for p, d, (low, high) in zip(ray.origin, ray.direction, self.sides):
            if d == 0.0:
                if p < low or high < p:
                    return True
                continue
            near, far = (low - p) / d, (high - p) / d
            if near > far:
                near, far = far, near
            if near > entry:
                entry = near
            if far < exit:
                exit = far
            if entry > exit:
                return True
        return False
