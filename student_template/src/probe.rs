//! Passes each question of the unit checks to its function. Given: nothing to write here.

use cases::probe::{Answer, Ask};
use cases::program::Tracer;
use cases::ray_tree::RayKind;
use cases::{Object, Scene, Shape};
use glam::DVec3;

use crate::trace::Path;
use crate::{camera, cuboid, light, nearest, object, plane, reflection, refraction};
use crate::{shade, smooth, sphere, surface, trace, transform, triangle};

/// The functions of this crate, as the protocol calls them.
pub struct Student;

impl Tracer for Student {
    fn pixel(&self, scene: &Scene, i: u32, j: u32) -> DVec3 {
        let ray = camera::eye_ray(&scene.camera, scene.render.width, scene.render.height, i, j);
        trace::trace(scene, &ray, &Path::EYE)
    }

    fn answer(&self, ask: &Ask) -> Answer {
        match ask {
            Ask::EyeRay { camera, width, height, pixel: [i, j] } => {
                let ray = camera::eye_ray(camera, *width, *height, *i, *j);
                Answer::Ray { origin: ray.origin, direction: ray.direction }
            }
            Ask::Sphere { ray, center, radius } => {
                Answer::from_hit(sphere::intersect_sphere(ray, *center, *radius))
            }
            Ask::Plane { ray, normal, k } => {
                Answer::from_hit(plane::intersect_plane(ray, *normal, *k))
            }
            Ask::Square { ray } => Answer::from_hit(plane::intersect_square(ray)),
            Ask::Box { ray, min, max } => Answer::from_hit(cuboid::intersect_box(ray, *min, *max)),
            Ask::Triangle { ray, a, b, c } => {
                Answer::from_hit(triangle::intersect_triangle(ray, *a, *b, *c))
            }
            Ask::Nearest { scene, ray } => match nearest::nearest_hit(scene, ray) {
                Some(hit) => Answer::Found { t: hit.t, object: hit.object },
                None => Answer::Miss(true),
            },
            Ask::Attenuation { light, r } => Answer::Value(light::distance_attenuation(light, *r)),
            Ask::FacingNormal { direction, normal } => {
                let (normal, inside) = shade::facing_normal(*direction, *normal);
                Answer::Facing { normal, inside }
            }
            Ask::Ambient { material, light, inside } => {
                Answer::Colour(shade::ambient(material, light, *inside))
            }
            Ask::LightTerm { material, arriving, normal, to_viewer, to_light } => Answer::Colour(
                shade::light_term(material, *arriving, *normal, *to_viewer, *to_light),
            ),
            Ask::Shade { scene, object, point, normal, to_viewer, inside } => {
                let at = surface::Surface {
                    point: *point,
                    direction: -*to_viewer,
                    n_geom: *normal,
                    n_shading: *normal,
                    inside: *inside,
                    material: &scene.materials[scene.objects[*object].material],
                };
                Answer::Colour(shade::shade(scene, &at))
            }
            Ask::ToLight { light, point } => {
                let (direction, t) = light::to_light(light, *point);
                Answer::ToLight { direction, t }
            }
            Ask::Shadow { scene, light, point } => {
                Answer::Colour(trace::unblocked_share(scene, &scene.lights[*light], *point))
            }
            Ask::Reflect { direction, normal } => {
                Answer::Vector(reflection::reflect(*direction, *normal))
            }
            Ask::GoesOn { depth, max_depth, weight, threshold } => {
                Answer::GoesOn(reflection::goes_on(*depth, *max_depth, *weight, *threshold))
            }
            Ask::Indices { inside, index } => {
                let (eta_i, eta_t) = refraction::indices(*inside, *index);
                Answer::Indices { eta_i, eta_t }
            }
            Ask::Refract { direction, normal, eta_i, eta_t } => {
                Answer::from_direction(refraction::refract(*direction, *normal, *eta_i, *eta_t))
            }
            Ask::Trace { scene, ray, depth } => {
                let path = Path { kind: RayKind::Eye, depth: *depth, weight: DVec3::ONE };
                Answer::Colour(trace::trace(scene, ray, &path))
            }
            Ask::RayToObject { ray, object_from_world } => {
                let ray = transform::ray_to_object(ray, object_from_world);
                Answer::Ray { origin: ray.origin, direction: ray.direction }
            }
            Ask::NormalToWorld { normal, object_from_world } => {
                Answer::Vector(transform::normal_to_world(*normal, object_from_world))
            }
            Ask::TransformedSphere { ray, world_from_object, object_from_world } => {
                let sphere = Object {
                    name: "sphere".to_owned(),
                    shape: Shape::Sphere { center: DVec3::ZERO, radius: 0.5 },
                    material: 0,
                    world_from_object: *world_from_object,
                    object_from_world: *object_from_world,
                };
                Answer::from_hit(object::intersect_transformed(&sphere, ray))
            }
            Ask::Barycentric { a, b, c, q } => Answer::Vector(smooth::barycentric(*a, *b, *c, *q)),
            Ask::Interpolate { weights, normals } => {
                Answer::Vector(smooth::interpolate_normal(*weights, *normals))
            }
            Ask::SmoothReflect { direction, n_geom, n_shading } => {
                Answer::Vector(smooth::smooth_reflect(*direction, *n_geom, *n_shading))
            }
            Ask::SmoothRefract { direction, n_geom, n_shading, eta_i, eta_t } => {
                Answer::from_direction(smooth::smooth_refract(
                    *direction, *n_geom, *n_shading, *eta_i, *eta_t,
                ))
            }
        }
    }
}
