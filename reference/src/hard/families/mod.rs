//! The families of hard questions.

mod flat;
mod light;
mod moved;
mod solid;
mod spheres;

use super::draws::Draws;
use super::question::Question;

/// The greatest relative error of t, and the greatest error of the normal, the direction or the
/// weights, as a vector relative to 1.
pub type Bound = [f64; 2];

/// A kind of hard question.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// The unique name, such as `sphere, far`.
    pub name: &'static str,
    /// The function that is called: `sphere`, `triangle`, ...
    pub function: &'static str,
    /// Draws the next question.
    pub draw: fn(&mut Draws) -> Question,
    /// The bound of the reference's errors in double precision: some ten times the worst of 10⁶
    /// draws.
    pub double: Bound,
    /// The bound in single precision.
    pub single: Bound,
}

/// No bound. If a hit is nearer to the tip of a cone than its own rounding error, its normal can
/// have any direction.
const ANY: f64 = f64::INFINITY;

macro_rules! families {
    ($($function:literal { $($name:literal: $draw:path, $double:expr, $single:expr;)* })*) => {
        /// All families, function by function.
        pub const FAMILIES: &[Family] = &[$($(Family {
            name: concat!($function, ", ", $name),
            function: $function,
            draw: $draw,
            double: $double,
            single: $single,
        },)*)*];
    };
}

families! {
    "sphere" {
        "generic": spheres::generic, [1e-12, 1e-11], [1e-3, 1e-4];
        "far": spheres::far, [1e-14, 1e-14], [1e-6, 1e-6];
        "tangent": spheres::tangent, [1e-9, 1e-11], [1e-2, 1e-4];
        "near its surface": spheres::near_surface, [1e-10, 1e-12], [1e-3, 1e-4];
        "as a ground": spheres::ground, [1e-13, 1e-14], [1e-5, 1e-5];
        "mixed coordinates": spheres::coordinates, [1e-12, 1e-11], [1e-4, 1e-4];
        "offset by 1e6": spheres::offset, [1e-12, 1e-11], [1e-4, 1e-3];
        "at any scale": spheres::scale, [1e-12, 1e-11], [1e-3, 1e-4];
    }
    "plane" {
        "generic": flat::plane, [1e-13, 0.0], [1e-4, 0.0];
        "near parallel": flat::plane_near_parallel, [1e-13, 0.0], [1e-4, 0.0];
        "offset by 1e6": flat::plane_offset, [1e-13, 0.0], [1e-4, 0.0];
        "at any scale": flat::plane_scale, [1e-13, 0.0], [1e-4, 0.0];
        "at a subnormal N·d": flat::plane_subnormal, [1e-13, 0.0], [1e-4, 0.0];
    }
    "square" {
        "generic": flat::square, [1e-15, 0.0], [1e-6, 0.0];
        "at its border": flat::square_border, [1e-15, 0.0], [1e-6, 0.0];
    }
    "triangle" {
        "generic": flat::triangle, [1e-10, 1e-9], [1e-3, 1e-3];
        "sliver": flat::sliver, [1e-9, 1e-8], [1e-3, 1e-3];
        "small": flat::small, [1e-11, 1e-8], [1e-4, 1e-3];
        "offset by 1e6": flat::triangle_offset, [1e-10, 1e-9], [1e-3, 1e-3];
        "mixed scale": flat::mixed_scale, [1e-8, 1e-10], [1e-3, 1e-4];
        "at a corner": flat::at_corner, [1e-15, 1e-14], [1e-6, 1e-5];
        "at an edge": flat::at_edge, [1e-15, 1e-14], [1e-6, 1e-5];
        "near edge on": flat::edge_on, [1e-8, 1e-8], [1e-3, 1e-3];
        "at any scale": flat::triangle_scale, [1e-10, 1e-9], [1e-3, 1e-3];
    }
    "box" {
        "generic": solid::cuboid, [1e-15, 0.0], [1e-6, 0.0];
        "in a slab plane": solid::in_slab, [1e-15, 0.0], [1e-6, 0.0];
        "at an edge": solid::at_edge, [1e-15, 0.0], [1e-6, 0.0];
        "offset by 1e6": solid::cuboid_offset, [1e-15, 0.0], [1e-6, 0.0];
    }
    "cylinder" {
        "generic": solid::cylinder, [1e-11, 1e-11], [1e-4, 1e-4];
        "along its axis": solid::along_axis, [1e-12, 1e-14], [1e-4, 1e-5];
        "at a rim": solid::rim, [1e-11, 1e-11], [1e-4, 1e-4];
        "touching": solid::touching, [1e-9, 1e-9], [1e-3, 1e-3];
        "far": solid::cylinder_far, [1e-14, 1e-13], [1e-6, 1e-4];
    }
    "cone" {
        "generic": solid::cone, [1e-11, 1e-10], [1e-4, 1e-3];
        "along its side": solid::along_side, [1e-12, 1e-11], [1e-4, 1e-3];
        "at its tip": solid::tip, [1e-14, ANY], [1e-6, ANY];
        "on its side": solid::on_side, [1e-14, ANY], [1e-6, ANY];
        "far": solid::cone_far, [1e-13, 1e-12], [1e-6, 1e-4];
    }
    "reflect" {
        "generic": light::reflect, [0.0, 1e-14], [0.0, 1e-5];
        "grazing": light::reflect_grazing, [0.0, 1e-14], [0.0, 1e-5];
    }
    "refract" {
        "generic": light::refract, [0.0, 1e-12], [0.0, 1e-4];
        "near critical": light::near_critical, [0.0, 1e-10], [0.0, 1e-3];
        "grazing": light::refract_grazing, [0.0, 1e-14], [0.0, 1e-5];
        "equal index": light::equal_index, [0.0, 1e-14], [0.0, 1e-5];
    }
    "normal" {
        "generic": light::normal, [0.0, 1e-14], [0.0, 1e-5];
        "stretched": light::normal_stretched, [0.0, 1e-14], [0.0, 1e-5];
        "mirrored": light::normal_mirrored, [0.0, 1e-14], [0.0, 1e-5];
        "near singular": light::normal_near_singular, [0.0, 1e-14], [0.0, 1e-5];
    }
    "transformed sphere" {
        "uniform": light::sphere_uniform, [1e-12, 1e-11], [1e-4, 1e-3];
        "stretched": light::sphere_stretched, [1e-9, 1e-11], [1e-3, 1e-1];
        "flattened": light::sphere_flattened, [1e-6, 1e-11], [1e-5, 1e-1];
        "silhouette": moved::sphere_silhouette, [1e-8, 1e-8], [1e-2, 1e-1];
        "near its surface": moved::sphere_near_surface, [1e-4, 1e-8], [1e-1, 1e-1];
        "tangent": moved::sphere_tangent, [1e-8, 1e-8], [1e-2, 1e-1];
    }
    "transformed plane" {
        "near parallel": moved::plane_near_parallel, [1e-4, 1e-13], [1e-1, 1e-5];
    }
    "transformed square" {
        "at its border": moved::square_border, [1e-11, 1e-14], [1e-2, 1e-6];
    }
    "transformed box" {
        "at an edge": moved::cuboid_edge, [1e-10, 1e-14], [1e-2, 1e-6];
        "in a slab plane": moved::cuboid_slab, [1e-13, 1e-14], [1e-5, 1e-6];
    }
    "transformed cylinder" {
        "touching": moved::cylinder_touching, [1e-8, 1e-8], [1e-2, 1e-2];
        "at a rim": moved::cylinder_rim, [1e-11, 1e-10], [1e-3, 1e-2];
    }
    "transformed cone" {
        "along its side": moved::cone_along_side, [1e-11, 1e-11], [1e-3, 1e-2];
        "at its tip": moved::cone_tip, [1e-12, ANY], [1e-5, ANY];
    }
}
