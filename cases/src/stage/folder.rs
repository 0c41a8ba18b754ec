//! The files of a stage's folder.

use std::path::{Path, PathBuf};

use crate::problem::Problems;

/// Returns whether `path` is an image case of a stage: a TOML file whose folder holds a
/// `stage.toml`.
pub fn is_case(path: &Path) -> bool {
    is_toml(path) && file_name(path) != "stage.toml" && path.with_file_name("stage.toml").is_file()
}

/// Returns the paths of all entries of `folder`, ordered by name.
pub(super) fn entries(folder: &Path) -> Result<Vec<PathBuf>, Problems> {
    let list = || {
        std::fs::read_dir(folder)?
            .map(|entry| Ok(entry?.path()))
            .collect::<std::io::Result<Vec<_>>>()
    };
    let mut paths = list().map_err(|why| Problems::of_listing(folder, &why))?;
    paths.sort();
    Ok(paths)
}

/// Returns whether `path` is a TOML file.
pub(super) fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|end| end == "toml") && path.is_file()
}

/// Returns the name of the file.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Returns the name of the file without its ending.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
