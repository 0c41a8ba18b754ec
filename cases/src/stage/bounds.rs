//! Bounds within which the numbers of a case may be moved to make another case of the same kind.

use glam::DVec3;

use crate::problem::{did_you_mean, quoted};
use crate::scene::raw::RawScene;
use crate::scene::raw::numbers::{Share, Size};
use crate::scene::raw::objects::RawObject;
use crate::scene::raw::read::{At, Each, Notes};
use crate::scene::raw::vary::{RawVary, Reach};

/// Greatest moves in both directions; 0 where nothing moves. The fields are the keys of `[vary]` in
/// a case file, whose reference explains each.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// The eye, in scene units.
    pub eye: DVec3,
    /// The point at which the camera looks, in scene units.
    pub look_at: DVec3,
    /// The angle of view, in degrees.
    pub fov_y_deg: f64,
    /// Positions of point lights, in scene units.
    pub lights: DVec3,
    /// Components of directional lights, as a share of the longest one.
    pub directions: f64,
    /// Objects without transforms, in scene units.
    pub objects: DVec3,
    /// Radii, as a share of each.
    pub radii: f64,
    /// Translations, in units of the space in which they move.
    pub translate: DVec3,
    /// Angles of transforms, in degrees.
    pub angle_deg: f64,
    /// Factors of `scale` and amounts of `shear`, as a share of each.
    pub scale: f64,
    /// Channels of colours.
    pub colours: f64,
    /// Indices of refraction.
    pub indices: f64,
    /// Names of materials and objects whose numbers are not moved.
    pub keep: Vec<String>,
}

impl Bounds {
    /// Returns the bounds as plain numbers, 0 where nothing moves. Names that the scene does not
    /// have are noted.
    pub(super) fn read(raw: &RawVary, scene: Option<&RawScene>, notes: &mut Notes) -> Self {
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
        Self {
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
}

/// Adds the names of objects, also of those within groups, to `known`.
fn names<'a>(objects: &'a Each<At<RawObject>>, known: &mut Vec<&'a str>) {
    for object in objects.0.iter().flatten() {
        known.extend(object.name.as_ref().map(|name| name.value.as_str()));
        object.group.iter().for_each(|group| names(group, known));
    }
}
