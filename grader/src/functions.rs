//! The table of the template's functions that answer the questions of unit checks, with their
//! files.

/// The beginning of a message about a function that is still to be written.
const STILL: &str = "still to be written: ";
/// The end of such a message. The function that a question goes to may be written, but call one
/// that is not.
const OR_CALLED: &str = ", or a function that it calls";

/// The function of the template that answers a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Function {
    /// The value of the key `fn` in questions to the function.
    pub key: &'static str,
    /// The function's name.
    pub name: &'static str,
    /// The file that holds it, below the template's folder.
    pub file: &'static str,
    /// Whether the function is given. If so, only a function that it calls can be missing.
    pub is_given: bool,
    /// Whether the function leaves most of its work to functions that have unit checks too.
    /// Students should correct these first.
    pub is_composed: bool,
}

const fn students(key: &'static str, name: &'static str, file: &'static str) -> Function {
    Function { key, name, file, is_given: false, is_composed: false }
}

const fn composed(key: &'static str, name: &'static str, file: &'static str) -> Function {
    Function { key, name, file, is_given: false, is_composed: true }
}

const fn given(key: &'static str, name: &'static str, file: &'static str) -> Function {
    Function { key, name, file, is_given: true, is_composed: true }
}

/// The function for each kind of question, in the order of the stages.
pub const FUNCTIONS: [Function; 26] = [
    students("eye_ray", "eye_ray", "src/camera.rs"),
    students("sphere", "intersect_sphere", "src/sphere.rs"),
    students("plane", "intersect_plane", "src/plane.rs"),
    students("square", "intersect_square", "src/plane.rs"),
    students("box", "intersect_box", "src/cuboid.rs"),
    students("triangle", "intersect_triangle", "src/triangle.rs"),
    composed("nearest", "nearest_hit", "src/nearest.rs"),
    students("to_light", "to_light", "src/light.rs"),
    students("attenuation", "distance_attenuation", "src/light.rs"),
    students("facing_normal", "facing_normal", "src/shade.rs"),
    students("ambient", "ambient", "src/shade.rs"),
    students("light_term", "light_term", "src/shade.rs"),
    composed("shade", "shade", "src/shade.rs"),
    students("shadow", "shadow_attenuation", "src/shadow.rs"),
    students("reflect", "reflect", "src/reflection.rs"),
    students("goes_on", "goes_on", "src/reflection.rs"),
    given("trace", "trace", "src/trace.rs"),
    students("indices", "indices", "src/refraction.rs"),
    students("refract", "refract", "src/refraction.rs"),
    students("ray_to_object", "ray_to_object", "src/transform.rs"),
    students("normal_to_world", "normal_to_world", "src/transform.rs"),
    given("transformed_sphere", "intersect_transformed", "src/object.rs"),
    students("barycentric", "barycentric", "src/smooth.rs"),
    students("interpolate", "interpolate_normal", "src/smooth.rs"),
    students("smooth_reflect", "smooth_reflect", "src/smooth.rs"),
    students("smooth_refract", "smooth_refract", "src/smooth.rs"),
];

/// Returns the function with this key and its index in [`FUNCTIONS`], or `None`.
pub fn find(key: &str) -> Option<(usize, &'static Function)> {
    FUNCTIONS.iter().enumerate().find(|(_, function)| function.key == key)
}

/// Returns the message for a function that answers `todo`.
///
/// A function of the template is named with its file. A function of any other program is named by
/// its key, as in the protocol.
pub fn still_to_be_written(key: &str, is_template: bool) -> String {
    match find(key).filter(|_| is_template).map(|(_, function)| function) {
        Some(Function { name, file, is_given: true, .. }) => {
            format!("{STILL}a function that `{name}` in {file} calls")
        }
        Some(Function { name, file, .. }) => format!("{STILL}`{name}` in {file}{OR_CALLED}"),
        None => format!("{STILL}the function that answers `{key}`{OR_CALLED}"),
    }
}

/// Returns the part of a message that names what is still to be written. The message is one of
/// [`still_to_be_written`] or of a picture; any other one is returned unchanged.
pub fn subject(message: &str) -> &str {
    let subject = message.strip_prefix(STILL).unwrap_or(message);
    subject.strip_suffix(OR_CALLED).unwrap_or(subject)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_named_as_its_author_knows_it() {
        let table = [
            ("sphere", true, "`intersect_sphere` in src/sphere.rs"),
            ("trace", true, "a function that `trace` in src/trace.rs calls"),
            ("sphere", false, "the function that answers `sphere`"),
            ("banana", true, "the function that answers `banana`"),
        ];
        for (key, is_template, expected) in table {
            let message = still_to_be_written(key, is_template);
            assert!(message.starts_with("still to be written: "), "{message}");
            assert_eq!(subject(&message), expected);
        }
        assert_eq!(
            subject("still to be written: eye_ray [rule 1]: src/camera.rs"),
            "eye_ray [rule 1]: src/camera.rs"
        );
    }
}
