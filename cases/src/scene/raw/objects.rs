//! Objects as they are written: shapes, transforms, groups.

use schemars::{JsonSchema, Schema};
use serde_json::json;

use super::numbers::{Direction, Factor, Factors, Index, NonNegative, Number, Point, Size, Travel};
use super::read::{At, Each, Notes, Read, Value, choice, table};

/// The keys of shapes. An object has exactly one of them.
pub(crate) const SHAPES: [&str; 8] =
    ["sphere", "square", "box", "plane", "cylinder", "cone", "mesh", "group"];

table! {
    /// An object of the scene: exactly one shape, or a group of objects.
    #[schemars(transform = exactly_one_shape)]
    "an object" RawObject {
        /// Name in messages and ray trees, which no other object has. Left out: its place, such as
        /// `objects[3]`.
        name: Option<At<String>>,
        /// Name of the material. In a group: the material of the objects in it that have none
        /// themselves.
        material: Option<At<String>>,
        /// Transforms from object space to world space. They are applied in order: the first one
        /// acts first. [rule 20]
        transforms: Each<At<RawTransform>> = "[]",
        /// A sphere. [rule 14]
        sphere: Option<RawSphere>,
        /// The unit square |x| ≤ 0.5, |y| ≤ 0.5 of z = 0, normal +z; without keys: `square = {}`.
        /// [rule 15]
        square: Option<RawSquare>,
        /// A box along the axes. [rule 15]
        r#box: Option<RawBox>,
        /// An infinite plane. [rule 15]
        plane: Option<RawPlane>,
        /// A cylinder about the z axis.
        cylinder: Option<RawCylinder>,
        /// A cone about the z axis, or a piece of one.
        cone: Option<RawCone>,
        /// Triangles: inline, or from a file. [rule 16]
        mesh: Option<At<RawMesh>>,
        /// Objects that are moved together, first by their own transforms and then by the group's.
        group: Option<Each<At<RawObject>>>,
    } exactly one of SHAPES
}

impl RawObject {
    /// Returns whether a part of the object, or of an object in its group, could not be read.
    pub(crate) fn has_hole(&self) -> bool {
        self.is_shapeless()
            || self.transforms.has_hole()
            || self.group.as_ref().is_some_and(any_hole)
    }

    fn is_shapeless(&self) -> bool {
        let Self { sphere, square, r#box, plane, cylinder, cone, mesh, group, .. } = self;
        let round = sphere.is_some() || cylinder.is_some() || cone.is_some();
        let flat = square.is_some() || r#box.is_some() || plane.is_some();
        !(round || flat || mesh.is_some() || group.is_some())
    }
}

/// Returns whether one of `objects`, or a part of one, could not be read.
pub(crate) fn any_hole(objects: &Each<At<RawObject>>) -> bool {
    objects.0.iter().any(|object| object.as_ref().is_none_or(|object| object.has_hole()))
}

/// Adds to the schema that an object has exactly one shape.
fn exactly_one_shape(schema: &mut Schema) {
    schema.insert(
        "oneOf".to_owned(),
        SHAPES.iter().map(|shape| json!({ "required": [shape] })).collect(),
    );
}

table! {
    /// The sphere ‖X − center‖ = radius. [rule 14]
    "a sphere" RawSphere {
        /// Center.
        center: Point = "[0, 0, 0]",
        /// Radius.
        radius: Size = "0.5",
    }
}

table! {
    /// The unit square of z = 0 about the origin; it has no keys. [rule 15]
    "a square" RawSquare {}
}

table! {
    /// The box min ≤ X ≤ max. [rule 15]
    "a box" RawBox {
        /// Least corner.
        min: Point = "[-0.5, -0.5, -0.5]",
        /// Greatest corner; above `min` on every axis.
        max: At<Point> = "[0.5, 0.5, 0.5]",
    }
}

table! {
    /// The plane N·X = k. [rule 15]
    "a plane" RawPlane {
        /// N, of any length. Normal and k are divided by this length.
        normal: Travel,
        /// k.
        k: Number,
    }
}

table! {
    /// The cylinder x² + y² = radius², z_min ≤ z ≤ z_max.
    "a cylinder" RawCylinder {
        /// Radius.
        radius: Size = "0.5",
        /// Lower end.
        z_min: Number = "-0.5",
        /// Upper end; above `z_min`.
        z_max: At<Number> = "0.5",
        /// Whether discs close both ends.
        capped: bool = "true",
    }
}

table! {
    /// A cylinder whose radius changes linearly from one end to the other.
    "a cone" RawCone {
        /// Radius at `z_min`; may be 0.
        bottom_radius: NonNegative = "0.5",
        /// Radius at `z_max`; may be 0, but differs from `bottom_radius`.
        top_radius: At<NonNegative> = "0",
        /// Lower end.
        z_min: Number = "-0.5",
        /// Upper end; above `z_min`.
        z_max: At<Number> = "0.5",
        /// Whether discs close the ends.
        capped: bool = "true",
    }
}

/// Triangles: inline, or from a file. [rule 16]
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged)]
pub(crate) enum RawMesh {
    /// From a file.
    File(RawMeshFile),
    /// Inline.
    Inline(RawMeshInline),
}

impl Read for RawMesh {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        if value.get_ref().as_table().is_some_and(|table| table.contains_key("file")) {
            RawMeshFile::read(value, notes).map(Self::File)
        } else {
            RawMeshInline::read(value, notes).map(Self::Inline)
        }
    }
}

table! {
    /// A mesh from a file.
    "a mesh from a file" RawMeshFile {
        /// Path to a Wavefront `.obj` or a `.ply` file, relative to the folder of this file. Its
        /// polygons are cut into triangles.
        file: At<String>,
        /// With `false`, the vertex normals of the file are ignored. With `true`, it must have
        /// them. Left out: they are used if the file has them. [rule 18]
        smooth: Option<bool>,
    }
}

table! {
    /// A mesh in the file. The normal of a triangle (A, B, C) is along (B − A) × (C − A).
    "a mesh" RawMeshInline {
        /// Corners.
        vertices: Vec<Point>,
        /// Triangles, each as three indices into `vertices`, from 0. A triangle without area is
        /// never hit.
        triangles: Vec<At<[Index; 3]>>,
        /// A normal of any length for every vertex. A mesh is smooth with them, and flat without
        /// them. [rule 18]
        normals: Option<At<Vec<Direction>>>,
    }
}

choice! {
    /// A step from object space to world space: exactly one of these keys.
    "a transform" RawTransform {
        /// Moves by a vector.
        "translate" Translate(Point),
        /// Rotates about an axis through the origin.
        "rotate" Rotate(RawRotation),
        /// Scales about the origin by one factor, or by one for each axis. A factor below 0
        /// mirrors; 0 is an error.
        "scale" Scale(RawScale),
        /// Shears.
        "shear" Shear(RawShear),
        /// Any affine map, as four rows of four numbers that act on a column (x, y, z, 1). The last
        /// row is [0, 0, 0, 1].
        "matrix" Matrix([[Number; 4]; 4]),
    }
}

table! {
    /// A rotation about an axis through the origin.
    "a rotation" RawRotation {
        /// The axis, of any length.
        axis: Direction,
        /// Degrees, counter-clockwise as seen from the tip of the axis. Multiples of 90 are exact.
        angle_deg: Number,
    }
}

table! {
    /// A shear: `xy = 0.5` adds 0.5 y to x, and so on. All terms act at once.
    "a shear" RawShear {
        /// y added to x.
        xy: Number = "0",
        /// z added to x.
        xz: Number = "0",
        /// x added to y.
        yx: Number = "0",
        /// z added to y.
        yz: Number = "0",
        /// x added to z.
        zx: Number = "0",
        /// y added to z.
        zy: Number = "0",
    }
}

/// One factor, or one for each axis.
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged, inline)]
pub(crate) enum RawScale {
    /// For all axes.
    Uniform(Factor),
    /// For x, y and z.
    Axes(Factors),
}

impl Read for RawScale {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        match value.get_ref().as_array() {
            Some(_) => Factors::read(value, notes).map(Self::Axes),
            None => Factor::read(value, notes).map(Self::Uniform),
        }
    }
}
