//! What an effect is, and which ones a scene calls for: the only place that says so.

use std::fmt;

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};

use crate::scene::{Attenuation, Light, Object, Scene, Shape};

/// Something a tracer may simulate beyond eye rays and local light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// Surfaces hide lights. [rule 5]
    Shadows,
    /// Shadows take the colour of what the light goes through. [rule 6]
    TintedShadows,
    /// Mirrored rays. [rule 7]
    Reflection,
    /// Transmitted rays. [rule 8]
    Refraction,
    /// Shading by interpolated vertex normals. [rule 18]
    SmoothNormals,
    /// Objects whose matrix is not the identity. [rule 20]
    Transforms,
    /// Light that weakens with distance. [rule 4]
    Attenuation,
    /// Paths cut where their weight no longer matters. [rule 13]
    AdaptiveDepth,
}

impl Effect {
    /// Every effect, in the order in which they are listed.
    pub const ALL: [Self; 8] = [
        Self::Shadows,
        Self::TintedShadows,
        Self::Reflection,
        Self::Refraction,
        Self::SmoothNormals,
        Self::Transforms,
        Self::Attenuation,
        Self::AdaptiveDepth,
    ];

    /// Its name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shadows => "shadows",
            Self::TintedShadows => "tinted_shadows",
            Self::Reflection => "reflection",
            Self::Refraction => "refraction",
            Self::SmoothNormals => "smooth_normals",
            Self::Transforms => "transforms",
            Self::Attenuation => "attenuation",
            Self::AdaptiveDepth => "adaptive_depth",
        }
    }

    /// The effect of that name, if there is one.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of effects. In JSON: a list of names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(from = "Vec<Effect>", into = "Vec<Effect>")]
pub struct Effects(u16);

impl Effects {
    /// No effect: eye rays and local light.
    pub const NONE: Self = Self(0);

    /// Every effect there is.
    pub const ALL: Self = Self((1 << Effect::ALL.len()) - 1);

    /// Every effect there is.
    pub const fn all() -> Self {
        Self::ALL
    }

    /// The set as a number: bit n stands for the n-th effect of [`Effect::ALL`].
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// The set with these bits.
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// Whether `effect` is in the set.
    pub const fn has(self, effect: Effect) -> bool {
        self.0 & (1 << effect as u16) != 0
    }

    /// The set with `effect` in it.
    #[must_use]
    pub const fn with(self, effect: Effect) -> Self {
        Self(self.0 | (1 << effect as u16))
    }

    /// The set with `effect` taken out.
    #[must_use]
    pub const fn without(self, effect: Effect) -> Self {
        Self(self.0 & !(1 << effect as u16))
    }

    /// What is in both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The effects in the set, in listed order.
    pub fn iter(self) -> impl Iterator<Item = Effect> {
        Effect::ALL.into_iter().filter(move |effect| self.has(*effect))
    }
}

impl FromIterator<Effect> for Effects {
    fn from_iter<I: IntoIterator<Item = Effect>>(effects: I) -> Self {
        effects.into_iter().fold(Self::NONE, Self::with)
    }
}

impl From<Vec<Effect>> for Effects {
    fn from(effects: Vec<Effect>) -> Self {
        effects.into_iter().collect()
    }
}

impl From<Effects> for Vec<Effect> {
    fn from(effects: Effects) -> Self {
        effects.iter().collect()
    }
}

/// An effect that a scene calls for, and what in the scene does so; or one it does not call for, and why not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Reason {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene calls for it.
    pub called_for: bool,
    /// Such as `material "glass" has kt > 0`.
    pub because: String,
}

/// The effects that change the picture of `scene`; [`reasons`] says why.
pub fn called_for(scene: &Scene) -> Effects {
    reasons(scene).into_iter().filter(|reason| reason.called_for).map(|reason| reason.effect).collect()
}

/// For every effect, in listed order, whether `scene` calls for it, and why.
pub fn reasons(scene: &Scene) -> Vec<Reason> {
    Effect::ALL
        .into_iter()
        .map(|effect| match verdict(scene, effect) {
            Ok(because) => Reason { effect, called_for: true, because },
            Err(because) => Reason { effect, called_for: false, because },
        })
        .collect()
}

/// Makes `scene` ask for `effects` and no others. Two of them no tracer can leave out by itself, since they belong to objects and lights: without
/// transforms every object stays in its own space, without attenuation every light is as strong at any distance.
pub fn simulate_only(scene: &mut Scene, effects: Effects) {
    scene.effects = effects;
    if !effects.has(Effect::Transforms) {
        for object in &mut scene.objects {
            (object.world_from_object, object.object_from_world) = (DAffine3::IDENTITY, DAffine3::IDENTITY);
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

/// `Ok(why)` where `scene` calls for `effect`, else `Err(why not)`.
fn verdict(scene: &Scene, effect: Effect) -> Result<String, String> {
    match effect {
        Effect::Shadows => shadows(scene),
        Effect::TintedShadows => {
            shadows(scene)?;
            material_with(scene, "kt", |m| m.kt)
        }
        Effect::Reflection => spawning(scene, "kr", |m| m.kr),
        Effect::Refraction => spawning(scene, "kt", |m| m.kt),
        Effect::SmoothNormals => named(
            scene.objects.iter().find(|object| match object.shape {
                Shape::Mesh { mesh } => scene.meshes[mesh].normals.is_some(),
                _ => false,
            }),
            |object| format!("mesh {} carries vertex normals", object.name),
            "no mesh carries vertex normals",
        ),
        Effect::Transforms => named(
            scene.objects.iter().find(|object| !object.is_untransformed()),
            |object| format!("{} has a matrix that is not the identity", object.name),
            "every object's matrix is the identity",
        ),
        Effect::Attenuation => named(
            scene.lights.iter().position(weakens),
            |j| format!("lights[{j}] weakens with distance"),
            "no light that shines weakens with distance",
        ),
        Effect::AdaptiveDepth => named(
            (scene.render.threshold > 0.0).then_some(scene.render.threshold),
            |threshold| format!("render.threshold is {threshold}"),
            "render.threshold is 0",
        ),
    }
}

fn shadows(scene: &Scene) -> Result<String, String> {
    if scene.lights.iter().all(|light| light.colour() == DVec3::ZERO) {
        return Err("no light shines".into());
    }
    match scene.objects.as_slice() {
        [] => Err("there is no object".into()),
        [only] if !shadows_itself(scene, only) => Err(format!("{} is alone and cannot shadow itself", only.name)),
        [only] => Ok(format!("{} can shadow itself", only.name)),
        _ => Ok("one object can hide a light from another".into()),
    }
}

/// Whether some of a light's own light is lost on its way; what has no light loses none.
fn weakens(light: &Light) -> bool {
    let Light::Point { attenuation, colour, .. } = light else { return false };
    *attenuation != Attenuation::NONE && *colour != DVec3::ZERO
}

/// Whether some point of `object` that a ray can reach may be hidden from a light by `object` itself.
///
/// A flat shape cannot; a convex solid can only where a ray gets inside: from an eye in there, or by refraction.
fn shadows_itself(scene: &Scene, object: &Object) -> bool {
    let eye = object.object_from_world.transform_point3(scene.camera.eye);
    let eye_is_inside = match object.shape {
        Shape::Plane { .. } | Shape::Square {} => return false,
        Shape::Sphere { center, radius } => eye.distance(center) <= radius,
        Shape::Box { min, max } => eye.cmpge(min).all() && eye.cmple(max).all(),
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Mesh { .. } => return true,
    };
    eye_is_inside || scene.materials[object.material].kt.max_element() > 0.0
}

fn spawning(scene: &Scene, key: &str, colour: fn(&crate::Material) -> DVec3) -> Result<String, String> {
    let because = material_with(scene, key, colour)?;
    if scene.render.max_depth == 0 { Err("render.max_depth is 0".into()) } else { Ok(because) }
}

fn material_with(scene: &Scene, key: &str, colour: fn(&crate::Material) -> DVec3) -> Result<String, String> {
    named(
        scene.objects.iter().map(|object| &scene.materials[object.material]).find(|m| colour(m).max_element() > 0.0),
        |material| format!("material \"{}\" has {key} > 0", material.name),
        &format!("no object's material has {key} > 0"),
    )
}

fn named<T>(found: Option<T>, why: impl Fn(T) -> String, why_not: &str) -> Result<String, String> {
    found.map(why).ok_or_else(|| why_not.to_owned())
}
