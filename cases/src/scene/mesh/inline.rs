//! Meshes that are written out in a scene.

use crate::scene::model::Mesh;
use crate::scene::raw::numbers::Index;
use crate::scene::raw::objects::RawMeshInline;
use crate::scene::raw::read::Notes;

/// Returns the mesh that `raw` lists, or `None` after noting every problem.
pub(crate) fn inline(raw: &RawMeshInline, notes: &mut Notes) -> Option<Mesh> {
    let n_vertices = raw.vertices.len();
    let mut is_whole = true;
    for triangle in &raw.triangles {
        if let Some(Index(index)) = triangle.iter().find(|index| index.0 as usize >= n_vertices) {
            let label = format!("there are {n_vertices} vertices, counted from 0");
            notes.add(triangle.span.clone(), format!("there is no vertex {index}"), label);
            is_whole = false;
        }
    }
    if let Some(normals) = &raw.normals
        && normals.len() != n_vertices
    {
        let message = format!("{} normals for {n_vertices} vertices", normals.len());
        notes.add(normals.span.clone(), message, "a smooth mesh has one normal for every vertex");
        is_whole = false;
    }
    is_whole.then(|| Mesh {
        vertices: raw.vertices.iter().map(|vertex| vertex.get()).collect(),
        triangles: raw.triangles.iter().map(|triangle| triangle.map(|index| index.0)).collect(),
        normals: raw
            .normals
            .as_ref()
            .map(|normals| normals.iter().map(|normal| normal.get()).collect()),
    })
}
