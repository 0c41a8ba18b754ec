//! Reads PLY files, as text and in both binary encodings.
//!
//! The elements `vertex` and `face` make the mesh. All other elements and properties are skipped,
//! whatever they hold. In the text encoding the numbers are a stream of words: lines do not matter.
//! Anything but white space after the last element is an error, because it shows that the header
//! does not describe the file.

mod header;
mod records;
mod values;

use glam::DVec3;

use super::checks::{checked_normal, checked_position};
use super::faces::Faces;
use super::fault::Fault;
use crate::scene::model::Mesh;
use header::{Element, Encoding, Header, Kind, Property};
use records::{check_count, n_entries, pass, skip, within};
use values::{Binary, Text, Values};

const POSITION: [&str; 3] = ["x", "y", "z"];
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
/// The names of the list of a face's corners. The first one is used if a file has both.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Parses a file. The mesh has normals only if `with_normals`.
///
/// # Errors
/// The file has no triangles, or something that they need cannot be used.
pub(super) fn parse(bytes: &[u8], with_normals: bool) -> Result<Mesh, Fault> {
    let header = Header::parse(bytes)?;
    let (end, plan) = (header.end, Plan::of(&header, with_normals)?);
    match header.encoding {
        Encoding::Text => plan.read(Text::new(bytes, end)),
        Encoding::LittleEndian => plan.read(Binary::<true>::new(bytes, end)),
        Encoding::BigEndian => plan.read(Binary::<false>::new(bytes, end)),
    }
}

/// The use that is made of a property of a record.
#[derive(Clone, Copy)]
enum Use {
    /// The property is skipped.
    Skip,
    /// The property is a coordinate: x, y, z, and nx, ny, nz from 3 on.
    Coordinate(usize),
    /// The property is the list of corners.
    Corners,
}

/// The parts of a file that are read.
struct Plan<'a> {
    header: &'a Header<'a>,
    /// Use of each property of `vertex`.
    vertex: Vec<Use>,
    has_normals: bool,
    n_vertices: usize,
    /// Use of each property of `face`.
    face: Vec<Use>,
}

impl<'a> Plan<'a> {
    fn of(header: &'a Header<'a>, with_normals: bool) -> Result<Self, Fault> {
        let missing = |name: &str, help: &str| {
            Fault::of_file(format!("the header has no element `{name}`"), help)
        };
        let vertex =
            header.element("vertex")?.ok_or_else(|| missing("vertex", "a mesh needs vertices"))?;
        let mut n_normals = 0;
        for name in NORMAL.iter().filter(|_| with_normals) {
            n_normals += usize::from(position(vertex, name)?.is_some());
        }
        if !matches!(n_normals, 0 | 3) {
            let help = "give all three, or leave normals out with `smooth = false`";
            return Err(vertex.fault("has some of nx, ny and nz, but not all of them", help));
        }
        let has_normals = n_normals == 3;
        let mut of_vertex = vec![Use::Skip; vertex.properties.len()];
        for (n, name) in POSITION.iter().chain(NORMAL.iter().filter(|_| has_normals)).enumerate() {
            match position(vertex, name)? {
                Some(at) if vertex.properties[at].count.is_none() => {
                    of_vertex[at] = Use::Coordinate(n)
                }
                Some(_) => {
                    return Err(
                        vertex.fault(&format!("has a list as its `{name}`"), "make it a number")
                    );
                }
                None => {
                    let what = format!("has no property `{name}`");
                    return Err(vertex.fault(&what, "a vertex needs x, y and z"));
                }
            }
        }
        let help = "a mesh needs faces; points and strips of triangles are not read";
        let face = header.element("face")?.ok_or_else(|| missing("face", help))?;
        let mut of_face = vec![Use::Skip; face.properties.len()];
        match position(face, CORNERS[0])?.or(position(face, CORNERS[1])?) {
            Some(at) if is_list_of_whole(&face.properties[at]) => of_face[at] = Use::Corners,
            Some(_) => {
                let help = "declare it as `property list uchar int vertex_indices`";
                return Err(face.fault("has corners that are not a list of whole numbers", help));
            }
            None => {
                let what = "has no property `vertex_indices` or `vertex_index`";
                return Err(face.fault(what, "declare `property list uchar int vertex_indices`"));
            }
        }
        Ok(Self { header, vertex: of_vertex, has_normals, n_vertices: vertex.count, face: of_face })
    }

    fn read<V: Values + Clone>(&self, mut values: V) -> Result<Mesh, Fault> {
        let (mut vertices, mut normals, mut faces) = (vec![], vec![], Faces::default());
        let mut vertices_at = values.clone();
        for element in &self.header.elements {
            check_count(element, &mut values)?;
            match element.name.text {
                b"vertex" => {
                    vertices_at = values.clone();
                    (vertices, normals) = self.vertices(element, &mut values)?;
                }
                b"face" => faces = self.faces(element, &mut values)?,
                _ => skip(element, &mut values, element.count)?,
            }
        }
        let surplus = values.surplus();
        if surplus > 0 {
            let (at, what) = (values.at(), format!("bytes after the last element: {surplus}"));
            let help = "the header does not describe the file: correct its counts and types, or \
                cut the rest off";
            return Err(Fault {
                place: values.place(at, "the end".to_owned()),
                what,
                help: help.to_owned(),
            });
        }
        let at_vertex = |(n, fault)| {
            let element =
                self.header.elements.iter().find(|element| element.name.text == b"vertex");
            let mut vertices_at = vertices_at.clone();
            let passed = element.map(|element| skip(element, &mut vertices_at, n));
            let at =
                if matches!(passed, Some(Ok(()))) { vertices_at.at() } else { self.header.end };
            Fault { place: values.place(at, format!("vertex {n}")), ..fault }
        };
        settle(&mut vertices, faces.corners(), checked_position, DVec3::ZERO).map_err(at_vertex)?;
        let triangles =
            faces.triangulate(&vertices, |n, at| values.place(at, format!("face {n}")))?;
        if self.has_normals {
            let corners = triangles.iter().flatten().copied();
            settle(&mut normals, corners, checked_normal, DVec3::Z).map_err(at_vertex)?;
        }
        Ok(Mesh { vertices, triangles, normals: self.has_normals.then_some(normals) })
    }

    /// Returns the positions of all vertices, and their normals as in the file, if these are
    /// needed.
    fn vertices(
        &self,
        element: &Element<'_>,
        values: &mut impl Values,
    ) -> Result<(Vec<DVec3>, Vec<DVec3>), Fault> {
        let mut vertices = Vec::with_capacity(element.count);
        let mut normals = Vec::with_capacity(if self.has_normals { element.count } else { 0 });
        for n in 0..element.count {
            let mut numbers = [0.0; 6];
            for (property, used) in element.properties.iter().zip(&self.vertex) {
                match used {
                    Use::Coordinate(at) => {
                        values.real(property.kind).map(|number| numbers[*at] = number)
                    }
                    _ => pass(property, values),
                }
                .map_err(|fault| within(fault, element, n, values))?;
            }
            let [x, y, z, nx, ny, nz] = numbers;
            vertices.push(DVec3::new(x, y, z));
            if self.has_normals {
                normals.push(DVec3::new(nx, ny, nz));
            }
        }
        Ok((vertices, normals))
    }

    fn faces(&self, element: &Element<'_>, values: &mut impl Values) -> Result<Faces, Fault> {
        let mut faces = Faces::with_capacity(element.count);
        let mut corners = vec![];
        for n in 0..element.count {
            let start = values.at();
            for (property, used) in element.properties.iter().zip(&self.face) {
                match (used, property.count) {
                    (Use::Corners, Some(count)) => {
                        self.corners(property, count, values, &mut corners)
                    }
                    _ => pass(property, values),
                }
                .map_err(|fault| within(fault, element, n, values))?;
            }
            if corners.len() < 3 {
                // Counts that do not fit the data are more likely than a face without an area.
                let what = format!("the number of corners of this face is {}", corners.len());
                let help =
                    "give a face three corners or more, and correct the counts of the header";
                return Err(within(Fault::at(start, what, help), element, n, values));
            }
            faces.push(&corners, start);
        }
        Ok(faces)
    }

    fn corners(
        &self,
        property: &Property<'_>,
        count: Kind,
        values: &mut impl Values,
        corners: &mut Vec<u32>,
    ) -> Result<(), Fault> {
        corners.clear();
        let n_corners = n_entries(property, count, values)?;
        for _ in 0..n_corners {
            let at = values.at();
            let index = values.whole(property.kind)?;
            match u32::try_from(index) {
                Ok(vertex) if (vertex as usize) < self.n_vertices => corners.push(vertex),
                _ => {
                    let what = format!(
                        "a corner is vertex {index}, and the vertices are 0 to {}",
                        self.n_vertices as i64 - 1
                    );
                    return Err(Fault::at(at, what, "indices count from 0"));
                }
            }
        }
        Ok(())
    }
}

/// Returns the index of the property of that name, or `None` if the element has none.
fn position(element: &Element<'_>, name: &str) -> Result<Option<usize>, Fault> {
    let mut found =
        (0..element.properties.len()).filter(|n| element.properties[*n].name == name.as_bytes());
    match (found.next(), found.next()) {
        (_, Some(_)) => Err(element.fault(&format!("declares `{name}` twice"), "declare it once")),
        (first, None) => Ok(first),
    }
}

fn is_list_of_whole(property: &Property<'_>) -> bool {
    property.count.is_some() && property.kind.range().is_some()
}

/// Replaces each vector by the result of `checked`. A vector for which `checked` fails becomes
/// `spare`, unless the list `used` of the vectors that the mesh needs names it.
///
/// # Errors
/// The mesh needs a vector for which `checked` fails: the number of its vertex, and the fault.
fn settle(
    vectors: &mut [DVec3],
    used: impl Iterator<Item = u32>,
    checked: fn(DVec3) -> Result<DVec3, Fault>,
    spare: DVec3,
) -> Result<(), (usize, Fault)> {
    let mut unusable = vec![];
    for (n, vector) in vectors.iter_mut().enumerate() {
        match checked(*vector) {
            Ok(usable) => *vector = usable,
            Err(_) => unusable.push(n),
        }
    }
    if unusable.is_empty() {
        return Ok(());
    }
    let mut is_used = vec![false; vectors.len()];
    used.for_each(|vertex| is_used[vertex as usize] = true);
    for n in unusable {
        if is_used[n] {
            checked(vectors[n]).map_err(|fault| (n, fault))?;
        }
        vectors[n] = spare;
    }
    Ok(())
}
