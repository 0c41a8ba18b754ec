//! The measured cost of accuracy beside the cases.

use std::path::{Path, PathBuf};

use cases::files::{self, ReadError};
use cases::front::{Fronts, fronts_from_str, fronts_path, workspace_of};

/// Largest size in bytes of the file.
const MAX_BYTES: u64 = 64 << 20;

/// The reason why the measured cost of accuracy cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FrontsError {
    /// The file cannot be read.
    #[error("the cost of accuracy in {} cannot be used", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of reading.
        source: ReadError,
    },
    /// The content is not what `reference cost --store` writes.
    #[error("the cost of accuracy in {} cannot be used", .path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The error, with line and column.
        source: serde_json::Error,
    },
}

/// Returns what was measured for the stages in `folder`; `None` if there is no file.
///
/// # Errors
/// See [`FrontsError`].
pub(super) fn read(folder: &Path) -> Result<Option<Fronts>, FrontsError> {
    let path = fronts_path(folder);
    match files::read_text(&path, MAX_BYTES) {
        Ok(text) => match fronts_from_str(&text) {
            Ok(fronts) => Ok(Some(fronts)),
            Err(source) => Err(FrontsError::Format { path, source }),
        },
        Err(ReadError::Missing) => Ok(None),
        Err(source) => Err(FrontsError::Read { path, source }),
    }
}

/// Returns whether the points for the stages in `folder` were measured on other code or cases than
/// those of the workspace around it. Without sources nothing is known, and the result is false.
pub(super) fn are_old(folder: &Path, fronts: &Fronts) -> bool {
    // Sources that cannot be read are no reason to refuse a grading.
    let now = files::sources_digest(&workspace_of(folder)).unwrap_or_default();
    now.is_some() && fronts.measured_on != now
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn points_of_other_code_are_old() {
        let root = tempfile::tempdir().unwrap();
        let stages = root.path().join("cases/stages");
        std::fs::create_dir_all(&stages).unwrap();
        let fronts = |measured_on: Option<String>| Fronts {
            machine: String::new(),
            measured_on,
            cases: BTreeMap::new(),
        };
        assert!(!are_old(&stages, &fronts(None)), "a set of cases without the sources");
        std::fs::create_dir_all(root.path().join("reference/src")).unwrap();
        let now = files::sources_digest(root.path()).unwrap();
        assert!(!are_old(&stages, &fronts(now.clone())));
        assert!(are_old(&stages, &fronts(None)));
        std::fs::write(root.path().join("reference/src/lib.rs"), "changed").unwrap();
        assert!(are_old(&stages, &fronts(now)));
    }
}
