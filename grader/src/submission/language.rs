//! The languages that the assignment is handed out in, and where each template keeps its files.

use serde::Deserialize;

/// The language of a template.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// The template that the grader carries.
    Rust,
    /// The template in C++17, in `student_template/cpp`.
    Cpp,
    /// The template in Python 3, in `student_template/python`.
    Python,
}

impl Language {
    /// Returns the folder that holds the functions, below the template's folder.
    pub fn folder(self) -> &'static str {
        match self {
            Self::Rust | Self::Cpp => "src",
            Self::Python => "tracer",
        }
    }

    /// Returns the name of the file that is called `stem` in every template, such as `sphere.cpp`.
    pub fn file(self, stem: &str) -> String {
        let ending = match self {
            Self::Rust => "rs",
            Self::Cpp => "cpp",
            Self::Python => "py",
        };
        format!("{stem}.{ending}")
    }

    /// Returns the path of that file below the template's folder, such as `src/sphere.cpp`.
    pub fn path(self, stem: &str) -> String {
        format!("{}/{}", self.folder(), self.file(stem))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_the_same_stem_in_every_template() {
        let table = [
            (Language::Rust, "src/sphere.rs"),
            (Language::Cpp, "src/sphere.cpp"),
            (Language::Python, "tracer/sphere.py"),
        ];
        for (language, path) in table {
            assert_eq!(language.path("sphere"), path);
        }
    }
}
