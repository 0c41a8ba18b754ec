//! Tests that a mesh file takes memory in proportion to its bytes, whatever it promises or repeats.
#![cfg(target_os = "linux")]

use std::path::Path;

use cases::{Mesh, scene};

/// Returns the most bytes that this process has held at once so far, as the system counts them.
fn peak() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().strip_suffix(" kB").unwrap().trim().parse::<usize>().unwrap() * 1024
}

fn read(folder: &Path, name: &str, bytes: &[u8]) -> Option<Mesh> {
    std::fs::write(folder.join(name), bytes).unwrap();
    let text = format!(
        "render = {{ size = [1, 1] }}\n[scene]\nmaterials = {{ m = {{}} }}\n\
         camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }}\n\
         objects = [{{ mesh = {{ file = \"{name}\" }}, material = \"m\" }}]\n"
    );
    scene::parse("test", &text, folder, &cases::Course::default())
        .ok()
        .map(|mut scene| scene.meshes.remove(0))
}

const BYTES: usize = 1 << 20;

/// Returns about `BYTES` bytes of a file: a head, and one part again and again.
fn repeated(head: &str, part: &str) -> Vec<u8> {
    let mut bytes = head.as_bytes().to_vec();
    while bytes.len() < BYTES {
        bytes.extend(part.as_bytes());
    }
    bytes
}

fn ply(encoding: &str, n_vertices: usize, kind: &str, n_faces: usize) -> String {
    format!(
        "ply\nformat {encoding} 1.0\nelement vertex {n_vertices}\nproperty {kind} x\n\
            property {kind} y\nproperty {kind} z\n\
         element face {n_faces}\nproperty list uchar uchar vertex_index\nend_header\n"
    )
}

/// Returns a comb: a polygon of as many corners as fit, half of which point inwards.
fn comb() -> Vec<u8> {
    let n = BYTES / 20;
    let tooth = |i: usize| format!("v {i} {} 0\n", if i.is_multiple_of(2) { 5 } else { 1 });
    let vertices: String = (1..n).map(tooth).collect();
    let corners: String = (1..=n + 1).map(|i| format!(" {i}")).collect();
    format!("{vertices}v {n} 0 0\nv 0 0 0\nf{corners}\n").into_bytes()
}

#[test]
fn memory_is_in_proportion_to_the_file() {
    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    let vertices = BYTES / 3;
    let files: [(&str, Vec<u8>, bool); 19] = [
        ("triangles.obj", repeated(TRIANGLE, "f 1 2 3\n"), true),
        ("normals.obj", repeated(TRIANGLE, "vn 0 0 1\nf 1//-1 2//-1 3//-1\n"), true),
        ("quads.obj", repeated("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", "f 1 2 3 4\n"), true),
        ("vertices.obj", repeated("", "v 0 0 0\n"), false),
        ("points.obj", repeated("", "p 1\n"), false),
        ("comments.obj", repeated("", "#\n"), false),
        ("ends.obj", repeated("", "\r"), false),
        ("continued.obj", repeated("v", " \\\n"), false),
        ("word.obj", repeated("v ", "9"), false),
        ("corners.obj", repeated("v 0 0 0\nv 1 0 0\nf", " 1 2"), false),
        ("comb.obj", comb(), true),
        ("comment.ply", repeated("ply\ncomment", " a"), false),
        (
            "properties.ply",
            repeated("ply\nformat ascii 1.0\nelement a 1\n", "property char a\n"),
            false,
        ),
        ("elements.ply", repeated("ply\nformat ascii 1.0\n", "element a 1\n"), false),
        (
            "bytes.ply",
            repeated(&ply("binary_little_endian", vertices - 200, "uchar", 1), "\x03"),
            false,
        ),
        (
            "faces.ply",
            repeated(&ply("binary_big_endian", 4, "char", BYTES / 4 - 200), "\x03\x01\x02\x03"),
            false,
        ),
        (
            "promises.ply",
            repeated(&ply("binary_big_endian", 4, "char", 1 << 60), "\x03\x01\x02\x03"),
            false,
        ),
        ("lists.ply", repeated(&ply("ascii", 0, "char", BYTES), "0 "), false),
        ("words.ply", repeated(&ply("ascii", BYTES / 6, "uchar", 1), "0 "), false),
    ];
    let folder = tempfile::tempdir().unwrap();
    read(folder.path(), "first.obj", TRIANGLE.as_bytes());
    for (name, bytes, is_mesh) in files {
        assert_eq!(read(folder.path(), name, &bytes).is_some(), is_mesh, "{name}");
    }
    let most = 100 * BYTES;
    assert!(peak() < most, "{} bytes at once", peak());
    // The measure must count memory that is held.
    let held = vec![1_u8; most];
    assert!(peak() > held.len());
}
