//! Tests that mesh files of every kind give their mesh, and that other files are refused with a
//! reason and a place.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use cases::glam::DVec3;
use cases::problem::Problems;
use cases::{Mesh, scene};

/// Returns the folder of the mesh files of these tests.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes")
}

/// Returns the mesh that a scene gets from a file. The file's name decides how it is read:
/// `NAME.flat.obj` with `smooth = false`, `NAME.smooth.obj` with `smooth = true`, any other name
/// without the key.
fn read(path: &Path) -> Result<Mesh, Problems> {
    let name = path.file_name().unwrap().to_str().unwrap();
    let smooth = [(".flat.", ", smooth = false"), (".smooth.", ", smooth = true")];
    let smooth = smooth.iter().find(|(part, _)| name.contains(part)).map_or("", |(_, key)| key);
    let text = format!(
        "render = {{ size = [1, 1] }}\n[scene]\nmaterials = {{ m = {{}} }}\n\
         camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }}\n\
         objects = [{{ mesh = {{ file = \"{name}\"{smooth} }}, material = \"m\" }}]\n"
    );
    scene::parse("test", &text, path.parent().unwrap(), &cases::Course::default())
        .map(|mut scene| scene.meshes.remove(0))
}

/// Returns the mesh of a PLY file of these bytes.
fn load(bytes: &[u8]) -> Result<Mesh, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.ply");
    std::fs::write(&path, bytes).unwrap();
    read(&path).map_err(|why| why.to_string())
}

/// Returns the mesh of a file as text, or its problem and the way to fix it.
fn report(path: &Path) -> String {
    let mut text = String::new();
    match read(path) {
        Ok(mesh) => {
            let vectors = |text: &mut String, letters: &str, list: &[DVec3]| {
                list.iter()
                    .for_each(|v| writeln!(text, "  {letters} {} {} {}", v.x, v.y, v.z).unwrap());
            };
            vectors(&mut text, "v", &mesh.vertices);
            vectors(&mut text, "n", mesh.normals.as_deref().unwrap_or_default());
            mesh.triangles.iter().for_each(|[a, b, c]| writeln!(text, "  t {a} {b} {c}").unwrap());
        }
        Err(problems) => {
            for problem in problems.iter() {
                let label =
                    problem.label.replace(&format!("{}/", path.parent().unwrap().display()), "");
                writeln!(text, "  {label}\n  = {}", problem.help.as_deref().unwrap_or_default())
                    .unwrap();
            }
        }
    }
    text
}

/// Returns the files of a folder, in order of their names.
fn files(name: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder().join(name)).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(files.len() > 10, "{name} has only {} files", files.len());
    files
}

/// Compares the reports about the files of a folder with the text beside it. With
/// `UPDATE_EXPECTED=1` in the environment the text is written again, and the test fails, so that
/// somebody reads it.
fn check(name: &str) {
    let name_of = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let found: String =
        files(name).iter().map(|path| format!("{}\n{}", name_of(path), report(path))).collect();
    let beside = folder().join(format!("{name}.expected"));
    if std::env::var_os("UPDATE_EXPECTED").is_some() {
        std::fs::write(&beside, &found).unwrap();
        panic!("{name}: written; read it, then run without UPDATE_EXPECTED");
    }
    let expected = std::fs::read_to_string(&beside).unwrap();
    let differs = expected.lines().zip(found.lines()).find(|(expected, found)| expected != found);
    assert!(expected == found, "{}: {differs:?}", beside.display());
}

#[test]
fn every_way_to_write_a_mesh_gives_the_same_mesh() {
    let vertices = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.25], [3.0, 2.0, 0.25], [0.0, 2.0, 0.0]];
    let vertices = vertices.map(DVec3::from_array).to_vec();
    let mesh = Mesh { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], normals: None };
    for path in files("same") {
        match read(&path) {
            Ok(found) => assert_eq!(found, mesh, "{}", path.display()),
            Err(problems) => panic!("{}: {problems}", path.display()),
        }
    }
}

#[test]
fn files_give_the_meshes_beside_them() {
    check("read");
    assert!(files("read").iter().all(|path| read(path).is_ok()));
}

#[test]
fn files_without_a_mesh_are_refused_with_the_words_beside_them() {
    check("refused");
    assert!(files("refused").iter().all(|path| read(path).is_err()));
}

#[test]
fn messages_are_short() {
    for path in files("refused") {
        let problems = read(&path).expect_err("refused");
        let problem = problems.iter().next().unwrap();
        let label = problem.label.replace(&format!("{}/", path.parent().unwrap().display()), "");
        let help = problem.help.as_deref().unwrap_or_default();
        assert!(
            label.chars().count() < 220 && help.chars().count() < 220,
            "{}: {label}",
            path.display()
        );
        assert!(!help.is_empty() && !label.contains(char::is_control), "{}", path.display());
    }
}

/// Returns a header of four corners with normals, and of parts that no mesh needs: a colour, an
/// element between the others, another list.
fn header(encoding: &str, number: &str, index: &str) -> String {
    let numbers = ["x", "y", "red", "z", "nx", "ny", "nz"]
        .map(|name| format!("property {number} {name}\n"))
        .concat();
    format!(
        "ply\nformat {encoding} 1.0\nelement vertex 4\n{numbers}element edge 1\n\
            property list uchar short ends\n\
         element face 2\nproperty uchar flag\nproperty list uchar {index} vertex_indices\n\
         end_header\n"
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
    let lines =
        VERTICES.map(|vertex| vertex.map(|number| format!("{number} ")).concat() + "\n").concat();
    let faces = FACES.map(|[a, b, c]| format!("7 3 {a} {b} {c}\n")).concat();
    format!("{}{lines}2 0 1\n{faces}", header("ascii", "float", "int")).into_bytes()
}

/// Returns a binary file. These functions give the bytes of numbers, of shorts and of indices.
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
            binary(&little("float32", "ushort"), f32::to_le_bytes, short, |i| {
                u16::from(i).to_le_bytes()
            }),
        ),
        ("bytes as indices", binary(&little("float", "uchar"), f32::to_le_bytes, short, |i| [i])),
        (
            "big end first",
            binary(
                &header("binary_big_endian", "float", "int"),
                f32::to_be_bytes,
                u16::to_be_bytes,
                |i| i32::from(i).to_be_bytes(),
            ),
        ),
    ] {
        assert_eq!(load(&bytes), Ok(mesh.clone()), "{what}");
    }
}

#[test]
fn no_digit_of_a_whole_number_is_lost() {
    for (kind, number) in
        [("int", -16_777_217.0), ("uint", 4_294_967_295.0), ("short", -32_768.0), ("double", 0.1)]
    {
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty {kind} x\nproperty int y\n\
                property int z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n{number} 0 0\n\
             1 0 0\n0 1 0\n3 0 1 2\n"
        );
        assert_eq!(load(text.as_bytes()).unwrap().vertices[0].x, number, "{kind}");
    }
}
