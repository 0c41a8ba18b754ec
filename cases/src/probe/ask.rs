//! The questions of unit checks: one variant for every function that is checked.

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};

use super::number;
use crate::ray::Ray;
use crate::scene::{Camera, Light, Material, Scene, affine};

/// A question: the arguments of one call of one function. The key `fn` holds the variant's name in
/// snake case.
///
/// Directions and normals are unit vectors unless a variant says otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "authoring", derive(schemars::JsonSchema))]
#[serde(tag = "fn", rename_all = "snake_case")]
pub enum Ask {
    /// The ray through the centre of a pixel. Answer: `ray`. [rule 1]
    EyeRay {
        /// The camera.
        camera: Camera,
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Column from the left, row from the top.
        pixel: [u32; 2],
    },
    /// The nearest hit with a sphere. Answer: `hit` or `miss`. [rule 14]
    Sphere {
        /// Direction of any length but zero.
        ray: Ray,
        /// Center.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        center: DVec3,
        /// Radius.
        radius: f64,
    },
    /// The hit with a plane. Answer: `hit` or `miss`. [rule 15]
    Plane {
        /// Direction of any length but zero.
        ray: Ray,
        /// N, a unit vector.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
        /// k in N·X = k.
        k: f64,
    },
    /// The hit with the unit square of z = 0. Answer: `hit` or `miss`. [rule 15]
    Square {
        /// Direction of any length but zero.
        ray: Ray,
    },
    /// The nearest hit with a box. Answer: `hit` or `miss`. [rule 15]
    Box {
        /// Direction of any length but zero.
        ray: Ray,
        /// Least corner.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        min: DVec3,
        /// Greatest corner.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        max: DVec3,
    },
    /// The hit with a triangle. Answer: `hit`, its normal along (b − a) × (c − a), or `miss`.
    /// [rule 16]
    Triangle {
        /// Direction of any length but zero.
        ray: Ray,
        /// A.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        a: DVec3,
        /// B.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        b: DVec3,
        /// C.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        c: DVec3,
    },
    /// The nearest hit in a scene. Answer: `found` or `miss`. [rule 2]
    Nearest {
        /// The scene.
        scene: Box<Scene>,
        /// A ray in world space.
        ray: Ray,
    },
    /// A_j at distance `r`. Answer: `value`. [rule 4]
    Attenuation {
        /// The light.
        light: Light,
        /// Distance to it; infinite for a directional light.
        #[serde(with = "number")]
        #[cfg_attr(feature = "authoring", schemars(with = "crate::probe::number::Number"))]
        r: f64,
    },
    /// The normal turned against the ray, and whether the ray is inside. Answer: `facing`.
    /// [rule 11]
    FacingNormal {
        /// Direction of the ray.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        direction: DVec3,
        /// Outward normal.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
    },
    /// ka Ia_j, multiplied by kt from inside. Answer: `colour`. [rule 3] [rule 12]
    Ambient {
        /// The material.
        material: Material,
        /// The light.
        light: Light,
        /// Whether the point is seen from inside its object.
        inside: bool,
    },
    /// S_j A_j I_j B_j [kd (N·L_j) + ks (N·H_j)₊^ns]: one light without its ambient part. Answer:
    /// `colour`. [rule 3]
    LightTerm {
        /// The material.
        material: Material,
        /// S_j A_j I_j: the light that arrives.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        arriving: DVec3,
        /// N, turned against the ray.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
        /// −d.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        to_viewer: DVec3,
        /// L_j.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        to_light: DVec3,
    },
    /// The sum of ke and all lights at a point. Answer: `colour`. [rule 3]
    Shade {
        /// The scene.
        scene: Box<Scene>,
        /// Index of the object that is shaded.
        object: usize,
        /// The point.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        point: DVec3,
        /// N, turned against the ray.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
        /// −d.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        to_viewer: DVec3,
        /// Whether the point is seen from inside its object.
        inside: bool,
    },
    /// The unit vector to a light, and t_light. Answer: `to_light`. [rule 5]
    ToLight {
        /// The light.
        light: Light,
        /// The point.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        point: DVec3,
    },
    /// S_j at a point. Answer: `colour`. [rule 5] [rule 6]
    Shadow {
        /// The scene.
        scene: Box<Scene>,
        /// Index of the light.
        light: usize,
        /// The point.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        point: DVec3,
    },
    /// R. Answer: `vector`. [rule 7]
    Reflect {
        /// d.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        direction: DVec3,
        /// N.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
    },
    /// Whether a ray of this depth and weight spawns further rays. Answer: `goes_on`. [rule 13]
    GoesOn {
        /// Depth of the ray; the eye ray's is 0.
        depth: u32,
        /// The scene's limit.
        max_depth: u32,
        /// Product of the kr and kt along the path.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        weight: DVec3,
        /// The scene's threshold; 0 switches the test off.
        threshold: f64,
    },
    /// η_i and η_t. Answer: `indices`. [rule 9]
    Indices {
        /// Whether the ray is inside the object and about to leave it.
        inside: bool,
        /// The material's index.
        index: f64,
    },
    /// T. Answer: `vector`, or `miss` for total internal reflection. [rule 8] [rule 10]
    Refract {
        /// d.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        direction: DVec3,
        /// N, turned against the ray.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
        /// Index on the side of the ray.
        eta_i: f64,
        /// Index on the other side.
        eta_t: f64,
    },
    /// The colour along a ray. Answer: `colour`. [rule 7] [rule 8] [rule 13]
    Trace {
        /// The scene.
        scene: Box<Scene>,
        /// A ray in world space.
        ray: Ray,
        /// Depth of the ray.
        depth: u32,
    },
    /// The ray in object space, its direction not normalised. Answer: `ray`. [rule 20]
    RayToObject {
        /// A ray in world space.
        ray: Ray,
        /// M⁻¹.
        #[serde(with = "affine")]
        #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 4]; 4]"))]
        object_from_world: DAffine3,
    },
    /// N = A⁻ᵀ N′, normalised. Answer: `vector`. [rule 20]
    NormalToWorld {
        /// N′.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        normal: DVec3,
        /// M⁻¹.
        #[serde(with = "affine")]
        #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 4]; 4]"))]
        object_from_world: DAffine3,
    },
    /// The nearest hit with the sphere of radius 0.5 about the origin, transformed by M. Answer:
    /// `hit` in world space, or `miss`. [rule 14] [rule 20]
    TransformedSphere {
        /// A ray in world space.
        ray: Ray,
        /// M.
        #[serde(with = "affine")]
        #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 4]; 4]"))]
        world_from_object: DAffine3,
        /// M⁻¹.
        #[serde(with = "affine")]
        #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 4]; 4]"))]
        object_from_world: DAffine3,
    },
    /// (α, β, γ) of a point in the plane of a triangle. Answer: `vector`. [rule 17]
    Barycentric {
        /// A.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        a: DVec3,
        /// B.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        b: DVec3,
        /// C.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        c: DVec3,
        /// Q.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        q: DVec3,
    },
    /// N̂ from three vertex normals. Answer: `vector`, of unit length. [rule 18]
    Interpolate {
        /// (α, β, γ).
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        weights: DVec3,
        /// The normals of A, B, C.
        #[cfg_attr(feature = "authoring", schemars(with = "[[f64; 3]; 3]"))]
        normals: [DVec3; 3],
    },
    /// R where normals are interpolated. Answer: `vector`. [rule 19]
    SmoothReflect {
        /// d.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        direction: DVec3,
        /// Geometric normal, turned against the ray.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        n_geom: DVec3,
        /// Interpolated normal, turned along with it.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        n_shading: DVec3,
    },
    /// T where normals are interpolated. Answer: `vector`, or `miss` for total internal reflection.
    /// [rule 19]
    SmoothRefract {
        /// d.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        direction: DVec3,
        /// Geometric normal, turned against the ray.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        n_geom: DVec3,
        /// Interpolated normal, turned along with it.
        #[cfg_attr(feature = "authoring", schemars(with = "[f64; 3]"))]
        n_shading: DVec3,
        /// Index on the side of the ray.
        eta_i: f64,
        /// Index on the other side.
        eta_t: f64,
    },
}

impl Ask {
    /// Returns the name of the function, as in the key `fn`.
    pub fn function(&self) -> &'static str {
        match self {
            Self::EyeRay { .. } => "eye_ray",
            Self::Sphere { .. } => "sphere",
            Self::Plane { .. } => "plane",
            Self::Square { .. } => "square",
            Self::Box { .. } => "box",
            Self::Triangle { .. } => "triangle",
            Self::Nearest { .. } => "nearest",
            Self::Attenuation { .. } => "attenuation",
            Self::FacingNormal { .. } => "facing_normal",
            Self::Ambient { .. } => "ambient",
            Self::LightTerm { .. } => "light_term",
            Self::Shade { .. } => "shade",
            Self::ToLight { .. } => "to_light",
            Self::Shadow { .. } => "shadow",
            Self::Reflect { .. } => "reflect",
            Self::GoesOn { .. } => "goes_on",
            Self::Indices { .. } => "indices",
            Self::Refract { .. } => "refract",
            Self::Trace { .. } => "trace",
            Self::RayToObject { .. } => "ray_to_object",
            Self::NormalToWorld { .. } => "normal_to_world",
            Self::TransformedSphere { .. } => "transformed_sphere",
            Self::Barycentric { .. } => "barycentric",
            Self::Interpolate { .. } => "interpolate",
            Self::SmoothReflect { .. } => "smooth_reflect",
            Self::SmoothRefract { .. } => "smooth_refract",
        }
    }
}
