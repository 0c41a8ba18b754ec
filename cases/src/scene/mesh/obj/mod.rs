//! Reads Wavefront files: the vertices, normals and faces of the format, as its documents and the
//! usual programs write them.
//!
//! Parts that no mesh of triangles needs are skipped, whatever they hold: texture coordinates,
//! colours and weights of vertices, lines, points, groups, materials, free-form curves and
//! surfaces, and keywords that the format does not have.

mod scan;
mod statements;
mod vertices;

use super::faces::Faces;
use super::fault::{Fault, Place};
use crate::scene::model::Mesh;
use scan::Scan;
use statements::{NONE, Obj};
use vertices::Vertices;

/// Parses a file. The mesh has normals only if `with_normals`. A vertex is a pair of position and
/// normal that some corner has; vertices are in the order of the corners.
///
/// # Errors
/// The file has no triangles, or something that they need cannot be used.
pub(super) fn parse(bytes: &[u8], with_normals: bool) -> Result<Mesh, Fault> {
    mesh(&Obj::read(bytes, with_normals)?)
}

/// Builds the mesh of the statements.
fn mesh(obj: &Obj) -> Result<Mesh, Fault> {
    if obj.faces.is_empty() {
        return Err(without_faces(obj));
    }
    let is_smooth = obj.corners.iter().any(|corner| corner.normal != NONE);
    let mut vertices = Vertices::new(obj, is_smooth);
    let mut faces = Faces::default();
    let (mut start, mut face_corners) = (0, vec![]);
    for face in &obj.faces {
        face_corners.clear();
        for (n, corner) in obj.corners[start..face.end].iter().enumerate() {
            face_corners
                .push(vertices.number(*corner).map_err(|fault| at_corner(obj, fault, face.at, n))?);
        }
        faces.push(&face_corners, face.at);
        start = face.end;
    }
    let Vertices { positions, normals, .. } = vertices;
    let triangles = faces.triangulate(&positions, |_, at| Place::Text(at))?;
    Ok(Mesh { vertices: positions, triangles, normals: is_smooth.then_some(normals) })
}

fn without_faces(obj: &Obj) -> Fault {
    let help = "give the file at least one face (`f`)";
    match &obj.other {
        Some(other) => other.fault("and the like are not read, and there are no faces", help),
        None => Fault::of_file("it has no faces", help),
    }
}

/// Moves the fault to corner `n` of a face, unless it has a place of its own.
fn at_corner(obj: &Obj, fault: Fault, face: usize, n: usize) -> Fault {
    let mut scan = Scan::new(obj.bytes, face);
    scan.keyword();
    let corner = (0..=n).filter_map(|_| scan.word()).last().map_or(face, |word| word.at);
    if fault.place == Place::File { Fault { place: Place::Text(corner), ..fault } } else { fault }
}
