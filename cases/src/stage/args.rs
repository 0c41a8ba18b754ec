//! The arguments of questions of unit checks: the written form of each kind, and its value.

use std::borrow::Cow;

use glam::{DAffine3, DVec3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use toml::de::DeValue;

use super::named::{Named, by_name, scene_of};
use crate::problem::quoted;
use crate::ray::Ray;
use crate::scene::raw::numbers::{
    Colour, Depth, Direction, Index, NonNegative, Number, Point, Side, Size, Travel,
};
use crate::scene::raw::objects::RawTransform;
use crate::scene::raw::read::{At, Each, Notes, Read, Table, Value, table};
use crate::scene::raw::{RawCamera, RawLight};
use crate::scene::{Camera, Light, Material, Scene, resolve, transform};

/// A kind of argument.
pub(super) trait Arg {
    /// The type of the argument in the question.
    type Out;
    /// The values of the key, for people.
    const TAKES: &'static str;

    /// Reads the argument that `key` of `table` gives. Returns `None` after a problem.
    fn take(key: &str, table: &Table<'_>, named: &Named, notes: &mut Notes) -> Option<Self::Out>;
}

/// Declares kinds of argument that depend on nothing else in the file.
macro_rules! plain {
    ($($name:ident($takes:literal) $raw:ty => $out:ty, $make:expr;)*) => {$(
        pub(super) struct $name;

        impl Arg for $name {
            type Out = $out;
            const TAKES: &'static str = $takes;

            fn take(key: &str, table: &Table<'_>, _: &Named, notes: &mut Notes) -> Option<$out> {
                let make: fn($raw, &mut Notes) -> Option<$out> = $make;
                make(table.field::<$raw>(key, notes)?, notes)
            }
        }
    )*};
}

plain! {
    Vector("[x, y, z]") Point => DVec3, |v, _| Some(v.get());
    Unit("a direction") Direction => DVec3, |v, _| Some(v.get());
    Units("three directions") [Direction; 3] => [DVec3; 3], |all, _| Some(all.map(Direction::get));
    Rgb("[r, g, b], each at least 0") Colour => DVec3, |c, _| Some(c.get());
    Real("a number") Number => f64, |x, _| Some(x.get());
    Length("a number above 0") Size => f64, |x, _| Some(x.get());
    Coefficient("a number of at least 0") NonNegative => f64, |x, _| Some(x.get());
    Distance("a number of at least 0, or inf") Bound => f64, |x, _| Some(x.0);
    Flag("true or false") bool => bool, |flag, _| Some(flag);
    Levels("a whole number from 0 to 64") Depth => u32, |depth, _| Some(depth.0);
    Pixels("a whole number of pixels") Side => u32, |side, _| Some(side.0);
    Pixel("[column, row], from 0 at the top \
        left") [Index; 2] => [u32; 2], |pixel, _| Some(pixel.map(|index| index.0));
    CameraTable("a camera, as in a \
        scene") RawCamera => Camera, |raw, notes| resolve::camera(&raw, notes);
    LightTable("a light, as in a \
        scene") RawLight => Light, |raw, notes| resolve::light(&raw, notes);
    RayTable("a ray") RawRay => Ray, |raw, notes| raw.resolve(notes);
}

table! {
    /// A ray of a question.
    "a ray" RawRay {
        /// The point at t = 0.
        origin: Point,
        /// The direction, of any length but zero. It is not normalised.
        direction: Travel,
        /// Open lower end of the interval.
        t_min: Bound = "1e-6",
        /// Open upper end of the interval.
        t_max: At<Bound> = "inf",
    }
}

impl RawRay {
    fn resolve(&self, notes: &mut Notes) -> Option<Ray> {
        let (t_min, t_max) = (self.t_min.0, self.t_max.0);
        if t_min >= t_max {
            notes.add(
                self.t_max.span.clone(),
                "the ray's interval is empty",
                "`t_max` must be above `t_min`",
            );
            return None;
        }
        Some(Ray { origin: self.origin.get(), direction: self.direction.get(), t_min, t_max })
    }
}

/// A number of at least 0, or infinity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound(f64);

impl Read for Bound {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let is_infinite = matches!(
            value.get_ref(),
            DeValue::Float(float) if matches!(float.as_str(), "inf" | "+inf")
        );
        if is_infinite {
            Some(Self(f64::INFINITY))
        } else {
            NonNegative::read(value, notes).map(|x| Self(x.get()))
        }
    }
}

impl JsonSchema for Bound {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Bound".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "number", "minimum": 0 })
    }
}

/// The name of a scene of the file.
pub(super) struct SceneName;

impl Arg for SceneName {
    type Out = Box<Scene>;
    const TAKES: &'static str = "the name of one of the file's `[scenes]`";

    fn take(key: &str, table: &Table<'_>, named: &Named, notes: &mut Notes) -> Option<Box<Scene>> {
        let name = table.field::<At<String>>(key, notes)?;
        by_name(&named.scenes, "scenes", &name, notes).cloned().map(Box::new)
    }
}

/// The name of a material of the file.
pub(super) struct MaterialName;

impl Arg for MaterialName {
    type Out = Material;
    const TAKES: &'static str = "the name of one of the file's `[materials]`";

    fn take(key: &str, table: &Table<'_>, named: &Named, notes: &mut Notes) -> Option<Material> {
        let name = table.field::<At<String>>(key, notes)?;
        by_name(&named.materials, "materials", &name, notes).cloned()
    }
}

/// The name of an object of the question's scene.
pub(super) struct ObjectName;

impl Arg for ObjectName {
    type Out = usize;
    const TAKES: &'static str = "the name of an object of that scene";

    fn take(key: &str, table: &Table<'_>, named: &Named, notes: &mut Notes) -> Option<usize> {
        let name = table.field::<At<String>>(key, notes)?;
        let objects = &scene_of(table, named)?.objects;
        let found = objects.iter().position(|object| object.name == name.value);
        if found.is_none() {
            let problem = notes.add(
                name.span.clone(),
                format!("no object is called `{}`", name.value),
                "not in this scene",
            );
            problem.help(format!(
                "its objects are {}",
                quoted(objects.iter().map(|object| object.name.as_str()))
            ));
        }
        found
    }
}

/// The index of a light of the question's scene.
pub(super) struct LightIndex;

impl Arg for LightIndex {
    type Out = usize;
    const TAKES: &'static str = "the index of a light of that scene, from 0";

    fn take(key: &str, table: &Table<'_>, named: &Named, notes: &mut Notes) -> Option<usize> {
        let index = table.field::<At<Index>>(key, notes)?;
        let n_lights = scene_of(table, named)?.lights.len();
        let found = index.value.0 as usize;
        if found >= n_lights {
            let label = format!("the scene has {n_lights}, counted from 0");
            notes.add(index.span.clone(), format!("there is no light {found}"), label);
            return None;
        }
        Some(found)
    }
}

/// M, from the question's list of transforms.
pub(super) struct WorldFromObject;

impl Arg for WorldFromObject {
    type Out = DAffine3;
    const TAKES: &'static str = "a list of transforms, as for an object";

    fn take(key: &str, table: &Table<'_>, _: &Named, notes: &mut Notes) -> Option<DAffine3> {
        let steps = table.field::<At<Each<At<RawTransform>>>>(key, notes)?;
        let map = resolve::product(&steps, notes);
        if !transform::is_invertible(&map) {
            notes.add(
                steps.span.clone(),
                "these transforms are singular, or nearly so",
                "all of them together",
            );
            return None;
        }
        Some(map)
    }
}

/// M⁻¹, from the question's list of transforms.
pub(super) struct ObjectFromWorld;

impl Arg for ObjectFromWorld {
    type Out = DAffine3;
    const TAKES: &'static str = WorldFromObject::TAKES;

    fn take(key: &str, table: &Table<'_>, named: &Named, notes: &mut Notes) -> Option<DAffine3> {
        WorldFromObject::take(key, table, named, notes).map(|map| map.inverse())
    }
}
