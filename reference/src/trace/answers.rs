//! The reference's answers to the questions of the unit checks, in either precision.
//! `docs/protocol.md` explains each question.

use cases::Effect;
use cases::probe::{Answer, Ask};
use glam::DVec3;

use crate::light::lights::Light;
use crate::light::material::Material;
use crate::light::optics;
use crate::light::shade;
use crate::numbers::real::Real;
use crate::numbers::vec3::{Affine, Vec3};
use crate::rays::camera::Lens;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{RuleSource, Rules, Start};
use crate::shapes::{self, Cuboid, Plane, Shear, Solid, Sphere, Square, Triangle};
use crate::trace::kernel::{self, Kernel, Path, ShadingPoint};
use crate::watch::Counts;
use crate::world::mesh;
use crate::world::{Frame, Search, World};

fn v<T: Real>(v: DVec3) -> Vec3<T> {
    Vec3::of(v)
}

/// Returns the result of the function that `ask` names under these rules, computed in f64.
///
/// ```
/// use cases::{Ray, glam::DVec3, probe::{Answer, Ask}};
/// use reference::{rules::Lecture, trace::answers::answer};
///
/// let ray = Ray::new(DVec3::new(0.0, 0.0, 2.0), DVec3::NEG_Z);
/// let ask = Ask::Sphere { ray, center: DVec3::ZERO, radius: 0.5 };
/// // The ray runs from z = 2 to the sphere's surface at z = 0.5.
/// assert_eq!(answer(Lecture, &ask), Answer::Hit { t: 1.5, normal: DVec3::Z });
/// ```
pub fn answer<R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    answer_in::<f64, R>(rules, ask)
}

/// Returns the result of the function that `ask` names under these rules, computed in the precision
/// `T`. A scene without the object or light that the question names gives [`Answer::Panic`].
pub fn answer_in<T: Real, R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    match ask {
        Ask::EyeRay { .. }
        | Ask::Nearest { .. }
        | Ask::Shade { .. }
        | Ask::Shadow { .. }
        | Ask::Trace { .. } => of_scene::<T, R>(rules, ask),
        Ask::Sphere { ray, center, radius } => solid(
            rules,
            ray,
            Solid::<T>::Sphere(Sphere { center: v(*center), radius: T::of(*radius) }),
        ),
        Ask::Plane { ray, normal, k } => {
            solid(rules, ray, Solid::<T>::Plane(Plane { normal: v(*normal), k: T::of(*k) }))
        }
        Ask::Square { ray } => solid(rules, ray, Solid::<T>::Square(Square)),
        Ask::Box { ray, min, max } => {
            solid(rules, ray, Solid::<T>::Cuboid(Cuboid { min: v(*min), max: v(*max) }))
        }
        Ask::Triangle { ray, a, b, c } => triangle(rules, ray, [*a, *b, *c].map(v::<T>)),
        Ask::TransformedSphere { ray, world_from_object, object_from_world } => {
            transformed_sphere::<T, R>(
                rules,
                &Ray::of(ray),
                &Frame::of(world_from_object, object_from_world),
            )
        }
        Ask::RayToObject { ray, object_from_world } => {
            let ray =
                Frame::ray_to_object(rules, &Affine::of(object_from_world), &Ray::<T>::of(ray));
            Answer::Ray { origin: ray.origin.f64(), direction: ray.direction.f64() }
        }
        Ask::NormalToWorld { normal, object_from_world } => {
            vector::<T>(Frame::of_inverse(object_from_world).normal_to_world(rules, v(*normal)))
        }
        Ask::Barycentric { a, b, c, q } => {
            vector(shapes::barycentric(rules, [*a, *b, *c].map(v::<T>), v(*q)))
        }
        Ask::Interpolate { weights, normals } => {
            direction(mesh::interpolate(rules, v::<T>(*weights), normals.map(v)))
        }
        _ => formula::<T, R>(rules, ask),
    }
}

/// Returns the answer to a question about the formulas of light.
fn formula<T: Real, R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    match ask {
        Ask::Attenuation { light, r } => {
            Answer::Value(Light::<T>::of(light).attenuation(rules, T::of(*r), &mut ()).f64())
        }
        Ask::FacingNormal { direction, normal } => {
            let (normal, inside) = shade::facing_normal(rules, v::<T>(*direction), v(*normal));
            Answer::Facing { normal: normal.f64(), inside }
        }
        Ask::Ambient { material, light, inside } => colour(shade::ambient(
            rules,
            &Material::of(material),
            &Light::<T>::of(light),
            0,
            *inside,
        )),
        Ask::LightTerm { material, arriving, normal, to_viewer, to_light } => {
            let [arriving, normal, to_viewer, to_light] =
                [*arriving, *normal, *to_viewer, *to_light].map(v::<T>);
            colour(shade::light_term(
                rules,
                &Material::of(material),
                arriving,
                normal,
                to_viewer,
                to_light,
                &mut (),
            ))
        }
        Ask::ToLight { light, point } => {
            match Light::<T>::of(light).direction_from(rules, v(*point)) {
                Some((direction, t)) => Answer::ToLight { direction: direction.f64(), t: t.f64() },
                None => Answer::Miss(true),
            }
        }
        Ask::Reflect { direction, normal } => {
            vector(optics::reflect(rules, v::<T>(*direction), v(*normal)))
        }
        Ask::GoesOn { depth, max_depth, weight, threshold } => Answer::GoesOn(kernel::goes_on(
            rules,
            *depth,
            *max_depth,
            v::<T>(*weight),
            T::of(*threshold),
        )),
        Ask::Indices { inside, index } => {
            let (eta_i, eta_t) = optics::indices(rules, *inside, T::of(*index));
            Answer::Indices { eta_i: eta_i.f64(), eta_t: eta_t.f64() }
        }
        Ask::Refract { direction: d, normal, eta_i, eta_t } => {
            direction(optics::refract(rules, v::<T>(*d), v(*normal), T::of(*eta_i), T::of(*eta_t)))
        }
        Ask::SmoothReflect { direction, n_geom, n_shading } => {
            vector(optics::smooth_reflect(rules, v::<T>(*direction), v(*n_geom), v(*n_shading)))
        }
        Ask::SmoothRefract { direction: d, n_geom, n_shading, eta_i, eta_t } => {
            let etas = (T::of(*eta_i), T::of(*eta_t));
            direction(optics::smooth_refract(rules, v(*d), v(*n_geom), v(*n_shading), etas))
        }
        _ => unreachable!("`answer_in` passes only formulas"),
    }
}

/// Returns the answer to a question with a scene or a camera.
fn of_scene<T: Real, R: RuleSource>(rules: R, ask: &Ask) -> Answer {
    match ask {
        Ask::EyeRay { camera, width, height, pixel: [i, j] } => {
            let ray = Lens::<T>::new(rules, camera, *width, *height).eye_ray(
                rules,
                (*i, *j),
                (T::of(0.5), T::of(0.5)),
            );
            Answer::Ray { origin: ray.origin.f64(), direction: ray.direction.f64() }
        }
        Ask::Nearest { scene, ray } => {
            match World::<T>::with_search(scene, Search::Scan).first(rules, &Ray::of(ray), &mut ())
            {
                Some((object, found)) => Answer::Found { t: found.t.f64(), object },
                None => Answer::Miss(true),
            }
        }
        Ask::Shade { scene, object, point, normal, to_viewer, inside } => {
            let Some(object) = scene.objects.get(*object) else { return no_such("object") };
            let [point, normal, to_viewer] = [*point, *normal, *to_viewer].map(v::<T>);
            let is_inside = *inside;
            let hit_point = HitPoint { point, error: Vec3::ZERO, n_geom: normal };
            let at =
                ShadingPoint { hit_point, normal, to_viewer, is_inside, material: object.material };
            let world = World::<T>::with_search(scene, Search::Scan);
            let rules = of_given_point(rules);
            colour(Kernel::new(&world, &rules, scene.effects).without_proofs().shade(
                &at,
                Vec3::ONE,
                &mut Counts::default(),
            ))
        }
        Ask::Shadow { scene, light, point } => {
            let world = World::<T>::with_search(scene, Search::Scan);
            let Some(light) = world.lights.get(*light) else { return no_such("light") };
            let Some((to_light, r)) = light.direction_from(rules, v(*point)) else {
                return colour(Vec3::<T>::ONE);
            };
            let rules = of_given_point(rules);
            // S is wanted even where no surface of the scene would show it.
            let effects = scene.effects.with(Effect::Shadows).with(Effect::TintedShadows);
            let kernel = Kernel::new(&world, &rules, effects).without_proofs();
            // The question has no normal, and `to_light` replaces it: a style that moves the origin
            // along the normal moves it along the ray.
            let hit_point = HitPoint { point: v(*point), error: Vec3::ZERO, n_geom: to_light };
            colour(kernel.shadow(&hit_point, to_light, r, &mut Counts::default()))
        }
        Ask::Trace { scene, ray, depth } => {
            let world = World::<T>::with_search(scene, Search::Scan);
            let kernel = Kernel::new(&world, rules, scene.effects).without_proofs();
            colour(kernel.trace(&Ray::of(ray), Path::eye(*depth), &mut Counts::default()))
        }
        _ => unreachable!("`answer_in` passes only scenes"),
    }
}

/// Returns the rules for a point given by a question. There is no hit to bound the distance of the
/// point from its surface, so RAY_EPSILON replaces the bound. [rule 21]
fn of_given_point(rules: impl RuleSource) -> Rules {
    let mut rules = *rules.get();
    if rules.style.start == Start::OffBound {
        rules.style.start = Start::Interval;
    }
    rules
}

fn solid<T: Real, R: RuleSource>(rules: R, ray: &cases::Ray, solid: Solid<T>) -> Answer {
    let ray = Ray::of(ray);
    match solid.intersect(rules, &ray) {
        Some(found) => hit(found.t, solid.normal_at_hit(rules, &ray, &found)),
        None => Answer::Miss(true),
    }
}

fn triangle<T: Real, R: RuleSource>(rules: R, ray: &cases::Ray, corners: [Vec3<T>; 3]) -> Answer {
    let (ray, triangle) = (Ray::of(ray), Triangle { corners });
    let found = if triangle.has_area() {
        triangle.intersect(rules, &ray, &Shear::of(&ray), 0)
    } else {
        None
    };
    found.map_or(Answer::Miss(true), |found| hit(found.t, triangle.normal(rules)))
}

fn transformed_sphere<T: Real, R: RuleSource>(rules: R, ray: &Ray<T>, frame: &Frame<T>) -> Answer {
    let sphere = Solid::Sphere(Sphere { center: Vec3::ZERO, radius: T::of(0.5) });
    match sphere.hit_under(rules, frame, ray) {
        Some((t, normal)) => hit(t, normal),
        None => Answer::Miss(true),
    }
}

fn no_such(what: &str) -> Answer {
    Answer::Panic(format!("the scene has no such {what}"))
}

fn hit<T: Real>(t: T, normal: Vec3<T>) -> Answer {
    Answer::Hit { t: t.f64(), normal: normal.f64() }
}

fn colour<T: Real>(colour: Vec3<T>) -> Answer {
    Answer::Colour(colour.f64())
}

fn vector<T: Real>(vector: Vec3<T>) -> Answer {
    Answer::Vector(vector.f64())
}

fn direction<T: Real>(direction: Option<Vec3<T>>) -> Answer {
    Answer::from_direction(direction.map(Vec3::f64))
}
