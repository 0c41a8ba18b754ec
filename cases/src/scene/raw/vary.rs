//! The `[vary]` table as it is written: how far the numbers of a case may be moved.

use schemars::JsonSchema;

use super::numbers::{Reaches, Share, Size};
use super::read::{At, Notes, Read, Value, table};

table! {
    /// The `[vary]` table bounds how far `reference vary` may move the numbers of this case, up or
    /// down. It moves only the kinds of number listed here, and only numbers that the case file
    /// gives. It never moves a default.
    "`[vary]`" RawVary {
        /// The eye: scene units, for all axes or for each.
        eye: Option<Reach>,
        /// The point at which the camera looks: scene units, for all axes or for each.
        look_at: Option<Reach>,
        /// The angle of view: degrees.
        fov_y_deg: Option<Size>,
        /// Positions of point lights: scene units, for all axes or for each.
        lights: Option<Reach>,
        /// Each component of a directional light's direction: a share of the longest component.
        directions: Option<Share>,
        /// Spheres with a `center`, boxes with `min` and `max`, planes and inline meshes, each as a
        /// whole. Objects with transforms do not move. Scene units, for all axes or for each.
        objects: Option<Reach>,
        /// Radii: a share of each.
        radii: Option<Share>,
        /// Translations in lists of transforms: units of the space in which they move, for all axes
        /// or for each.
        translate: Option<Reach>,
        /// Angles in lists of transforms: degrees.
        angle_deg: Option<Size>,
        /// Factors of `scale` and amounts of `shear` in lists of transforms: a share of each.
        scale: Option<Share>,
        /// Each channel of a colour, by at most half of its value. 0 and 1 stay, and no channel
        /// crosses 1.
        colours: Option<Size>,
        /// Indices of refraction.
        indices: Option<Size>,
        /// Names of materials and objects whose numbers are not moved.
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
