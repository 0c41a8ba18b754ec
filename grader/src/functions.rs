//! The table of the templates' functions that answer the questions of unit checks, with their
//! files.

use crate::submission::Language;

/// The beginning of a message about a function that is still to be written.
const STILL: &str = "still to be written: ";
/// The end of such a message. The function that a question goes to may be written, but call one
/// that is not.
const OR_CALLED: &str = ", or a function that it calls";

/// The function of every template that answers a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Function {
    /// The value of the key `fn` in questions to the function.
    pub key: &'static str,
    /// The function's name.
    pub name: &'static str,
    /// The name of the file that holds it, without the folder and the ending, which depend on the
    /// language.
    pub stem: &'static str,
    /// Whether the function is given. If so, only a function that it calls can be missing.
    pub is_given: bool,
    /// Whether the function leaves most of its work to functions that have unit checks too.
    /// Students should correct these first.
    pub is_composed: bool,
}

const fn students(key: &'static str, name: &'static str, stem: &'static str) -> Function {
    Function { key, name, stem, is_given: false, is_composed: false }
}

const fn composed(key: &'static str, name: &'static str, stem: &'static str) -> Function {
    Function { key, name, stem, is_given: false, is_composed: true }
}

const fn given(key: &'static str, name: &'static str, stem: &'static str) -> Function {
    Function { key, name, stem, is_given: true, is_composed: true }
}

/// The function for each kind of question, in the order of the stages.
pub const FUNCTIONS: [Function; 26] = [
    students("eye_ray", "eye_ray", "camera"),
    students("sphere", "intersect_sphere", "sphere"),
    students("plane", "intersect_plane", "plane"),
    students("square", "intersect_square", "plane"),
    students("box", "intersect_box", "cuboid"),
    students("triangle", "intersect_triangle", "triangle"),
    composed("nearest", "nearest_hit", "nearest"),
    students("to_light", "to_light", "light"),
    students("attenuation", "distance_attenuation", "light"),
    students("facing_normal", "facing_normal", "shade"),
    students("ambient", "ambient", "shade"),
    students("light_term", "light_term", "shade"),
    composed("shade", "shade", "shade"),
    students("shadow", "shadow_attenuation", "shadow"),
    students("reflect", "reflect", "reflection"),
    students("goes_on", "goes_on", "reflection"),
    given("trace", "trace", "trace"),
    students("indices", "indices", "refraction"),
    students("refract", "refract", "refraction"),
    students("ray_to_object", "ray_to_object", "transform"),
    students("normal_to_world", "normal_to_world", "transform"),
    given("transformed_sphere", "intersect_transformed", "object"),
    students("barycentric", "barycentric", "smooth"),
    students("interpolate", "interpolate_normal", "smooth"),
    students("smooth_reflect", "smooth_reflect", "smooth"),
    students("smooth_refract", "smooth_refract", "smooth"),
];

/// Returns the function with this key and its index in [`FUNCTIONS`], or `None`.
pub fn find(key: &str) -> Option<(usize, &'static Function)> {
    FUNCTIONS.iter().enumerate().find(|(_, function)| function.key == key)
}

/// Returns the message for a function that answers `todo`.
///
/// A function of a template is named with its file in the language of the template. A function of
/// any other program is named by its key, as in the protocol.
pub fn still_to_be_written(key: &str, template: Option<Language>) -> String {
    let Some((language, (_, function))) = template.zip(find(key)) else {
        return format!("{STILL}the function that answers `{key}`{OR_CALLED}");
    };
    let (name, file) = (function.name, language.path(function.stem));
    if function.is_given {
        format!("{STILL}a function that `{name}` in {file} calls")
    } else {
        format!("{STILL}`{name}` in {file}{OR_CALLED}")
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
            ("sphere", Some(Language::Rust), "`intersect_sphere` in src/sphere.rs"),
            ("sphere", Some(Language::Cpp), "`intersect_sphere` in src/sphere.cpp"),
            ("box", Some(Language::Python), "`intersect_box` in tracer/cuboid.py"),
            ("trace", Some(Language::Rust), "a function that `trace` in src/trace.rs calls"),
            ("sphere", None, "the function that answers `sphere`"),
            ("banana", Some(Language::Cpp), "the function that answers `banana`"),
        ];
        for (key, template, expected) in table {
            let message = still_to_be_written(key, template);
            assert!(message.starts_with("still to be written: "), "{message}");
            assert_eq!(subject(&message), expected);
        }
        assert_eq!(
            subject("still to be written: eye_ray [rule 1]: src/camera.rs"),
            "eye_ray [rule 1]: src/camera.rs"
        );
    }
}
