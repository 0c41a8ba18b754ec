//! PLY files of every encoding give the same mesh, and what is no mesh is refused with a reason.

use cases::glam::DVec3;
use cases::{Mesh, scene};

const HEAD: &str = "render = { size = [1, 1] }\n[scene]\nmaterials = { m = {} }\n\
    camera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }\n\
    objects = [{ mesh = { file = \"mesh.ply\" }, material = \"m\" }]\n";

/// The mesh that a scene gets from a file of these bytes.
fn load(bytes: &[u8]) -> Result<Mesh, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mesh.ply"), bytes).unwrap();
    scene::parse("test", HEAD, folder.path(), &cases::Course::default())
        .map(|mut scene| scene.meshes.remove(0))
        .map_err(|why| why.to_string())
}

/// Four corners with normals, and what no mesh needs: a colour, an element of other things in between, another list.
fn header(encoding: &str, number: &str, index: &str) -> String {
    let numbers = ["x", "y", "red", "z", "nx", "ny", "nz"].map(|name| format!("property {number} {name}\n")).concat();
    format!(
        "ply\nformat {encoding} 1.0\nelement vertex 4\n{numbers}element edge 1\nproperty list uchar short ends\n\
         element face 2\nproperty uchar flag\nproperty list uchar {index} vertex_indices\nend_header\n"
    )
}

const VERTICES: [[f32; 7]; 4] = [
    [0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 1.0],
    [1.5, 0.0, 9.0, 0.0, 0.0, 3.0, 4.0],
    [0.0, 1.0, 9.0, 0.25, 0.0, 0.0, 1.0],
    [1.0, 1.0, 9.0, -2.0, -1.0, 0.0, 0.0],
];
const FACES: [[u8; 3]; 2] = [[0, 1, 2], [1, 3, 2]];

fn text() -> Vec<u8> {
    let lines = VERTICES.map(|vertex| vertex.map(|number| format!("{number} ")).concat() + "\n").concat();
    let faces = FACES.map(|[a, b, c]| format!("7 3 {a} {b} {c}\n")).concat();
    format!("{}{lines}2 0 1\n{faces}", header("ascii", "float", "int")).into_bytes()
}

/// With the bytes of numbers, of shorts and of indices by these functions.
fn binary<const N: usize, const I: usize>(
    header: &str,
    number: fn(f32) -> [u8; N],
    short: fn(u16) -> [u8; 2],
    index: fn(u8) -> [u8; I],
) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.extend(VERTICES.into_iter().flatten().flat_map(number));
    bytes.push(2);
    bytes.extend([0, 1].into_iter().flat_map(short));
    for face in FACES {
        bytes.extend([7, 3]);
        bytes.extend(face.into_iter().flat_map(index));
    }
    bytes
}

#[test]
fn every_encoding_gives_the_same_mesh() {
    let mesh = load(&text()).unwrap();
    assert_eq!(mesh.vertices[1..3], [DVec3::new(1.5, 0.0, 0.0), DVec3::new(0.0, 1.0, 0.25)]);
    assert_eq!(mesh.triangles, FACES.map(|face| face.map(u32::from)));
    assert_eq!(mesh.normals.as_ref().unwrap()[3], DVec3::NEG_X);
    let little = |number: &str, index: &str| header("binary_little_endian", number, index);
    let (short, int) = (u16::to_le_bytes, |i: u8| i32::from(i).to_le_bytes());
    for (what, bytes) in [
        ("floats", binary(&little("float", "int"), f32::to_le_bytes, short, int)),
        ("doubles", binary(&little("double", "uint"), |x| f64::from(x).to_le_bytes(), short, int)),
        (
            "short indices",
            binary(&little("float32", "ushort"), f32::to_le_bytes, short, |i| u16::from(i).to_le_bytes()),
        ),
        ("bytes as indices", binary(&little("float", "uchar"), f32::to_le_bytes, short, |i| [i])),
        (
            "big end first",
            binary(&header("binary_big_endian", "float", "int"), f32::to_be_bytes, u16::to_be_bytes, |i| {
                i32::from(i).to_be_bytes()
            }),
        ),
    ] {
        assert_eq!(load(&bytes), Ok(mesh.clone()), "{what}");
    }
}

#[test]
fn no_digit_of_a_whole_number_is_lost() {
    for (kind, number) in [("int", -16_777_217.0), ("uint", 4_294_967_295.0), ("short", -32_768.0), ("double", 0.1)] {
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty {kind} x\nproperty int y\nproperty int z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n{number} 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        );
        assert_eq!(load(text.as_bytes()).unwrap().vertices[0].x, number, "{kind}");
    }
}

#[test]
fn what_is_no_mesh_is_refused() {
    let text = String::from_utf8(text()).unwrap();
    for (old, new, says) in [
        ("float z", "float depth", "without x, y, z"),
        ("float ny", "float across", "some of nx, ny, nz, but not all"),
        ("3 1 3 2", "4 1 3 2 0", "not triangles"),
        ("3 1 3 2", "3 1 -3 2", "not triangles"),
        ("vertex_indices", "corners", "not triangles"),
        ("list uchar int vertex_indices", "list uchar float vertex_indices", "not triangles"),
        ("3 1 3 2", "3 1 4 2", "a corner that is none of its 4 vertices"),
        ("element face 2", "element face 3", "end of file"),
        ("element face 2", "element face 99999999999", "more than it has bytes"),
        ("element edge 1\nproperty list uchar short ends\n", "element nothing 99999999999\n", "more than it has bytes"),
        ("element face 2", "element face 0", "no triangles"),
        ("9 -2 -1", "9 1e30 -1", "is not three numbers"),
        ("-1 0 0 \n", "0 0 0 \n", "has no direction"),
        ("ply\n", "plot\n", "the mesh `mesh.ply` cannot be used"),
    ] {
        assert!(text.contains(old), "{old}");
        let why = load(text.replacen(old, new, 1).as_bytes()).expect_err(new);
        assert!(why.contains(says), "{new}: {why}");
    }
}
