//! The questions of unit checks as they are written. They have the arguments of [`Ask`], but with
//! names of scenes, materials and objects, and with lists of transforms instead of matrices.

use super::args::{self, Arg};
use super::named::Named;
use crate::probe::Ask;
use crate::problem::{did_you_mean, quoted};
use crate::scene::raw::read::{At, Notes, Read, Table, Value};

/// Declares the question of each function: its name, its [`Ask`], and the kind of each argument.
macro_rules! asks {
    ($($function:literal $variant:ident { $($name:ident : $arg:ident),* })*) => {
        /// The functions of the unit checks, each with the keys of its question and the values of
        /// each key.
        pub(crate) const FUNCTIONS: &[(&str, &[(&str, &str)])] =
            &[$(($function, &[$((key(stringify!($name)), <args::$arg as Arg>::TAKES)),*])),*];

        /// Reads the question in `value`. Returns `None` after noting a problem.
        pub(super) fn read(value: &Value<'_>, named: &Named, notes: &mut Notes) -> Option<Ask> {
            match function(value, notes)?.as_str() {
                $($function => {
                    let what = concat!("a question to `", $function, "`");
                    let keys = ["fn", $(key(stringify!($name))),*];
                    let table = Table::open(what, &keys, value, notes)?;
                    $(let $name = args::$arg::take(key(stringify!($name)), &table, named, notes);)*
                    Some(Ask::$variant { $($name: $name?),* })
                })*
                _ => None,
            }
        }
    };
}

asks! {
    "eye_ray" EyeRay { camera: CameraTable, width: Pixels, height: Pixels, pixel: Pixel }
    "sphere" Sphere { ray: RayTable, center: Vector, radius: Length }
    "plane" Plane { ray: RayTable, normal: Unit, k: Real }
    "square" Square { ray: RayTable }
    "box" Box { ray: RayTable, min: Vector, max: Vector }
    "triangle" Triangle { ray: RayTable, a: Vector, b: Vector, c: Vector }
    "nearest" Nearest { scene: SceneName, ray: RayTable }
    "attenuation" Attenuation { light: LightTable, r: Distance }
    "facing_normal" FacingNormal { direction: Unit, normal: Unit }
    "ambient" Ambient { material: MaterialName, light: LightTable, inside: Flag }
    "light_term" LightTerm {
        material: MaterialName, arriving: Rgb, normal: Unit,
        to_viewer: Unit, to_light: Unit
    }
    "shade" Shade {
        scene: SceneName, object: ObjectName, point: Vector,
        normal: Unit, to_viewer: Unit, inside: Flag
    }
    "to_light" ToLight { light: LightTable, point: Vector }
    "shadow" Shadow { scene: SceneName, light: LightIndex, point: Vector }
    "reflect" Reflect { direction: Unit, normal: Unit }
    "goes_on" GoesOn { depth: Levels, max_depth: Levels, weight: Rgb, threshold: Coefficient }
    "indices" Indices { inside: Flag, index: Length }
    "refract" Refract { direction: Unit, normal: Unit, eta_i: Length, eta_t: Length }
    "trace" Trace { scene: SceneName, ray: RayTable, depth: Levels }
    "ray_to_object" RayToObject { ray: RayTable, object_from_world: ObjectFromWorld }
    "normal_to_world" NormalToWorld { normal: Unit, object_from_world: ObjectFromWorld }
    "transformed_sphere" TransformedSphere {
        ray: RayTable, world_from_object: WorldFromObject, object_from_world: ObjectFromWorld
    }
    "barycentric" Barycentric { a: Vector, b: Vector, c: Vector, q: Vector }
    "interpolate" Interpolate { weights: Vector, normals: Units }
    "smooth_reflect" SmoothReflect { direction: Unit, n_geom: Unit, n_shading: Unit }
    "smooth_refract" SmoothRefract {
        direction: Unit, n_geom: Unit, n_shading: Unit,
        eta_i: Length, eta_t: Length
    }
}

/// Returns the key that gives an argument. Both matrices come from one list of transforms.
const fn key(argument: &'static str) -> &'static str {
    match argument.as_bytes() {
        b"world_from_object" | b"object_from_world" => "transforms",
        _ => argument,
    }
}

/// Returns the function that a question names, or `None` after noting a problem.
fn function(value: &Value<'_>, notes: &mut Notes) -> Option<At<String>> {
    let Some(entries) = value.get_ref().as_table() else {
        notes.wrong(value, "a question: a table with the key `fn`");
        return None;
    };
    let Some(name) = entries.get("fn") else {
        notes.add(value.span(), "missing key `fn`", "name the function to call");
        return None;
    };
    let name = At::<String>::read(name, notes)?;
    let functions = || FUNCTIONS.iter().map(|(function, _)| *function);
    if functions().any(|function| function == name.value) {
        return Some(name);
    }
    let problem = notes.add(
        name.span.clone(),
        format!("unknown function `{}`", name.value),
        "no such function can be called",
    );
    problem.help(match did_you_mean(&name, functions()) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("the functions are {}", quoted(functions())),
    });
    None
}
