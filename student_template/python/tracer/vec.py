"""Vectors of three numbers, for points, directions and colours. Given: nothing to write here."""

from math import sqrt


class Vec3:
    """Three numbers x, y, z. No method changes a vector.

    `a + b`, `a - b`, `-a`, `a * s`, `s * a` and `a / s` are as on paper; `s` is a number. `a * b`
    is the product component by component, as colours are filtered.
    """

    __slots__ = ("x", "y", "z")

    def __init__(self, x, y, z):
        self.x = x
        self.y = y
        self.z = z

    def __add__(self, other):
        return Vec3(self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other):
        return Vec3(self.x - other.x, self.y - other.y, self.z - other.z)

    def __neg__(self):
        return Vec3(-self.x, -self.y, -self.z)

    def __mul__(self, other):
        if other.__class__ is Vec3:
            return Vec3(self.x * other.x, self.y * other.y, self.z * other.z)
        return Vec3(self.x * other, self.y * other, self.z * other)

    __rmul__ = __mul__

    def __truediv__(self, divisor):
        return Vec3(self.x / divisor, self.y / divisor, self.z / divisor)

    def __eq__(self, other):
        return self.x == other.x and self.y == other.y and self.z == other.z

    __hash__ = None

    def __iter__(self):
        """Iterates over the components, so that `x, y, z = v` takes a vector apart."""
        yield self.x
        yield self.y
        yield self.z

    def __repr__(self):
        return f"Vec3({self.x}, {self.y}, {self.z})"

    def dot(self, other):
        return self.x * other.x + self.y * other.y + self.z * other.z

    def cross(self, other):
        return Vec3(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )

    def length(self):
        return sqrt(self.x * self.x + self.y * self.y + self.z * self.z)

    def normalized(self):
        """Returns the unit vector along this one, which is not the zero vector."""
        return self / self.length()

    def max_component(self):
        return max(self.x, self.y, self.z)


BLACK = Vec3(0.0, 0.0, 0.0)
WHITE = Vec3(1.0, 1.0, 1.0)


class Affine:
    """The map X → A X + t of points; directions are mapped by A alone. [rule 20]"""

    __slots__ = ("rows", "translation")

    def __init__(self, rows, translation):
        # The three rows of A, and t; each a Vec3.
        self.rows = rows
        self.translation = translation

    def linear(self, v):
        """Returns A v."""
        a, b, c = self.rows
        x, y, z = v.x, v.y, v.z
        return Vec3(
            a.x * x + a.y * y + a.z * z,
            b.x * x + b.y * y + b.z * z,
            c.x * x + c.y * y + c.z * z,
        )

    def transposed_linear(self, v):
        """Returns Aᵀ v."""
        a, b, c = self.rows
        x, y, z = v.x, v.y, v.z
        return Vec3(
            a.x * x + b.x * y + c.x * z,
            a.y * x + b.y * y + c.y * z,
            a.z * x + b.z * y + c.z * z,
        )

    def is_identity(self):
        a, b, c = self.rows
        axes = Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)
        return (a, b, c) == axes and self.translation == BLACK
