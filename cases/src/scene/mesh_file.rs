//! Meshes from `.obj` and `.ply` files.

use std::path::Path;

use glam::DVec3;

use super::model::Mesh;
use super::raw::numbers::{MAX_NUMBER, unit};
use super::raw::objects::RawMeshFile;
use super::raw::read::Notes;
use super::{ply, text_file};

/// Bytes of a mesh file.
pub(crate) const MAX_MESH_BYTES: u64 = 64 << 20;

/// The mesh at `path`, which `raw` asks for; what is wrong is noted at the place that names the file.
pub(crate) fn read(raw: &RawMeshFile, path: &Path, notes: &mut Notes) -> Option<Mesh> {
    match mesh(raw, path) {
        Ok(mesh) => Some(mesh),
        Err(why) => {
            let message = format!("the mesh `{}` cannot be used", raw.file.value);
            notes.add(raw.file.span.clone(), message, why).help("the path is relative to the folder of this file");
            None
        }
    }
}

fn mesh(raw: &RawMeshFile, path: &Path) -> Result<Mesh, String> {
    if Path::new(raw.file.as_str()).is_absolute() {
        return Err("an absolute path: a case would not survive being moved".to_owned());
    }
    let parse = match path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("obj") => parse_obj,
        Some("ply") => ply::parse,
        _ => return Err("the name of a mesh ends in .obj or .ply".to_owned()),
    };
    let bytes = text_file::bytes(path, MAX_MESH_BYTES)?;
    let mut mesh = checked(parse(&bytes)?)?;
    match (raw.smooth, &mesh.normals) {
        (Some(true), None) => return Err("`smooth = true`, but it has no vertex normals".to_owned()),
        (Some(false), _) => mesh.normals = None,
        _ => {}
    }
    Ok(mesh)
}

/// `mesh` with its normals made unit vectors, if every number and index of it can be used.
fn checked(mut mesh: Mesh) -> Result<Mesh, String> {
    if mesh.triangles.is_empty() {
        return Err("it has no triangles".to_owned());
    }
    let usable = |vertex: &DVec3| vertex.is_finite() && vertex.abs().max_element() <= MAX_NUMBER;
    if let Some(at) = mesh.vertices.iter().position(|vertex| !usable(vertex)) {
        return Err(format!("vertex {at} (from 0) is not three numbers of at most {MAX_NUMBER:e}"));
    }
    let n_vertices = mesh.vertices.len();
    if let Some(at) = mesh.triangles.iter().position(|corners| corners.iter().any(|i| *i as usize >= n_vertices)) {
        return Err(format!("triangle {at} (from 0) has a corner that is none of its {n_vertices} vertices"));
    }
    for (at, normal) in mesh.normals.iter_mut().flatten().enumerate() {
        *normal = unit(*normal).ok_or_else(|| format!("normal {at} (from 0) has no direction"))?;
    }
    if mesh.normals.as_ref().is_some_and(|normals| normals.len() != n_vertices) {
        return Err("some of its vertices have normals, and some have none".to_owned());
    }
    Ok(mesh)
}

/// All triangles of a Wavefront file; its materials, groups and texture coordinates are left aside.
fn parse_obj(bytes: &[u8]) -> Result<Mesh, String> {
    let options = tobj::LoadOptions { single_index: true, ..Default::default() };
    let (models, _) =
        tobj::load_obj_buf(&mut &*bytes, &options, |_| Ok(Default::default())).map_err(|why| why.to_string())?;
    let mut mesh = Mesh { vertices: vec![], triangles: vec![], normals: None };
    let mut normals = vec![];
    for model in models {
        let part = model.mesh;
        if !part.face_arities.is_empty() {
            return Err("it has faces that are not triangles".to_owned());
        }
        let first = u32::try_from(mesh.vertices.len()).map_err(|_| "it has too many vertices".to_owned())?;
        mesh.vertices.extend(vectors(&part.positions));
        normals.extend(vectors(&part.normals));
        mesh.triangles.extend(part.indices.chunks_exact(3).map(|abc| [abc[0] + first, abc[1] + first, abc[2] + first]));
    }
    mesh.normals = (!normals.is_empty()).then_some(normals);
    Ok(mesh)
}

fn vectors(flat: &[f64]) -> impl Iterator<Item = DVec3> + '_ {
    flat.chunks_exact(3).map(DVec3::from_slice)
}
