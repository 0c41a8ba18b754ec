//! The types of the resolved scene.

use glam::{DAffine3, DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::effects::Effects;

/// A complete picture to render: settings, camera, lights, materials, objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Size of the picture and depth of the recursion.
    pub render: Render,
    /// The effects to simulate; an effect that is not listed is left out of the picture.
    pub effects: Effects,
    /// The camera.
    pub camera: Camera,
    /// Colour of a ray that hits nothing.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub background: DVec3,
    /// Lights, in file order.
    pub lights: Vec<Light>,
    /// Materials, ordered by name.
    pub materials: Vec<Material>,
    /// Meshes that objects refer to.
    pub meshes: Vec<Mesh>,
    /// Objects, in file order, with groups dissolved.
    pub objects: Vec<Object>,
}

/// Settings of a render.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Render {
    /// Pixels in a row; at least 1.
    pub width: u32,
    /// Rows; at least 1.
    pub height: u32,
    /// Depth at which a ray spawns no further rays; the eye ray has depth 0. [rule 13]
    pub max_depth: u32,
    /// Weight below which a path spawns no further rays, in every channel; 0 switches this off.
    /// [rule 13]
    pub threshold: f64,
}

/// A pinhole camera; `right`, `up`, `forward` are orthonormal, right × up = −forward. [rule 1]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// The pinhole, C.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub eye: DVec3,
    /// Unit vector to the right of the picture.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub right: DVec3,
    /// Unit vector to the top of the picture.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub up: DVec3,
    /// Unit vector into the scene.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub forward: DVec3,
    /// Vertical angle of view in degrees, above 0 and below 180; square pixels give the horizontal
    /// one.
    pub fov_y_deg: f64,
}

/// A source of light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Light {
    /// A point that shines in all directions.
    Point {
        /// Position of the light.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        position: DVec3,
        /// I_j. [rule 3]
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        colour: DVec3,
        /// Ia_j, this light's own ambient colour. [rule 3]
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        ambient: DVec3,
        /// Attenuation with distance. [rule 4]
        attenuation: Attenuation,
    },
    /// A light infinitely far away.
    Directional {
        /// Unit vector along which the light travels, away from the light.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        direction: DVec3,
        /// I_j. [rule 3]
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        colour: DVec3,
        /// Ia_j, this light's own ambient colour. [rule 3]
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        ambient: DVec3,
    },
}

impl Scene {
    /// Returns the material of `object`, an object of this scene.
    pub fn material(&self, object: &Object) -> &Material {
        &self.materials[object.material]
    }
}

impl Light {
    /// Returns I_j. [rule 3]
    pub fn colour(&self) -> DVec3 {
        match self {
            Self::Point { colour, .. } | Self::Directional { colour, .. } => *colour,
        }
    }

    /// Returns Ia_j. [rule 3]
    pub fn ambient(&self) -> DVec3 {
        match self {
            Self::Point { ambient, .. } | Self::Directional { ambient, .. } => *ambient,
        }
    }
}

/// A_j = min(1, 1 / (quadratic · r² + linear · r + constant)); none negative, not all zero.
/// [rule 4]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Attenuation {
    /// a of rule 4.
    pub quadratic: f64,
    /// b of rule 4.
    pub linear: f64,
    /// c of rule 4.
    pub constant: f64,
}

impl Attenuation {
    /// A_j = 1 at every distance: (0, 0, 1).
    pub const NONE: Self = Self { quadratic: 0.0, linear: 0.0, constant: 1.0 };
}

/// The response of a surface to light; colours are linear RGB, none negative. [rule 3]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name in the case file.
    pub name: String,
    /// Emission.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub ke: DVec3,
    /// Ambient; equals `kd` unless the file says otherwise.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub ka: DVec3,
    /// Diffuse.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub kd: DVec3,
    /// Specular.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub ks: DVec3,
    /// Transmissive.
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub kt: DVec3,
    /// Reflective: weight of the reflected ray; equals `ks` unless the file says otherwise.
    /// [rule 7]
    #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
    pub kr: DVec3,
    /// Specular exponent, at least 0.
    pub ns: f64,
    /// Index of refraction, above 0. [rule 9]
    pub index: f64,
}

/// An object of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Object {
    /// Name in the file, or else `objects[3]`.
    pub name: String,
    /// Shape, in object space.
    pub shape: Shape,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// M: object space to world space. [rule 20]
    #[serde(with = "super::affine")]
    #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 4]; 4]"))]
    pub world_from_object: DAffine3,
    /// M⁻¹.
    #[serde(with = "super::affine")]
    #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 4]; 4]"))]
    pub object_from_world: DAffine3,
}

impl Object {
    /// Returns whether M is the identity, so that object space is world space.
    pub fn is_untransformed(&self) -> bool {
        self.world_from_object == DAffine3::IDENTITY
    }

    /// Returns A⁻ᵀ, which takes an object-space normal to world space; the result is to be
    /// normalised. [rule 20]
    pub fn normal_matrix(&self) -> DMat3 {
        self.object_from_world.matrix3.transpose()
    }
}

/// A shape in object space. Sizes are positive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A sphere ‖X − center‖ = radius; radius 0.5 about the origin unless the file says otherwise.
    /// [rule 14]
    Sphere {
        /// Center.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        center: DVec3,
        /// Radius.
        radius: f64,
    },
    /// A plane N·X = k, N a unit vector. [rule 15]
    Plane {
        /// N.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
        /// Signed distance of the plane from the origin along N.
        k: f64,
    },
    /// The square |x| ≤ 0.5, |y| ≤ 0.5, z = 0, with normal +z. [rule 15]
    Square {},
    /// A box min ≤ X ≤ max; the unit cube about the origin unless the file says otherwise.
    /// [rule 15]
    Box {
        /// Least corner.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        min: DVec3,
        /// Greatest corner.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        max: DVec3,
    },
    /// A cylinder x² + y² = radius², z_min ≤ z ≤ z_max.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Lower end.
        z_min: f64,
        /// Upper end.
        z_max: f64,
        /// Whether discs close both ends.
        capped: bool,
    },
    /// A cylinder whose radius changes linearly from `bottom_radius` at z_min to `top_radius` at
    /// z_max; one may be 0.
    Cone {
        /// Radius at z_min.
        bottom_radius: f64,
        /// Radius at z_max; differs from `bottom_radius`.
        top_radius: f64,
        /// Lower end.
        z_min: f64,
        /// Upper end.
        z_max: f64,
        /// Whether discs close the ends.
        capped: bool,
    },
    /// A mesh of triangles. [rule 16]
    Mesh {
        /// Index into [`Scene::meshes`].
        mesh: usize,
    },
}

/// Triangles over shared vertices; the normal of (A, B, C) is along (B − A) × (C − A). [rule 16]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// Positions of the corners.
    #[cfg_attr(feature = "authoring", schemars(with = "Vec<[f64; 3]>"))]
    pub vertices: Vec<DVec3>,
    /// Triangles, each as three indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// One unit normal per vertex, or none where the mesh is flat. [rule 18]
    #[cfg_attr(feature = "authoring", schemars(with = "Option<Vec<[f64; 3]>>"))]
    pub normals: Option<Vec<DVec3>>,
}
