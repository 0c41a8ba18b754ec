"""One object: takes the ray to object space, intersects it with the object's shape, and brings the
hit back. Given: nothing to write here.
"""

from tracer.cuboid import intersect_box
from tracer.plane import intersect_plane, intersect_square
from tracer.ray import Hit, SurfaceHit
from tracer.round import intersect_cone
from tracer.smooth import barycentric, interpolate_normal
from tracer.sphere import intersect_sphere
from tracer.transform import normal_to_world, ray_to_object
from tracer.triangle import intersect_triangle


def intersect_object(scene, index, ray):
    """Returns the nearest hit of `ray` with the object of that index, or None, all in world
    space.
    """
    found = _in_world(scene.objects[index], scene.meshes, "smooth_normals" in scene.effects, ray)
    if found is None:
        return None
    t, n_geom, n_shading = found
    return Hit(t, ray.at(t), n_geom, n_shading, index)


def intersect_transformed(object, ray):
    """Returns the nearest hit of a world-space `ray` with an `object` that is no mesh, or None."""
    found = _in_world(object, [], False, ray)
    return None if found is None else SurfaceHit(found[0], found[1])


def _in_world(object, meshes, smooth, ray):
    """Intersects a world-space ray with an object. If the object's matrix is the identity, world
    space is object space, so that stages 1 to 4 need no transform. [rule 20]

    A hit is t and its two unit normals, the geometric one and the one for shading, both outwards.
    They are the same object unless the mesh is smooth.
    """
    if object.is_untransformed:
        return _in_object(object, meshes, smooth, ray)
    found = _in_object(object, meshes, smooth, ray_to_object(ray, object.object_from_world))
    if found is None:
        return None
    t, in_geom, in_shading = found
    n_geom = normal_to_world(in_geom, object.object_from_world)
    if in_shading is in_geom:
        return t, n_geom, n_geom
    return t, n_geom, normal_to_world(in_shading, object.object_from_world)


def _in_object(object, meshes, smooth, ray):
    if object.kind == "mesh":
        return _intersect_mesh(meshes[object.shape[0]], smooth, ray)
    hit = _SHAPES[object.kind](ray, *object.shape)
    return None if hit is None else (hit.t, hit.normal, hit.normal)


def _intersect_cylinder(ray, radius, z_min, z_max, capped):
    return intersect_cone(ray, radius, radius, z_min, z_max, capped)


# The function for each kind of shape. The values of the shape are its arguments behind the ray.
_SHAPES = {
    "sphere": intersect_sphere,
    "plane": intersect_plane,
    "square": intersect_square,
    "box": intersect_box,
    "cylinder": _intersect_cylinder,
    "cone": intersect_cone,
}


def _intersect_mesh(mesh, smooth, ray):
    """Tests every triangle in turn, unless the ray misses the box around a large mesh. Of two hits
    at equal t, the earlier triangle's counts. [rule 2] [rule 16]
    """
    if mesh.bounds is not None and mesh.bounds.is_missed_by(ray):
        return None
    vertices = mesh.vertices
    nearest, corners = None, None
    for triangle in mesh.triangles:
        a, b, c = triangle
        hit = intersect_triangle(ray, vertices[a], vertices[b], vertices[c])
        if hit is not None and (nearest is None or hit.t < nearest.t):
            nearest, corners = hit, triangle
    if nearest is None:
        return None
    if mesh.normals is None or not smooth:
        return nearest.t, nearest.normal, nearest.normal
    a, b, c = (vertices[corner] for corner in corners)
    normals = tuple(mesh.normals[corner] for corner in corners)
    weights = barycentric(a, b, c, ray.at(nearest.t))
    return nearest.t, nearest.normal, interpolate_normal(weights, normals)
