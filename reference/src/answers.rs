//! The reference's answers to the questions of the unit checks, in f64. `docs/protocol.md` explains each question.

use cases::probe::{Answer, Ask};
use glam::DVec3;

use crate::camera::Lens;
use crate::lights::Light;
use crate::mesh;
use crate::optics;
use crate::ray::Ray;
use crate::rules::RuleSource;
use crate::shade;
use crate::shapes::{self, Cuboid, Plane, Shear, Solid, Sphere, Square, Triangle};
use crate::trace::{self, Kernel, Path, Seen};
use crate::vec3::{Affine, Vec3};
use crate::watch::Counts;
use crate::world::{Frame, Material, World};

type V = Vec3<f64>;

fn v(v: DVec3) -> V {
    Vec3::of(v)
}

/// What the function that `ask` names returns under these rules.
pub fn answer<R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    match ask {
        Ask::EyeRay { .. } | Ask::Nearest { .. } | Ask::Shade { .. } | Ask::Shadow { .. } | Ask::Trace { .. } => {
            of_scene(rules, ask)
        }
        Ask::Sphere { ray, center, radius } => {
            solid(rules, ray, Solid::Sphere(Sphere { center: v(*center), radius: *radius }))
        }
        Ask::Plane { ray, normal, k } => solid(rules, ray, Solid::Plane(Plane { normal: v(*normal), k: *k })),
        Ask::Square { ray } => solid(rules, ray, Solid::Square(Square)),
        Ask::Box { ray, min, max } => solid(rules, ray, Solid::Cuboid(Cuboid { min: v(*min), max: v(*max) })),
        Ask::Triangle { ray, a, b, c } => triangle(rules, ray, [*a, *b, *c].map(v)),
        Ask::TransformedSphere { ray, world_from_object, object_from_world } => {
            let frame = Frame {
                world_from_object: Affine::of(world_from_object),
                object_from_world: Affine::of(object_from_world),
            };
            transformed_sphere(rules, &Ray::of(ray), &frame)
        }
        Ask::RayToObject { ray, object_from_world } => {
            let ray = Frame::ray_to_object(rules, &Affine::of(object_from_world), &Ray::<f64>::of(ray));
            Answer::Ray { origin: ray.origin.f64(), direction: ray.direction.f64() }
        }
        Ask::NormalToWorld { normal, object_from_world } => {
            let frame = Frame {
                world_from_object: Affine::of(&object_from_world.inverse()),
                object_from_world: Affine::of(object_from_world),
            };
            vector(frame.normal_to_world(rules, v(*normal)))
        }
        Ask::Barycentric { a, b, c, q } => vector(shapes::barycentric([*a, *b, *c].map(v), v(*q))),
        Ask::Interpolate { weights, normals } => direction(mesh::interpolate(rules, v(*weights), normals.map(v))),
        _ => formula(rules, ask),
    }
}

/// Questions to the formulas of light.
fn formula<R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    match ask {
        Ask::Attenuation { light, r } => Answer::Value(Light::<f64>::of(light).attenuation(rules, *r)),
        Ask::FacingNormal { direction, normal } => {
            let (normal, inside) = shade::facing_normal(rules, v(*direction), v(*normal));
            Answer::Facing { normal: normal.f64(), inside }
        }
        Ask::Ambient { material, light, inside } => {
            colour(shade::ambient(rules, &Material::of(material), &Light::<f64>::of(light), 0, *inside))
        }
        Ask::LightTerm { material, arriving, normal, to_viewer, to_light } => {
            let [arriving, normal, to_viewer, to_light] = [*arriving, *normal, *to_viewer, *to_light].map(v);
            colour(shade::light_term(rules, &Material::of(material), arriving, normal, to_viewer, to_light))
        }
        Ask::ToLight { light, point } => match Light::<f64>::of(light).seen_from(rules, v(*point)) {
            Some((direction, t)) => Answer::ToLight { direction: direction.f64(), t },
            None => Answer::Miss(true),
        },
        Ask::Reflect { direction, normal } => vector(optics::reflect(rules, v(*direction), v(*normal))),
        Ask::GoesOn { depth, max_depth, weight, threshold } => {
            Answer::GoesOn(trace::goes_on(rules, *depth, *max_depth, v(*weight), *threshold))
        }
        Ask::Indices { inside, index } => {
            let (eta_i, eta_t) = optics::indices(rules, *inside, *index);
            Answer::Indices { eta_i, eta_t }
        }
        Ask::Refract { direction: d, normal, eta_i, eta_t } => {
            direction(optics::refract(rules, v(*d), v(*normal), *eta_i, *eta_t))
        }
        Ask::SmoothReflect { direction, n_geom, n_shading } => {
            vector(optics::smooth_reflect(rules, v(*direction), v(*n_geom), v(*n_shading)))
        }
        Ask::SmoothRefract { direction: d, n_geom, n_shading, eta_i, eta_t } => {
            direction(optics::smooth_refract(rules, v(*d), v(*n_geom), v(*n_shading), (*eta_i, *eta_t)))
        }
        _ => unreachable!("`answer` hands over formulas alone"),
    }
}

/// Questions that bring a scene or a camera.
fn of_scene<R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    match ask {
        Ask::EyeRay { camera, width, height, pixel: [i, j] } => {
            let ray = Lens::<f64>::new(rules, camera, *width, *height).eye_ray(rules, (*i, *j), (0.5, 0.5));
            Answer::Ray { origin: ray.origin.f64(), direction: ray.direction.f64() }
        }
        Ask::Nearest { scene, ray } => match World::<f64>::new(scene).first(rules, &Ray::of(ray)) {
            Some((object, met)) => Answer::Found { t: met.t, object },
            None => Answer::Miss(true),
        },
        Ask::Shade { scene, object, point, normal, to_viewer, inside } => {
            let Some(object) = scene.objects.get(*object) else { return no_such("object") };
            let [point, normal, to_viewer] = [*point, *normal, *to_viewer].map(v);
            let seen = Seen { point, normal, to_viewer, is_inside: *inside, material: object.material };
            let world = World::<f64>::new(scene);
            colour(Kernel::new(&world, rules, scene.effects).shade(&seen, &mut Counts::default()))
        }
        Ask::Shadow { scene, light, point } => {
            let world = World::<f64>::new(scene);
            let Some(light) = world.lights.get(*light) else { return no_such("light") };
            let Some((to_light, r)) = light.seen_from(rules, v(*point)) else { return colour(Vec3::ONE) };
            let kernel = Kernel::new(&world, rules, scene.effects);
            colour(kernel.shadow(v(*point), to_light, r, &mut Counts::default()))
        }
        Ask::Trace { scene, ray, depth } => {
            let world = World::<f64>::new(scene);
            let kernel = Kernel::new(&world, rules, scene.effects);
            colour(kernel.trace(&Ray::of(ray), Path::eye(*depth), &mut Counts::default()))
        }
        _ => unreachable!("`answer` hands over scenes alone"),
    }
}

fn solid<R: RuleSource>(rules: R, ray: &cases::Ray, solid: Solid<f64>) -> Answer {
    let ray = Ray::of(ray);
    match solid.meet(rules, &ray) {
        Some(met) => hit(met.t, solid.normal(rules, ray.at(met.t), met.part)),
        None => Answer::Miss(true),
    }
}

fn triangle<R: RuleSource>(rules: R, ray: &cases::Ray, corners: [V; 3]) -> Answer {
    let (ray, triangle) = (Ray::of(ray), Triangle { corners });
    let met = if triangle.has_area() { triangle.meet(rules, &ray, &Shear::of(&ray), 0) } else { None };
    met.map_or(Answer::Miss(true), |met| hit(met.t, triangle.normal(rules)))
}

fn transformed_sphere<R: RuleSource>(rules: R, ray: &Ray<f64>, frame: &Frame<f64>) -> Answer {
    let sphere = Solid::Sphere(Sphere { center: Vec3::ZERO, radius: 0.5 });
    let moved = Frame::ray_to_object(rules, &frame.object_from_world, ray);
    match sphere.meet(rules, &moved) {
        Some(met) => hit(met.t, frame.normal_to_world(rules, sphere.normal(rules, moved.at(met.t), met.part))),
        None => Answer::Miss(true),
    }
}

fn no_such(what: &str) -> Answer {
    Answer::Panic(format!("the scene has no such {what}"))
}

fn hit(t: f64, normal: V) -> Answer {
    Answer::Hit { t, normal: normal.f64() }
}

fn colour(colour: V) -> Answer {
    Answer::Colour(colour.f64())
}

fn vector(vector: V) -> Answer {
    Answer::Vector(vector.f64())
}

fn direction(direction: Option<V>) -> Answer {
    Answer::from_direction(direction.map(V::f64))
}
