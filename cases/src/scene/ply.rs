//! PLY files: the elements `vertex` and `face`, each straight into numbers, without a map of properties for every one of a million.

use glam::DVec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType};

use super::model::Mesh;

const PLACE: [&str; 3] = ["x", "y", "z"];
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];

/// The elements `vertex` (x, y, z, and nx, ny, nz if it has them) and `face` (vertex_indices, or vertex_index) of a text or binary file.
///
/// # Errors
/// What is wrong, in a few words.
pub(super) fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Aside>::new().read_header(&mut reader).map_err(|why| why.to_string())?;
    let (mut vertices, mut faces): (Vec<Vertex>, Vec<Face>) = (vec![], vec![]);
    for (name, element) in &header.elements {
        if element.count > bytes.len() {
            return Err(format!("it promises {} of `{name}`, more than it has bytes", element.count));
        }
        match name.as_str() {
            "vertex" => vertices = read(&mut reader, element, &header)?,
            "face" => faces = read(&mut reader, element, &header)?,
            _ => drop(read::<Aside>(&mut reader, element, &header)?),
        }
    }
    let has = |name: &str| header.elements.get("vertex").is_some_and(|vertex| is_number(vertex, name));
    if !vertices.is_empty() && !PLACE.iter().all(|name| has(name)) {
        return Err("it has vertices without x, y, z".to_owned());
    }
    let is_smooth = NORMAL.iter().any(|name| has(name));
    if is_smooth && !NORMAL.iter().all(|name| has(name)) {
        return Err("it has vertices with some of nx, ny, nz, but not all of them".to_owned());
    }
    let triangles: Option<Vec<[u32; 3]>> = faces.iter().map(|face| face.0).collect();
    Ok(Mesh {
        triangles: triangles.ok_or("it has faces that are not triangles")?,
        normals: is_smooth.then(|| vertices.iter().map(|vertex| DVec3::from_array(vertex.normal)).collect()),
        vertices: vertices.iter().map(|vertex| DVec3::from_array(vertex.place)).collect(),
    })
}

fn read<E: PropertyAccess>(
    reader: &mut Reader<&[u8]>,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, String> {
    Parser::new().read_payload_for_element(reader, element, header).map_err(|why| why.to_string())
}

fn is_number(element: &ElementDef, name: &str) -> bool {
    element.properties.get(name).is_some_and(|property| matches!(property.data_type, PropertyType::Scalar(_)))
}

/// The numbers of a vertex; 0 where it has none.
#[derive(Debug)]
struct Vertex {
    place: [f64; 3],
    normal: [f64; 3],
}

impl Vertex {
    fn set(&mut self, name: &str, number: f64) -> PropertyAccessResult {
        let at = |names: [&str; 3]| names.iter().position(|one| *one == name);
        match (at(PLACE), at(NORMAL)) {
            (Some(axis), _) => self.place[axis] = number,
            (_, Some(axis)) => self.normal[axis] = number,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { place: [0.0; 3], normal: [0.0; 3] }
    }

    fn set_double(&mut self, name: &str, number: f64) -> PropertyAccessResult {
        self.set(name, number)
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match property {
            Property::Int(number) => self.set(name, f64::from(number)),
            Property::UInt(number) => self.set(name, f64::from(number)),
            Property::Double(number) => self.set(name, number),
            // of 24 bits at most: nothing is lost
            other => {
                other.to_f32_lossy().map_or(PropertyAccessResult::Ignored, |number| self.set(name, f64::from(number)))
            }
        }
    }
}

/// The corners of a face; `None` where they are not three.
#[derive(Debug)]
struct Face(Option<[u32; 3]>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(None)
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if name == "vertex_indices" || (name == "vertex_index" && self.0.is_none()) {
            self.0 = match &property {
                Property::ListInt(list) => three(list),
                Property::ListUInt(list) => three(list),
                Property::ListShort(list) => three(list),
                Property::ListUShort(list) => three(list),
                Property::ListChar(list) => three(list),
                Property::ListUChar(list) => three(list),
                _ => None,
            };
        }
        PropertyAccessResult::Ignored
    }
}

fn three<T: Copy + TryInto<u32>>(list: &[T]) -> Option<[u32; 3]> {
    let [a, b, c] = *list else { return None };
    Some([a.try_into().ok()?, b.try_into().ok()?, c.try_into().ok()?])
}

/// What no mesh needs.
#[derive(Debug)]
struct Aside;

impl PropertyAccess for Aside {
    fn new() -> Self {
        Self
    }
}
