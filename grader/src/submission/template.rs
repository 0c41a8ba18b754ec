//! The template as it is handed out: which files are the student's, and what stands in all of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// The pristine copy of the assignment.
#[derive(Clone, Debug)]
pub struct Template {
    /// Its folder.
    pub folder: PathBuf,
    /// Files that are always taken from here, by path below the folder, and their text.
    pub pristine: BTreeMap<String, String>,
    /// Files that are the student's, by path below the folder, and their text as handed out.
    pub student: BTreeMap<String, String>,
    /// Crates that the student's code may use.
    pub dependencies: Vec<String>,
}

#[derive(Deserialize)]
struct Files {
    pristine: Vec<String>,
    student: Vec<String>,
}

#[derive(Deserialize)]
struct Manifest {
    #[serde(default)]
    dependencies: BTreeMap<String, toml::Value>,
}

impl Template {
    /// Reads the template in `folder`.
    ///
    /// # Errors
    /// Says which file of it is missing or broken.
    pub fn load(folder: &Path) -> Result<Self, String> {
        let files: Files = parse(&folder.join("template.toml"))?;
        let manifest: Manifest = parse(&folder.join("Cargo.toml"))?;
        let texts = |names: Vec<String>| -> Result<BTreeMap<String, String>, String> {
            names.into_iter().map(|name| Ok((name.clone(), text(&folder.join(name))?))).collect()
        };
        Ok(Self {
            folder: folder.to_owned(),
            pristine: texts(files.pristine)?,
            student: texts(files.student)?,
            dependencies: manifest.dependencies.into_keys().collect(),
        })
    }
}

fn text(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|why| format!("the template's {} cannot be read: {why}", path.display()))
}

fn parse<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, String> {
    toml::from_str(&text(path)?).map_err(|why| format!("the template's {} cannot be understood: {why}", path.display()))
}
