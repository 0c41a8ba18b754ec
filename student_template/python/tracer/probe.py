"""Passes each question of the unit checks to its function. Given: nothing to write here."""

from math import isinf, isnan

from tracer.camera import eye_ray
from tracer.cuboid import intersect_box
from tracer.light import distance_attenuation, to_light
from tracer.nearest import nearest_hit
from tracer.object import intersect_transformed
from tracer.plane import intersect_plane, intersect_square
from tracer.ray import Ray
from tracer.reflection import goes_on, reflect
from tracer.refraction import indices, refract
from tracer.scene import Camera, Material, Object, Scene, affine, read_light, vec3
from tracer.shade import ambient, facing_normal, light_term, shade
from tracer.smooth import barycentric, interpolate_normal, smooth_reflect, smooth_refract
from tracer.sphere import intersect_sphere
from tracer.surface import Surface
from tracer.trace import Path, trace, unblocked_share
from tracer.transform import normal_to_world, ray_to_object
from tracer.triangle import intersect_triangle


def understand(question):
    """Returns a function without arguments that answers the question, a value of JSON.

    Raises KeyError, TypeError, ValueError or IndexError if the question cannot be understood.
    """
    return _CALLS[question["fn"]](question)


def _number_in(value):
    """Reads a number. The strings "inf", "-inf" and "nan" stand for what JSON cannot write."""
    return float(value)


def _number(x):
    if isnan(x):
        return "nan"
    return ("inf" if x > 0.0 else "-inf") if isinf(x) else float(x)


def _list(v):
    return [_number(x) for x in v]


def _ray_in(value):
    ends = _number_in(value["t_min"]), _number_in(value["t_max"])
    return Ray(vec3(value["origin"]), vec3(value["direction"]), *ends)


def _hit(hit):
    if hit is None:
        return {"miss": True}
    return {"hit": {"t": _number(hit.t), "normal": _list(hit.normal)}}


def _found(hit):
    return {"miss": True} if hit is None else {"found": {"t": _number(hit.t), "object": hit.object}}


def _ray(ray):
    return {"ray": {"origin": _list(ray.origin), "direction": _list(ray.direction)}}


def _vector(v):
    return {"miss": True} if v is None else {"vector": _list(v)}


def _colour(v):
    return {"colour": _list(v)}


def _facing(pair):
    normal, inside = pair
    return {"facing": {"normal": _list(normal), "inside": bool(inside)}}


def _to_light(pair):
    direction, t = pair
    return {"to_light": {"direction": _list(direction), "t": _number(t)}}


def _indices(pair):
    eta_i, eta_t = pair
    return {"indices": {"eta_i": _number(eta_i), "eta_t": _number(eta_t)}}


def _shade(scene, index, point, normal, to_viewer, inside):
    material = scene.materials[scene.objects[index].material]
    return shade(scene, Surface(point, -to_viewer, normal, normal, inside, material))


def _transformed_sphere(ray, world_from_object, object_from_world):
    sphere = {
        "name": "sphere",
        "shape": {"sphere": {"center": [0, 0, 0], "radius": 0.5}},
        "material": 0,
        "world_from_object": world_from_object,
        "object_from_world": object_from_world,
    }
    return intersect_transformed(Object(sphere), ray)


def _call(function, answer, **readers):
    """Returns a reader of questions to `function`. Each argument is the value of a key, in the
    order of the function's arguments; `answer` gives the JSON of the result.
    """

    def understood(question):
        arguments = [reader(question[key]) for key, reader in readers.items()]
        return lambda: answer(function(*arguments))

    return understood


def _as_is(value):
    return value


def _flag(value):
    if not isinstance(value, bool):
        raise ValueError(f"expected true or false, not {value}")
    return value


_CALLS = {
    "eye_ray": _call(
        lambda camera, width, height, pixel: eye_ray(camera, width, height, *pixel),
        _ray,
        camera=Camera,
        width=int,
        height=int,
        pixel=tuple,
    ),
    "sphere": _call(intersect_sphere, _hit, ray=_ray_in, center=vec3, radius=float),
    "plane": _call(intersect_plane, _hit, ray=_ray_in, normal=vec3, k=float),
    "square": _call(intersect_square, _hit, ray=_ray_in),
    "box": _call(intersect_box, _hit, ray=_ray_in, min=vec3, max=vec3),
    "triangle": _call(intersect_triangle, _hit, ray=_ray_in, a=vec3, b=vec3, c=vec3),
    "nearest": _call(nearest_hit, _found, scene=Scene, ray=_ray_in),
    "to_light": _call(to_light, _to_light, light=read_light, point=vec3),
    "attenuation": _call(
        distance_attenuation, lambda x: {"value": _number(x)}, light=read_light, r=_number_in
    ),
    "facing_normal": _call(facing_normal, _facing, direction=vec3, normal=vec3),
    "ambient": _call(ambient, _colour, material=Material, light=read_light, inside=_flag),
    "light_term": _call(
        light_term,
        _colour,
        material=Material,
        arriving=vec3,
        normal=vec3,
        to_viewer=vec3,
        to_light=vec3,
    ),
    "shade": _call(
        _shade,
        _colour,
        scene=Scene,
        object=int,
        point=vec3,
        normal=vec3,
        to_viewer=vec3,
        inside=_flag,
    ),
    "shadow": _call(
        lambda scene, index, point: unblocked_share(scene, scene.lights[index], point),
        _colour,
        scene=Scene,
        light=int,
        point=vec3,
    ),
    "reflect": _call(reflect, _vector, direction=vec3, normal=vec3),
    "goes_on": _call(
        goes_on,
        lambda yes: {"goes_on": bool(yes)},
        depth=int,
        max_depth=int,
        weight=vec3,
        threshold=float,
    ),
    "trace": _call(
        lambda scene, ray, depth: trace(scene, ray, Path("eye", depth)),
        _colour,
        scene=Scene,
        ray=_ray_in,
        depth=int,
    ),
    "indices": _call(indices, _indices, inside=_flag, index=float),
    "refract": _call(refract, _vector, direction=vec3, normal=vec3, eta_i=float, eta_t=float),
    "ray_to_object": _call(ray_to_object, _ray, ray=_ray_in, object_from_world=affine),
    "normal_to_world": _call(normal_to_world, _vector, normal=vec3, object_from_world=affine),
    "transformed_sphere": _call(
        _transformed_sphere,
        _hit,
        ray=_ray_in,
        world_from_object=_as_is,
        object_from_world=_as_is,
    ),
    "barycentric": _call(barycentric, _vector, a=vec3, b=vec3, c=vec3, q=vec3),
    "interpolate": _call(
        interpolate_normal,
        _vector,
        weights=vec3,
        normals=lambda normals: tuple(vec3(normal) for normal in normals),
    ),
    "smooth_reflect": _call(smooth_reflect, _vector, direction=vec3, n_geom=vec3, n_shading=vec3),
    "smooth_refract": _call(
        smooth_refract,
        _vector,
        direction=vec3,
        n_geom=vec3,
        n_shading=vec3,
        eta_i=float,
        eta_t=float,
    ),
}
