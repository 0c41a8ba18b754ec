//! The faces of a mesh file, in file order, and their division into triangles.

use glam::DVec3;

use super::fault::{Fault, Place};
use super::polygon;
use crate::scene::limits::MAX_TRIANGLES;

/// Faces as lists of vertices. Triangles are stored apart, in 12 bytes each: most files have no
/// others.
#[derive(Debug, Default)]
pub(super) struct Faces {
    triangles: Vec<[u32; 3]>,
    polygons: Vec<Polygon>,
    /// The corners of all polygons.
    corners: Vec<u32>,
}

/// A face of more than three corners.
#[derive(Debug)]
struct Polygon {
    /// Number of triangles that come before it in the file.
    after: usize,
    /// End of its corners in the list of all corners.
    end: usize,
    /// Offset of the face in the file.
    at: usize,
}

impl Faces {
    /// Returns an empty list with room for `n` triangles.
    pub(super) fn with_capacity(n: usize) -> Self {
        Self { triangles: Vec::with_capacity(n), ..Self::default() }
    }

    /// Adds a face of three corners or more. `at` is its offset in the file.
    pub(super) fn push(&mut self, corners: &[u32], at: usize) {
        if let [a, b, c] = *corners {
            self.triangles.push([a, b, c]);
            return;
        }
        self.corners.extend_from_slice(corners);
        self.polygons.push(Polygon { after: self.triangles.len(), end: self.corners.len(), at });
    }

    /// Returns the vertices at the corners of all faces, in no certain order.
    pub(super) fn corners(&self) -> impl Iterator<Item = u32> {
        self.triangles.iter().flatten().chain(&self.corners).copied()
    }

    /// Returns the triangles of all faces, in the order of the faces. Every corner must be a
    /// vertex.
    ///
    /// # Errors
    /// A polygon has no certain surface, or there are more triangles than a scene may have. `place`
    /// makes a place of the number of a face, from 0, and its offset.
    pub(super) fn triangulate(
        self,
        vertices: &[DVec3],
        place: impl Fn(usize, usize) -> Place,
    ) -> Result<Vec<[u32; 3]>, Fault> {
        if self.polygons.is_empty() {
            return Ok(self.triangles);
        }
        if self.triangles.len() + self.corners.len() - 2 * self.polygons.len() > MAX_TRIANGLES {
            let help = "use a coarser mesh, or divide it among several scenes";
            return Err(Fault::of_file(
                format!("it has more than {MAX_TRIANGLES} triangles"),
                help,
            ));
        }
        let mut triangles = Vec::with_capacity(self.triangles.len() + self.corners.len());
        let (mut taken, mut start) = (0, 0);
        for (n, polygon) in self.polygons.iter().enumerate() {
            triangles.extend_from_slice(&self.triangles[taken..polygon.after]);
            let corners = &self.corners[start..polygon.end];
            let positions: Vec<DVec3> =
                corners.iter().map(|corner| vertices[*corner as usize]).collect();
            let cut = polygon::triangulate(&positions).map_err(|why| Fault {
                place: place(polygon.after + n, polygon.at),
                what: format!("this face of {} corners {why}", corners.len()),
                help: "divide the face into triangles in the program that wrote the file"
                    .to_owned(),
            })?;
            triangles.extend(cut.into_iter().map(|abc| abc.map(|n| corners[n])));
            (taken, start) = (polygon.after, polygon.end);
        }
        triangles.extend_from_slice(&self.triangles[taken..]);
        Ok(triangles)
    }
}
