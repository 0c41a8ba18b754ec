"""The resolved scene, as docs/protocol.md describes it, and its reader. Given: nothing to write
here.

The readers raise KeyError, TypeError, ValueError or IndexError if the JSON is not as described.
"""

from tracer.bounds import Bounds
from tracer.vec import Affine, Vec3


class Render:
    """Settings of a render."""

    def __init__(self, value):
        self.width = value["width"]
        self.height = value["height"]
        # Depth at which a ray spawns no further rays; the eye ray has depth 0. [rule 13]
        self.max_depth = value["max_depth"]
        # Weight below which a path spawns no further rays, in every channel; 0 is off. [rule 13]
        self.threshold = value["threshold"]


class Camera:
    """A pinhole camera; `right`, `up`, `forward` are orthonormal. [rule 1]"""

    def __init__(self, value):
        self.eye = vec3(value["eye"])
        self.right = vec3(value["right"])
        self.up = vec3(value["up"])
        self.forward = vec3(value["forward"])
        # Vertical angle of view in degrees.
        self.fov_y_deg = value["fov_y_deg"]


class PointLight:
    """A point that shines in all directions."""

    is_directional = False

    def __init__(self, value):
        self.position = vec3(value["position"])
        # I, and Ia, this light's own ambient colour. [rule 3]
        self.colour = vec3(value["colour"])
        self.ambient = vec3(value["ambient"])
        # a, b and c of rule 4: none is negative, and not all are 0.
        self.quadratic = value["attenuation"]["quadratic"]
        self.linear = value["attenuation"]["linear"]
        self.constant = value["attenuation"]["constant"]


class DirectionalLight:
    """A light infinitely far away."""

    is_directional = True

    def __init__(self, value):
        # Unit vector along which the light travels, away from the light.
        self.direction = vec3(value["direction"])
        # I, and Ia, this light's own ambient colour. [rule 3]
        self.colour = vec3(value["colour"])
        self.ambient = vec3(value["ambient"])


class Material:
    """The response of a surface to light; colours are linear RGB, none negative. [rule 3]"""

    def __init__(self, value):
        self.name = value["name"]
        # Emission, ambient, diffuse, specular, transmissive.
        self.ke = vec3(value["ke"])
        self.ka = vec3(value["ka"])
        self.kd = vec3(value["kd"])
        self.ks = vec3(value["ks"])
        self.kt = vec3(value["kt"])
        # Reflective: weight of the reflected ray. [rule 7]
        self.kr = vec3(value["kr"])
        # Specular exponent, at least 0, and index of refraction, above 0. [rule 9]
        self.ns = value["ns"]
        self.index = value["index"]


class Mesh:
    """Triangles over shared vertices; the normal of (A, B, C) is along (B − A) × (C − A).
    [rule 16]
    """

    def __init__(self, value):
        self.vertices = [vec3(vertex) for vertex in value["vertices"]]
        # Triangles, each as three indices into `vertices`.
        self.triangles = [tuple(corners) for corners in value["triangles"]]
        # The box around a mesh of many triangles. A small mesh has none, so that a mistake in the
        # intersection of triangles shows as it does without boxes.
        is_large = len(self.triangles) > 16
        self.bounds = Bounds(self.vertices) if is_large else None
        # One unit normal per vertex, or None where the mesh is flat. [rule 18]
        normals = value["normals"]
        self.normals = None if normals is None else [vec3(normal) for normal in normals]


# The keys of each kind of shape.
SHAPES = {
    "sphere": ("center", "radius"),
    "plane": ("normal", "k"),
    "square": (),
    "box": ("min", "max"),
    "cylinder": ("radius", "z_min", "z_max", "capped"),
    "cone": ("bottom_radius", "top_radius", "z_min", "z_max", "capped"),
    "mesh": ("mesh",),
}


class Object:
    """An object of the scene."""

    def __init__(self, value):
        self.name = value["name"]
        # The kind of the shape, such as "sphere", and the values of its keys, in object space.
        ((self.kind, shape),) = value["shape"].items()
        self.shape = tuple(
            vec3(shape[key]) if isinstance(shape[key], list) else shape[key]
            for key in SHAPES[self.kind]
        )
        # Index into the materials of the scene.
        self.material = value["material"]
        # M, object space to world space, and its inverse. [rule 20]
        self.world_from_object = affine(value["world_from_object"])
        self.object_from_world = affine(value["object_from_world"])
        # Whether M is the identity, so that object space is world space.
        self.is_untransformed = self.world_from_object.is_identity()


class Scene:
    """A complete picture to render."""

    def __init__(self, value):
        self.render = Render(value["render"])
        # The names of the effects to simulate, such as "tinted_shadows"; no other may show.
        self.effects = frozenset(value["effects"])
        self.camera = Camera(value["camera"])
        # Colour of a ray that hits nothing.
        self.background = vec3(value["background"])
        self.lights = [read_light(one) for one in value["lights"]]
        self.materials = [Material(one) for one in value["materials"]]
        self.meshes = [Mesh(one) for one in value["meshes"]]
        self.objects = [Object(one) for one in value["objects"]]


def vec3(value):
    x, y, z = value
    return Vec3(float(x), float(y), float(z))


def affine(value):
    rows = [vec3(row[:3]) for row in value[:3]]
    return Affine(rows, vec3([row[3] for row in value[:3]]))


def read_light(value):
    if "point" in value:
        return PointLight(value["point"])
    return DirectionalLight(value["directional"])
