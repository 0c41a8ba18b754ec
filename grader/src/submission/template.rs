//! The template as it is handed out: which files the student writes, and the text of all files.
//!
//! The text is part of the grader. A student edits the template's folder, and an edit there must
//! not change how a submission is graded.

use std::collections::BTreeMap;

/// The assignment as it is handed out.
#[derive(Clone, Debug)]
pub struct Template {
    /// Text of the given files, by path below the folder. A submission's versions of them are not
    /// used.
    pub pristine: BTreeMap<String, String>,
    /// Text of the files that the student writes, by path below the folder, as they are handed out.
    pub student: BTreeMap<String, String>,
    /// Crates that the student's code may use.
    pub dependencies: Vec<String>,
}

/// Paths in the folder of the template, each with the text of the grader's copy.
macro_rules! files {
    ($($path:literal),* $(,)?) => {
        [$(($path, include_str!(concat!("../../given/", $path)))),*]
    };
}

const PRISTINE: [(&str, &str); 9] = files![
    "Cargo.toml",
    "clippy.toml",
    "template.toml",
    "src/main.rs",
    "src/object.rs",
    "src/probe.rs",
    "src/round.rs",
    "src/surface.rs",
    "src/trace.rs",
];

const STUDENT: [(&str, &str); 13] = files![
    "src/camera.rs",
    "src/cuboid.rs",
    "src/light.rs",
    "src/nearest.rs",
    "src/plane.rs",
    "src/reflection.rs",
    "src/refraction.rs",
    "src/shade.rs",
    "src/shadow.rs",
    "src/smooth.rs",
    "src/sphere.rs",
    "src/transform.rs",
    "src/triangle.rs",
];

const DEPENDENCIES: [&str; 2] = ["cases", "glam"];

impl Template {
    /// Returns the template that the grader carries.
    pub fn carried() -> Self {
        let texts = |files: &[(&str, &str)]| {
            files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect()
        };
        let dependencies = DEPENDENCIES.map(str::to_owned).to_vec();
        Self { pristine: texts(&PRISTINE), student: texts(&STUDENT), dependencies }
    }
}
