//! Decides which effects change the picture of a scene under a course, and why.

use glam::{DAffine3, DVec3};
use serde::Serialize;

use super::{Effect, Effects};
use crate::course::{Course, InsideNormal, Lobe, Near, ShadowTint, TwoSided};
use crate::scene::{Attenuation, Light, Material, Object, Scene, Shape};

/// The reason why a scene calls for an effect, or why it does not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Reason {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene calls for it under the course.
    pub called_for: bool,
    /// A phrase that names the cause, such as `material "glass" has kt > 0`.
    pub because: String,
}

/// Returns the effects that change the picture of `scene` under `course`; [`reasons`] says why.
///
/// An effect that is left out of the set changes no bit of the picture when it is simulated.
pub fn called_for(scene: &Scene, course: &Course) -> Effects {
    let reasons = reasons(scene, course).into_iter();
    reasons.filter(|reason| reason.called_for).map(|reason| reason.effect).collect()
}

/// Returns a [`Reason`] for every effect, in the order of [`Effect::ALL`].
pub fn reasons(scene: &Scene, course: &Course) -> Vec<Reason> {
    let reason = |effect| match verdict(scene, course, effect) {
        Ok(because) => Reason { effect, called_for: true, because },
        Err(because) => Reason { effect, called_for: false, because },
    };
    Effect::ALL.into_iter().map(reason).collect()
}

/// Makes `scene` request `effects` and no others.
///
/// Transforms and attenuation are properties of objects and lights, and no tracer can leave them
/// out by itself. Without transforms, every matrix becomes the identity. Without attenuation, no
/// light weakens.
pub fn simulate_only(scene: &mut Scene, effects: Effects) {
    scene.effects = effects;
    if !effects.has(Effect::Transforms) {
        for object in &mut scene.objects {
            (object.world_from_object, object.object_from_world) =
                (DAffine3::IDENTITY, DAffine3::IDENTITY);
        }
    }
    if !effects.has(Effect::Attenuation) {
        for light in &mut scene.lights {
            if let Light::Point { attenuation, .. } = light {
                *attenuation = Attenuation::NONE;
            }
        }
    }
}

/// Returns `Ok(why)` where `scene` calls for `effect` under `course`, otherwise `Err(why not)`.
fn verdict(scene: &Scene, course: &Course, effect: Effect) -> Result<String, String> {
    match effect {
        Effect::Shadows => shadows(scene, course),
        Effect::TintedShadows => tinted_shadows(scene, course),
        Effect::Reflection => spawning(scene, "kr", |m| m.kr),
        Effect::Refraction => spawning(scene, "kt", |m| m.kt),
        Effect::SmoothNormals => smooth_normals(scene, course),
        Effect::Transforms => named(
            scene.objects.iter().find(|object| !object.is_untransformed()),
            |object| format!("{} has a matrix that is not the identity", object.name),
            "every object's matrix is the identity",
        ),
        Effect::Attenuation => named(
            scene.lights.iter().position(|light| weakens(light, course)),
            |j| format!("lights[{j}] weakens with distance"),
            "no light that shines weakens with distance",
        ),
        Effect::AdaptiveDepth => adaptive_depth(scene),
    }
}

fn shadows(scene: &Scene, course: &Course) -> Result<String, String> {
    if scene.lights.iter().all(|light| light.colour() == DVec3::ZERO) {
        return Err("no light shines".into());
    }
    if scene.objects.is_empty() {
        return Err("there is no object".into());
    }
    if !scene.objects.iter().any(|object| shows_lights(scene, course, object)) {
        return Err("no object has kd or ks in a colour in which a light shines".into());
    }
    if !scene.objects.iter().any(|object| blocks(scene, course, object)) {
        return Err(
            "every object is transparent, and in this course such an object casts no shadow".into(),
        );
    }
    match scene.objects.as_slice() {
        [only] if !shadows_itself(scene, course, only) => {
            Err(format!("{} is alone and cannot shadow itself", only.name))
        }
        [only] => Ok(format!("{} can shadow itself", only.name)),
        _ => Ok("one object can hide a light from another".into()),
    }
}

fn tinted_shadows(scene: &Scene, course: &Course) -> Result<String, String> {
    shadows(scene, course)?;
    let because = material_with(scene, "kt", |m| m.kt)?;
    match course.tint {
        ShadowTint::Opaque => Err("in this course a transparent object blocks all light".into()),
        ShadowTint::PerCrossing | ShadowTint::PerObject | ShadowTint::Nothing => Ok(because),
    }
}

/// Returns whether `object` weakens a shadow ray that crosses it. [rule 6]
fn blocks(scene: &Scene, course: &Course, object: &Object) -> bool {
    course.tint != ShadowTint::Nothing || scene.material(object).kt == DVec3::ZERO
}

/// Returns whether `object` reflects something of a light directly: whether I ⊙ (kd + ks) is above
/// 0 for some light. Other highlights than the lecture's are assumed to. [rule 3]
fn shows_lights(scene: &Scene, course: &Course, object: &Object) -> bool {
    let material = scene.material(object);
    let shows = |light: &Light| light.colour() * (material.kd + material.ks) != DVec3::ZERO;
    course.highlight != Lobe::Blinn || scene.lights.iter().any(shows)
}

/// Returns whether a light weakens with distance. A black light has nothing to lose. Clamped to 1,
/// a constant of at most 1 weakens nothing. [rule 4]
fn weakens(light: &Light, course: &Course) -> bool {
    let Light::Point { attenuation, colour, .. } = light else { return false };
    let Attenuation { quadratic, linear, constant } = *attenuation;
    let is_clamped_to_1 =
        course.attenuation == Near::Clamped && (quadratic, linear) == (0.0, 0.0) && constant <= 1.0;
    *attenuation != Attenuation::NONE && !is_clamped_to_1 && *colour != DVec3::ZERO
}

/// Vertex normals matter where a surface reflects a light or spawns rays. By interpolated normals a
/// course may also decide whether a ray is inside, and with it about ambient light. [rule 18]
fn smooth_normals(scene: &Scene, course: &Course) -> Result<String, String> {
    let mut smooth = scene.objects.iter().filter(|object| has_normals(scene, object)).peekable();
    if smooth.peek().is_none() {
        return Err("no mesh carries vertex normals".into());
    }
    let matters = |object: &&Object| {
        let material = scene.material(object);
        course.inside_by == InsideNormal::Interpolated
            || material.kr.max(material.kt) != DVec3::ZERO
            || shows_lights(scene, course, object)
    };
    named(
        smooth.find(matters),
        |object| format!("mesh {} carries vertex normals", object.name),
        "no mesh with vertex normals reflects a light or spawns rays",
    )
}

fn adaptive_depth(scene: &Scene) -> Result<String, String> {
    let threshold = scene.render.threshold;
    if threshold <= 0.0 {
        return Err("render.threshold is 0".into());
    }
    let spawns = spawning(scene, "kr", |m| m.kr).or_else(|_| spawning(scene, "kt", |m| m.kt));
    spawns
        .map(|_| format!("render.threshold is {threshold}"))
        .map_err(|_| format!("render.threshold is {threshold}, but no object spawns rays"))
}

/// Returns whether `object` may occlude a light from a lit point of itself.
///
/// A flat shape cannot. A sphere or box can where its inside is seen, by an eye inside it or by
/// refraction, and where the course lights the side that faces away from a light. Cylinders, cones
/// and meshes are assumed to. [rule 3]
fn shadows_itself(scene: &Scene, course: &Course, object: &Object) -> bool {
    let eye = object.object_from_world.transform_point3(scene.camera.eye);
    let eye_is_inside = match object.shape {
        Shape::Plane { .. } | Shape::Square {} => return false,
        Shape::Sphere { center, radius } => eye.distance(center) <= radius,
        Shape::Box { min, max } => eye.cmpge(min).all() && eye.cmple(max).all(),
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Mesh { .. } => return true,
    };
    let is_lit_from_behind = course.two_sided == TwoSided::Always;
    eye_is_inside || is_lit_from_behind || scene.material(object).kt.max_element() > 0.0
}

fn has_normals(scene: &Scene, object: &Object) -> bool {
    matches!(object.shape, Shape::Mesh { mesh } if scene.meshes[mesh].normals.is_some())
}

/// Returns whether surfaces with a `colour` above 0 spawn rays, with the reason. At `max_depth` 0,
/// no course spawns any. [rule 13]
fn spawning(scene: &Scene, key: &str, colour: fn(&Material) -> DVec3) -> Result<String, String> {
    let because = material_with(scene, key, colour)?;
    if scene.render.max_depth == 0 { Err("render.max_depth is 0".into()) } else { Ok(because) }
}

fn material_with(
    scene: &Scene,
    key: &str,
    colour: fn(&Material) -> DVec3,
) -> Result<String, String> {
    named(
        scene
            .objects
            .iter()
            .map(|object| scene.material(object))
            .find(|m| colour(m).max_element() > 0.0),
        |material| format!("material \"{}\" has {key} > 0", material.name),
        &format!("no object's material has {key} > 0"),
    )
}

fn named<T>(found: Option<T>, why: impl Fn(T) -> String, why_not: &str) -> Result<String, String> {
    found.map(why).ok_or_else(|| why_not.to_owned())
}
