//! How far the numbers of a case may be moved, as it is written: the `[vary]` table.

use glam::DVec3;
use schemars::JsonSchema;

use super::RawScene;
use super::numbers::{Reaches, Share, Size};
use super::objects::RawObject;
use super::read::{At, Each, Notes, Read, Value, table};
use crate::problem::{did_you_mean, quoted};
use crate::stage::Bounds;

table! {
    /// How far `reference vary` may move the numbers of this case, up or down. A kind of number that is left out here is not moved.
    /// Neither is a number that does not stand in the case file: `vary` never moves a default.
    "`[vary]`" RawVary {
        /// The eye: scene units, for all axes or for each.
        eye: Option<Reach>,
        /// The point looked at: scene units, for all axes or for each.
        look_at: Option<Reach>,
        /// The angle of view: degrees.
        fov_y_deg: Option<Size>,
        /// Positions of point lights: scene units, for all axes or for each.
        lights: Option<Reach>,
        /// Each component of a directional light's direction: a share of the longest component.
        directions: Option<Share>,
        /// Spheres with a `center`, boxes with `min` and `max`, planes and inline meshes, each as a whole; those without transforms:
        /// scene units, for all axes or for each.
        objects: Option<Reach>,
        /// Radii: a share of each.
        radii: Option<Share>,
        /// Translations in lists of transforms: units of the space moved in, for all axes or for each.
        translate: Option<Reach>,
        /// Angles in lists of transforms: degrees.
        angle_deg: Option<Size>,
        /// Factors of `scale` and amounts of `shear` in lists of transforms: a share of each.
        scale: Option<Share>,
        /// Each channel of a colour, by at most half of itself; 0 and 1 stay, and no channel crosses 1.
        colours: Option<Size>,
        /// Indices of refraction.
        indices: Option<Size>,
        /// Names of materials and objects of which nothing is moved.
        keep: Vec<At<String>> = "[]",
    }
}

/// One length, or one for each axis.
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged, inline)]
pub(crate) enum Reach {
    /// For all axes.
    Alike(Size),
    /// For x, y and z.
    Axes(Reaches),
}

impl Read for Reach {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        match value.get_ref().as_array() {
            Some(_) => Reaches::read(value, notes).map(Self::Axes),
            None => Size::read(value, notes).map(Self::Alike),
        }
    }
}

/// The bounds as plain numbers, 0 where nothing moves; names that the scene does not have are noted.
pub(crate) fn bounds(raw: &RawVary, scene: Option<&RawScene>, notes: &mut Notes) -> Bounds {
    if let Some(scene) = scene {
        let mut known: Vec<&str> = scene.materials.keys().map(String::as_str).collect();
        names(&scene.objects, &mut known);
        for name in raw.keep.iter().filter(|name| !known.contains(&name.value.as_str())) {
            let message = format!("no material and no object is called `{}`", name.value);
            let problem = notes.add(name.span.clone(), message, "there is nothing to keep");
            problem.help(match did_you_mean(name, known.iter().copied()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("there are {}", quoted(known.iter().copied())),
            });
        }
    }
    let reach = |raw: &Option<Reach>| match raw {
        Some(Reach::Alike(all)) => DVec3::splat(all.get()),
        Some(Reach::Axes(each)) => each.get(),
        None => DVec3::ZERO,
    };
    let size = |raw: Option<Size>| raw.map_or(0.0, Size::get);
    let share = |raw: Option<Share>| raw.map_or(0.0, Share::get);
    Bounds {
        eye: reach(&raw.eye),
        look_at: reach(&raw.look_at),
        fov_y_deg: size(raw.fov_y_deg),
        lights: reach(&raw.lights),
        directions: share(raw.directions),
        objects: reach(&raw.objects),
        radii: share(raw.radii),
        translate: reach(&raw.translate),
        angle_deg: size(raw.angle_deg),
        scale: share(raw.scale),
        colours: size(raw.colours),
        indices: size(raw.indices),
        keep: raw.keep.iter().map(|name| name.value.clone()).collect(),
    }
}

fn names<'a>(objects: &'a Each<At<RawObject>>, known: &mut Vec<&'a str>) {
    for object in objects.0.iter().flatten() {
        known.extend(object.name.as_ref().map(|name| name.value.as_str()));
        object.group.iter().for_each(|group| names(group, known));
    }
}
