//! Case files as they are written. The doc comments below are the reference of the format:
//! `docs/scene-format.md` and the JSON Schema are made from them.

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
    /// A scene outside any stage; it may have the keys of a case, but needs only `render` and
    /// `scene`.
    #[expect(dead_code, reason = "what makes it a case is only checked")]
    "a scene file" RawSceneFile {
        /// As in a case.
        title: Option<String>,
        /// As in a case.
        about: Option<String>,
        /// As in a case.
        rules: Option<Vec<Rule>>,
        /// As in a case.
        points: Option<Points>,
        /// Size of the picture and depth of the recursion.
        render: Maybe<RawRender>,
        /// Camera, lights, materials and objects.
        scene: Maybe<RawScene>,
        /// As in a case.
        vary: Option<RawVary>,
    }
}

table! {
    /// Settings of the render.
    "`[render]`" RawRender {
        /// Width and height in pixels, together at most 8388608 pixels.
        size: At<[Side; 2]>,
        /// How often a path may be continued: a ray of this depth spawns no more, the eye ray has
        /// depth 0. [rule 13]
        max_depth: Depth = "0",
        /// A path whose weight is below this in every channel spawns no more; 0 switches that off.
        /// [rule 13]
        threshold: NonNegative = "0",
    }
}

table! {
    /// What is seen: world space is right-handed, lengths are in scene units, colours are linear
    /// RGB.
    "`[scene]`" RawScene {
        /// Where the picture is taken from.
        camera: Maybe<RawCamera>,
        /// Colour of a ray that meets nothing.
        background: Colour = "[0, 0, 0]",
        /// The sources of light.
        lights: Each<RawLight> = "[]",
        /// Materials by name.
        materials: BTreeMap<String, Maybe<RawMaterial>> = "{}",
        /// What there is to see, in the order that decides between two hits at equal distance: the
        /// first wins.
        objects: Each<At<RawObject>> = "[]",
    }
}

impl RawScene {
    /// Whether a light, a material or an object could not be read, as the notes then say.
    pub(crate) fn has_hole(&self) -> bool {
        let materials = self.materials.values().any(|material| material.0.is_none());
        materials || self.lights.has_hole() || any_hole(&self.objects)
    }
}

table! {
    /// A pinhole camera. [rule 1]
    "a camera" RawCamera {
        /// Where the pinhole is.
        eye: Point,
        /// The point in the middle of the picture; not the eye itself.
        look_at: At<Point>,
        /// Which way is up in the picture; any length, not parallel to the view.
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
        /// Where it is.
        position: Point,
        /// I: what it sends out. [rule 3]
        colour: Colour,
        /// Ia: its own ambient colour, which reaches every surface, in shadow as well. [rule 3]
        ambient: Colour = "[0, 0, 0]",
        /// How it weakens with distance; left out, it does not. [rule 4]
        attenuation: At<RawAttenuation> = "{ constant = 1 }",
    }
}

table! {
    /// A = min(1, 1 / (quadratic · r² + linear · r + constant)) at the distance r; not all of them
    /// 0. [rule 4]
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
        /// Where the light travels, away from the light; any length.
        direction: Direction,
        /// I: what arrives. [rule 3]
        colour: Colour,
        /// Ia: its own ambient colour, which reaches every surface, in shadow as well. [rule 3]
        ambient: Colour = "[0, 0, 0]",
    }
}

table! {
    /// How a surface answers light. [rule 3]
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
        /// Specular exponent. Needed where `ks` is not black; elsewhere it makes no difference, and
        /// is 0.
        ns: Option<NonNegative>,
        /// Index of refraction. Needed where `kt` is not black; elsewhere it makes no difference,
        /// and is that of air, 1.0003. [rule 9]
        index: Option<Size>,
    }
}
