//! The mesh files that a case names. They are copied with it, to below its own folder.

use std::path::{Path, PathBuf};

use toml_edit::visit_mut::{VisitMut, visit_table_like_mut};
use toml_edit::{DocumentMut, Item, TableLike, Value};

/// A file that is copied with a case. Its paths are relative to the folder of the file that names
/// it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Asset {
    /// The current path, which may go up with `..`.
    pub from: PathBuf,
    /// The new path, which never goes up.
    pub to: PathBuf,
}

/// Returns the mesh files that `document`, a case or a file of checks, names. The names in the
/// document are changed to the new paths.
pub fn take_along(document: &mut DocumentMut) -> Vec<Asset> {
    let mut taking = Taking(vec![]);
    taking.visit_document_mut(document);
    taking.0
}

struct Taking(Vec<Asset>);

impl VisitMut for Taking {
    fn visit_table_like_mut(&mut self, table: &mut dyn TableLike) {
        let file = table
            .get_mut("mesh")
            .and_then(Item::as_table_like_mut)
            .and_then(|mesh| mesh.get_mut("file"));
        if let Some(Item::Value(file)) = file
            && let Some(from) = file.as_str().map(PathBuf::from)
        {
            let to = below(&from);
            *file = Value::from(to.display().to_string());
            self.0.push(Asset { from, to });
        }
        visit_table_like_mut(self, table);
    }
}

/// Returns `path` with a folder `up` for each `..`, so that two different paths stay different.
fn below(path: &Path) -> PathBuf {
    path.components()
        .map(|part| if part.as_os_str() == ".." { "up".as_ref() } else { part.as_os_str() })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_come_to_lie_below_the_stage() {
        let mut case: DocumentMut = "[[scene.objects]]\n\
            mesh = { file = \"../../assets/torus.ply\" }\n[[scene.objects]]\n\
            group = [{ mesh = { file = \"up.obj\", smooth = false } }]\n"
            .parse()
            .unwrap();
        let asset = |from: &str, to: &str| Asset { from: from.into(), to: to.into() };
        let expected =
            [asset("../../assets/torus.ply", "up/up/assets/torus.ply"), asset("up.obj", "up.obj")];
        assert_eq!(take_along(&mut case), expected);
        assert!(case.to_string().contains("file = \"up/up/assets/torus.ply\""), "{case}");
        assert!(case.to_string().contains("smooth = false"), "{case}");
    }
}
