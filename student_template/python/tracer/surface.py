"""The surface that a ray hit, as shading and new rays need it. Given: nothing to write here."""

from tracer.reflection import reflect
from tracer.refraction import refract
from tracer.shade import facing_normal
from tracer.smooth import smooth_reflect, smooth_refract


class Surface:
    """A point on an object, seen along a ray; all in world space."""

    __slots__ = ("point", "direction", "n_geom", "n_shading", "inside", "material")

    def __init__(self, point, direction, n_geom, n_shading, inside, material):
        # Q, the point where the ray hit the object.
        self.point = point
        # d, the unit vector along which the ray came; the viewer lies along −d.
        self.direction = direction
        # Unit normal of the surface itself, turned against the ray. [rule 11]
        self.n_geom = n_geom
        # Unit normal for shading, turned along with `n_geom`. It differs from `n_geom` only on
        # smooth meshes. [rule 18]
        self.n_shading = n_shading
        # Whether the ray came from inside the object. [rule 11]
        self.inside = inside
        # The material of the object.
        self.material = material

    def reflected_direction(self):
        """Returns R, the unit direction of the reflected ray. [rule 7] [rule 19]"""
        if self.n_shading == self.n_geom:
            return reflect(self.direction, self.n_geom)
        return smooth_reflect(self.direction, self.n_geom, self.n_shading)

    def refracted_direction(self, eta_i, eta_t):
        """Returns T, the unit direction of the refracted ray, or None for total internal
        reflection. [rule 8] [rule 10] [rule 19]
        """
        if self.n_shading == self.n_geom:
            return refract(self.direction, self.n_geom, eta_i, eta_t)
        return smooth_refract(self.direction, self.n_geom, self.n_shading, eta_i, eta_t)


def surface_at(scene, ray, hit):
    """Returns the surface that `ray` hit, with the normals turned against the ray. [rule 11]"""
    n_geom, inside = facing_normal(ray.direction, hit.n_geom)
    n_shading = -hit.n_shading if inside else hit.n_shading
    material = scene.materials[scene.objects[hit.object].material]
    return Surface(hit.point, ray.direction, n_geom, n_shading, inside, material)
