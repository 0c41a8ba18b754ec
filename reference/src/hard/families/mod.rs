//! The families of hard questions.

mod flat;
mod light;
mod solid;
mod spheres;

use super::draws::Draws;
use super::question::Question;

/// A kind of hard question.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Such as `far`; with the function unique.
    pub name: &'static str,
    /// Which function is asked: `sphere`, `triangle`, ...
    pub function: &'static str,
    /// The next question.
    pub draw: fn(&mut Draws) -> Question,
}

macro_rules! families {
    ($($function:literal { $($name:literal: $draw:path,)* })*) => {
        /// All families, function by function.
        pub const FAMILIES: &[Family] = &[$($(Family { name: concat!($function, ", ", $name), function: $function, draw: $draw },)*)*];
    };
}

families! {
    "sphere" {
        "generic": spheres::generic,
        "far": spheres::far,
        "tangent": spheres::tangent,
        "near its surface": spheres::near_surface,
        "as a ground": spheres::ground,
        "mixed coordinates": spheres::coordinates,
        "offset by 1e6": spheres::offset,
        "at any scale": spheres::scale,
    }
    "plane" {
        "generic": flat::plane,
        "near parallel": flat::plane_near_parallel,
        "offset by 1e6": flat::plane_offset,
        "at any scale": flat::plane_scale,
    }
    "square" {
        "generic": flat::square,
        "at its border": flat::square_border,
    }
    "triangle" {
        "generic": flat::triangle,
        "sliver": flat::sliver,
        "small": flat::small,
        "offset by 1e6": flat::triangle_offset,
        "mixed scale": flat::mixed_scale,
        "at a corner": flat::at_corner,
        "at an edge": flat::at_edge,
        "near edge on": flat::edge_on,
        "at any scale": flat::triangle_scale,
    }
    "box" {
        "generic": solid::cuboid,
        "in a slab plane": solid::in_slab,
        "at an edge": solid::at_edge,
        "offset by 1e6": solid::cuboid_offset,
    }
    "cylinder" {
        "generic": solid::cylinder,
        "along its axis": solid::along_axis,
        "at a rim": solid::rim,
        "touching": solid::touching,
    }
    "cone" {
        "generic": solid::cone,
        "along its side": solid::along_side,
        "at its tip": solid::tip,
    }
    "reflect" {
        "generic": light::reflect,
        "grazing": light::reflect_grazing,
    }
    "refract" {
        "generic": light::refract,
        "near critical": light::near_critical,
        "grazing": light::refract_grazing,
        "equal index": light::equal_index,
    }
    "normal" {
        "generic": light::normal,
        "stretched": light::normal_stretched,
        "mirrored": light::normal_mirrored,
        "near singular": light::normal_near_singular,
    }
    "transformed sphere" {
        "uniform": light::sphere_uniform,
        "stretched": light::sphere_stretched,
        "flattened": light::sphere_flattened,
    }
}
