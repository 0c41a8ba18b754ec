//! How far the numbers of a case may be moved to make another case of the same kind.

use glam::DVec3;

/// Greatest moves, either way; 0 where nothing moves. The keys of `[vary]` in a case file, whose reference says what each moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// The eye, in scene units.
    pub eye: DVec3,
    /// The point looked at, in scene units.
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
    /// Translations, in units of the space they move in.
    pub translate: DVec3,
    /// Angles of transforms, in degrees.
    pub angle_deg: f64,
    /// Factors of `scale` and amounts of `shear`, as a share of each.
    pub scale: f64,
    /// Channels of colours.
    pub colours: f64,
    /// Indices of refraction.
    pub indices: f64,
    /// Names of materials and objects of which nothing is moved.
    pub keep: Vec<String>,
}
