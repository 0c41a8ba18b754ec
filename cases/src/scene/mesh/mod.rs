//! Meshes from Wavefront `.obj` and `.ply` files.

mod checks;
mod faces;
mod fault;
mod inline;
mod obj;
mod ply;
mod polygon;
mod text;

use std::path::Path;

use super::model::Mesh;
use super::raw::objects::RawMeshFile;
use super::raw::read::Notes;
use crate::files;
use fault::Fault;
pub(crate) use inline::inline;

/// Largest size of a mesh file, in bytes.
pub(crate) const MAX_MESH_BYTES: u64 = 64 << 20;

/// Returns the mesh at `path`, which `raw` names, or `None` after noting a problem where the file
/// is named.
pub(crate) fn read(raw: &RawMeshFile, path: &Path, notes: &mut Notes) -> Option<Mesh> {
    mesh(raw, path)
        .map_err(|(why, help)| {
            let message = format!("the mesh `{}` cannot be used", raw.file.value);
            notes.add(raw.file.span.clone(), message, why).help(help);
        })
        .ok()
}

/// Returns the mesh, or the reason why there is none and a way to fix it.
fn mesh(raw: &RawMeshFile, path: &Path) -> Result<Mesh, (String, String)> {
    let refused = |why: &str, help: &str| Err((why.to_owned(), help.to_owned()));
    if Path::new(raw.file.as_str()).is_absolute() {
        let help = "write the path relative to the folder of this file";
        return refused("an absolute path: a case would not survive being moved", help);
    }
    let parse =
        match path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase).as_deref()
        {
            Some("obj") => obj::parse,
            Some("ply") => ply::parse,
            _ => {
                return refused(
                    "the name of a mesh ends in .obj or .ply",
                    "convert the mesh to one of these formats",
                );
            }
        };
    let bytes = files::read(path, MAX_MESH_BYTES).map_err(|why| {
        (why.to_string(), "the path is relative to the folder of this file".to_owned())
    })?;
    parse(&bytes, raw.smooth != Some(false))
        .and_then(|mesh| usable(mesh, raw.smooth == Some(true)))
        .map_err(|fault| (fault.describe(&path.display().to_string(), &bytes), fault.help))
}

/// Returns the mesh if it has triangles, and normals where they are needed.
fn usable(mesh: Mesh, needs_normals: bool) -> Result<Mesh, Fault> {
    if mesh.triangles.is_empty() {
        return Err(Fault::of_file(
            "it has no triangles",
            "give it at least one face with an area",
        ));
    }
    if needs_normals && mesh.normals.is_none() {
        let help = "leave `smooth` out, or add normals in the program that wrote the file";
        return Err(Fault::of_file("it has no vertex normals, which `smooth = true` needs", help));
    }
    Ok(mesh)
}
