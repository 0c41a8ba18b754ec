//! The decisions of a course: each key of `course.toml` with its legal values, the lecture's first.
//! The doc comments are the texts of the handout.

use super::choice::decisions;
use crate::scene::raw::read::table;

decisions! {
    /// The point of a pixel through which its eye ray goes
    pixel: Pixel [1] {
        /// its centre
        Centre = "centre",
        /// its corner, the one at which row and column begin
        Corner = "corner",
    }
    /// The place of row 0, as `eye_ray` counts rows; a picture file begins at the top either way
    row_0: Row0 [1] {
        /// at the top
        Top = "top",
        /// at the bottom
        Bottom = "bottom",
    }
    /// The angle of the picture that a camera's `fov_y_deg` gives
    fov: FovAxis [1] {
        /// from bottom to top
        Vertical = "vertical",
        /// from left to right
        Horizontal = "horizontal",
    }
    /// The formula of the highlight
    highlight: Lobe [3] {
        /// Blinn's (N·H)₊^ns
        Blinn = "blinn",
        /// Phong's (R·V)₊^ns, R the direction to the light mirrored about N
        Phong = "phong",
    }
    /// The surfaces that a light also illuminates from behind, where B is 1 and |N·L| counts
    two_sided: TwoSided [3, 11] {
        /// none
        Never = "never",
        /// those with kt > 0
        Transmissive = "transmissive",
        /// all
        Always = "always",
    }
    /// Distance attenuation very near to a light
    attenuation: Near [4] {
        /// at most 1
        Clamped = "clamped",
        /// as the formula gives it, above 1 as well
        Unclamped = "unclamped",
    }
    /// The factor by which a transparent object weakens the light of a shadow ray
    tint: ShadowTint [6] {
        /// kt for every surface that is crossed, so twice for a ball
        PerCrossing = "per_crossing",
        /// kt once for every object that is crossed
        PerObject = "per_object",
        /// 1: the object casts no shadow
        Nothing = "none",
        /// 0: the object casts a black shadow
        Opaque = "opaque",
    }
    /// The index of refraction outside of all objects
    index_of_air: Air [9] {
        /// that of air
        Air = 1.0003,
        /// that of a vacuum
        Vacuum = 1.0,
    }
    /// The ambient term where a surface is seen from inside
    ambient_inside: AmbientInside [12] {
        /// multiplied by kt
        TimesKt = "times_kt",
        /// as from outside
        AsOutside = "as_outside",
    }
    /// The depths at which a ray still spawns others; at max_depth 0, no ray does in any course
    depth: DepthTest [13] {
        /// depth < max_depth
        Less = "<",
        /// depth ≤ max_depth: one bounce more
        LessOrEqual = "<=",
    }
    /// The condition that ends a path of small weight, where the scene has a threshold
    cutoff: CutoffTest [13] {
        /// all channels of its weight are below the threshold
        AllChannels = "all_channels",
        /// one channel of its weight is below the threshold
        AnyChannel = "any_channel",
    }
    /// The normal that decides whether a ray is inside, where normals are interpolated
    inside_by: InsideNormal [19] {
        /// the geometric one
        Geometric = "geometric",
        /// the interpolated one
        Interpolated = "interpolated",
    }
    /// The normal that is used for reflection
    reflect_by: ReflectNormal [19] {
        /// the interpolated one; the geometric one where R would enter the object
        WithFallback = "with_fallback",
        /// the interpolated one, wherever R goes
        Interpolated = "interpolated",
        /// the geometric one
        Geometric = "geometric",
    }
    /// The normal that is used for refraction
    refract_by: RefractNormal [19] {
        /// the interpolated one; the geometric one where T would not cross the surface
        WithFallback = "with_fallback",
        /// the interpolated one, wherever T goes
        Interpolated = "interpolated",
        /// the geometric one
        Geometric = "geometric",
    }
    /// The rounding of linear light to one of 256 levels
    bytes: Bytes [] D 25 {
        /// to the nearest level
        Rounded = "rounded",
        /// to the level below
        Truncated = "truncated",
    }
}
