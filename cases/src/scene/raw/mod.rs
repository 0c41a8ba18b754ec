//! Case files as they are written. The doc comments below are the reference of the format:
//! `docs/scene-format.md` and the JSON Schema are generated from them.

pub(crate) mod effect;
pub(crate) mod numbers;
pub(crate) mod objects;
pub(crate) mod read;
pub(crate) mod vary;

use std::collections::BTreeMap;

use numbers::{Colour, Depth, Direction, NonNegative, Point, Points, Rule, Side, Size, ViewAngle};
use objects::{RawObject, any_hole};
use read::{At, Each, Maybe, choice, table};
use vary::RawVary;

table! {
    /// A scene outside any stage. It may have the keys of a case, but needs only `render` and
    /// `scene`.
    #[expect(dead_code, reason = "the keys of a case are checked, but not used")]
    "a scene file" RawSceneFile {
        /// Title, as in a case.
        title: Option<String>,
        /// Description, as in a case.
        about: Option<String>,
        /// Rules, as in a case.
        rules: Option<Vec<Rule>>,
        /// Points, as in a case.
        points: Option<Points>,
        /// Size of the picture and depth of the recursion.
        render: Maybe<RawRender>,
        /// Camera, lights, materials and objects.
        scene: Maybe<RawScene>,
        /// Bounds, as in a case.
        vary: Option<RawVary>,
    }
}

table! {
    /// Settings of the render.
    "`[render]`" RawRender {
        /// Width and height in pixels, together at most 8388608 pixels.
        size: At<[Side; 2]>,
        /// Depth at which a ray spawns no further rays. The eye ray has depth 0. [rule 13]
        max_depth: Depth = "0",
        /// A path whose weight is below this in every channel spawns no further rays; 0 switches
        /// this off. [rule 13]
        threshold: NonNegative = "0",
    }
}

table! {
    /// The scene. World space is right-handed, lengths are in scene units, colours are linear RGB.
    "`[scene]`" RawScene {
        /// The camera.
        camera: Maybe<RawCamera>,
        /// Colour of a ray that hits nothing.
        background: Colour = "[0, 0, 0]",
        /// The sources of light.
        lights: Each<RawLight> = "[]",
        /// Materials by name.
        materials: BTreeMap<String, Maybe<RawMaterial>> = "{}",
        /// Objects. Of two hits at equal distance, the one with the object that comes first wins.
        objects: Each<At<RawObject>> = "[]",
    }
}

impl RawScene {
    /// Returns whether a light, a material or an object could not be read, which has been noted.
    pub(crate) fn has_hole(&self) -> bool {
        let materials = self.materials.values().any(|material| material.0.is_none());
        materials || self.lights.has_hole() || any_hole(&self.objects)
    }
}

table! {
    /// A pinhole camera. [rule 1]
    "a camera" RawCamera {
        /// Position of the pinhole.
        eye: Point,
        /// The point in the middle of the picture; not the eye itself.
        look_at: At<Point>,
        /// The direction that is up in the picture; any length, not parallel to the view.
        up: At<Direction>,
        /// The vertical angle of view in degrees. Pixels are square, which gives the horizontal
        /// one.
        fov_y_deg: ViewAngle,
    }
}

choice! {
    /// A source of light: exactly one of the two.
    "a light" RawLight {
        /// A point that shines in all directions.
        "point" Point(RawPointLight),
        /// A light infinitely far away.
        "directional" Directional(RawDirectionalLight),
    }
}

table! {
    /// A point that shines in all directions.
    "a point light" RawPointLight {
        /// Position of the light.
        position: Point,
        /// I: the light that it sends out. [rule 3]
        colour: Colour,
        /// Ia: its own ambient colour, which reaches every surface, in shadow as well. [rule 3]
        ambient: Colour = "[0, 0, 0]",
        /// Weakening with distance. Left out: none. [rule 4]
        attenuation: At<RawAttenuation> = "{ constant = 1 }",
    }
}

table! {
    /// The coefficients of A = min(1, 1 / (quadratic · r² + linear · r + constant)) at the distance
    /// r. Not all of them may be 0. [rule 4]
    "an attenuation" RawAttenuation {
        /// Factor of r².
        quadratic: NonNegative = "0",
        /// Factor of r.
        linear: NonNegative = "0",
        /// The part that does not depend on r.
        constant: NonNegative = "0",
    }
}

table! {
    /// A light infinitely far away; it does not weaken with distance.
    "a directional light" RawDirectionalLight {
        /// The direction in which the light travels, away from the light; any length.
        direction: Direction,
        /// I: the light that arrives. [rule 3]
        colour: Colour,
        /// Ia: its own ambient colour, which reaches every surface, in shadow as well. [rule 3]
        ambient: Colour = "[0, 0, 0]",
    }
}

table! {
    /// The response of a surface to light. [rule 3]
    "a material" RawMaterial {
        /// Emission.
        ke: Colour = "[0, 0, 0]",
        /// Ambient. Left out: the same as `kd`.
        ka: Option<Colour>,
        /// Diffuse.
        kd: Colour = "[0, 0, 0]",
        /// Specular.
        ks: At<Colour> = "[0, 0, 0]",
        /// Transmissive: weight of the refracted ray, and tint of a shadow. [rule 6] [rule 8]
        kt: At<Colour> = "[0, 0, 0]",
        /// Weight of the reflected ray. Left out: the same as `ks`. [rule 7]
        kr: Option<Colour>,
        /// Specular exponent. Needed where `ks` is not black; elsewhere it has no effect, and is 0.
        ns: Option<NonNegative>,
        /// Index of refraction. Needed where `kt` is not black; elsewhere it has no effect, and is
        /// that of air, 1.0003. [rule 9]
        index: Option<Size>,
    }
}
