//! Tests that the meshes in `assets/` are what their formulas give. `UPDATE_EXPECTED=1` writes them
//! again, and then fails because nothing was tested.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use cases::glam::DVec3;
use cases::{Mesh, Shape, maths, scene};

fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(name)
}

/// Returns a sphere of radius 0.5 about the origin with poles on the y axis: `n_slices` around,
/// `n_stacks` from pole to pole.
fn sphere(n_slices: u32, n_stacks: u32) -> Mesh {
    let normal = |slice: u32, stack: u32| {
        let (around, down) = (
            TAU * f64::from(slice) / f64::from(n_slices),
            0.5 * TAU * f64::from(stack) / f64::from(n_stacks),
        );
        DVec3::new(
            maths::sin(down) * maths::sin(around),
            maths::cos(down),
            maths::sin(down) * maths::cos(around),
        )
    };
    let mut normals = vec![DVec3::Y, DVec3::NEG_Y];
    normals.extend(
        (1..n_stacks).flat_map(|stack| (0..n_slices).map(move |slice| normal(slice, stack))),
    );
    let at = |slice: u32, stack: u32| match stack {
        0 => 0,
        _ if stack == n_stacks => 1,
        _ => 2 + (stack - 1) * n_slices + slice % n_slices,
    };
    let mut triangles = vec![];
    for (stack, slice) in
        (0..n_stacks).flat_map(|stack| (0..n_slices).map(move |slice| (stack, slice)))
    {
        let [a, b, c, d] = [
            at(slice, stack),
            at(slice, stack + 1),
            at(slice + 1, stack + 1),
            at(slice + 1, stack),
        ];
        triangles.extend(
            [[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a),
        );
    }
    Mesh {
        vertices: normals.iter().map(|normal| normal * 0.5).collect(),
        triangles,
        normals: Some(normals),
    }
}

/// Returns a tube of radius 0.15 about a circle of radius 0.35 in the plane z = 0.
fn torus(n_around: u32, n_across: u32) -> Mesh {
    let (mut vertices, mut normals, mut triangles) = (vec![], vec![], vec![]);
    for (i, j) in (0..n_around).flat_map(|i| (0..n_across).map(move |j| (i, j))) {
        let (u, v) =
            (TAU * f64::from(i) / f64::from(n_around), TAU * f64::from(j) / f64::from(n_across));
        let outwards = DVec3::new(maths::cos(u), maths::sin(u), 0.0);
        let normal = outwards * maths::cos(v) + DVec3::Z * maths::sin(v);
        vertices.push(outwards * 0.35 + normal * 0.15);
        normals.push(normal);
        let at = |i: u32, j: u32| (i % n_around) * n_across + j % n_across;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    Mesh { vertices, triangles, normals: Some(normals) }
}

/// Returns the twenty triangles of the icosahedron whose corners lie at distance 0.5 from the
/// origin. It has no normals, and is flat.
fn icosahedron() -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let corner = |k: usize, a: f64, b: f64| {
        let mut v = [0.0; 3];
        (v[(k + 1) % 3], v[(k + 2) % 3]) = (a, b * golden);
        DVec3::from_array(v).normalize() * 0.5
    };
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let vertices: Vec<DVec3> = (0..3).flat_map(|k| signs.map(|(a, b)| corner(k, a, b))).collect();
    let edge =
        vertices.iter().skip(1).map(|v| v.distance(vertices[0])).fold(f64::INFINITY, f64::min);
    let near = |a: usize, b: usize| vertices[a].distance(vertices[b]) < 1.1 * edge;
    let mut triangles = vec![];
    for (a, b, c) in
        (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| (a, b, c))))
    {
        if near(a, b) && near(b, c) && near(c, a) {
            let normal = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
            triangles.push(
                if normal.dot(vertices[a]) > 0.0 { [a, b, c] } else { [a, c, b] }.map(|i| i as u32),
            );
        }
    }
    Mesh { vertices, triangles, normals: None }
}

fn obj(mesh: &Mesh, about: &str) -> String {
    let mut text = format!("# {about}\n");
    for v in &mesh.vertices {
        let _ = writeln!(text, "v {:.9} {:.9} {:.9}", v.x, v.y, v.z);
    }
    for n in mesh.normals.iter().flatten() {
        let _ = writeln!(text, "vn {:.9} {:.9} {:.9}", n.x, n.y, n.z);
    }
    for [a, b, c] in mesh.triangles.iter().map(|triangle| triangle.map(|i| i + 1)) {
        let _ = match mesh.normals {
            Some(_) => writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    text
}

fn ply(mesh: &Mesh, about: &str) -> String {
    let properties =
        ["x", "y", "z", "nx", "ny", "nz"].map(|name| format!("property double {name}\n")).concat();
    let (n_vertices, n_triangles) = (mesh.vertices.len(), mesh.triangles.len());
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment {about}\nelement vertex {n_vertices}\n{properties}"
    );
    let _ = write!(
        text,
        "element face {n_triangles}\nproperty list uchar int vertex_indices\nend_header\n"
    );
    for (v, n) in mesh.vertices.iter().zip(mesh.normals.iter().flatten()) {
        let _ = writeln!(text, "{:.9} {:.9} {:.9} {:.9} {:.9} {:.9}", v.x, v.y, v.z, n.x, n.y, n.z);
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

#[test]
fn meshes_are_what_their_formulas_give() {
    let is_update = std::env::var_os("UPDATE_EXPECTED").is_some();
    let table = [
        (
            "sphere.obj",
            sphere(24, 12),
            obj as fn(&Mesh, &str) -> String,
            "sphere of radius 0.5, smooth",
            528,
        ),
        (
            "torus.ply",
            torus(24, 12),
            ply,
            "torus of radii 0.35 and 0.15 about the z axis, smooth",
            576,
        ),
        ("icosahedron.obj", icosahedron(), obj, "icosahedron in a sphere of radius 0.5, flat", 20),
    ];
    for (name, mesh, write, about, n_triangles) in table {
        let text = write(&mesh, about);
        if is_update {
            std::fs::write(asset(name), &text).unwrap();
        }
        assert_eq!(std::fs::read_to_string(asset(name)).unwrap(), text, "{name}");
        let read = load(name);
        assert_eq!(
            (read.triangles.len(), read.normals.is_some()),
            (n_triangles, mesh.normals.is_some()),
            "{name}"
        );
        check_closed_and_outward(name, &read);
    }
    assert!(!is_update, "written; look at them, then run without UPDATE_EXPECTED");
}

/// Returns the mesh as a scene gets it.
fn load(name: &str) -> Mesh {
    let text = format!(
        "render = {{ size = [1, 1] }}\n[scene]\n\
            camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }}\n\
         materials = {{ m = {{}} }}\nobjects = [{{ mesh = {{ file = \"{name}\" }}, material \
         = \"m\" }}]\n"
    );
    let mut scene = scene::parse(name, &text, asset("").as_path(), &cases::Course::default())
        .unwrap_or_else(|problems| panic!("{problems}"));
    assert!(matches!(scene.objects[0].shape, Shape::Mesh { mesh: 0 }));
    scene.meshes.remove(0)
}

/// Checks that every edge is shared by two triangles that run along it in opposite directions, and
/// that vertex normals agree with the faces.
fn check_closed_and_outward(name: &str, mesh: &Mesh) {
    let mut edges = std::collections::HashMap::new();
    let corners = |[a, b, c]: [u32; 3]| [a, b, c].map(|i| mesh.vertices[i as usize]);
    let mut volume = 0.0;
    for triangle in &mesh.triangles {
        let [a, b, c] = corners(*triangle);
        let normal = (b - a).cross(c - a);
        assert!(normal.length() > 1e-6, "{name}: {triangle:?} has no area");
        volume += a.dot(b.cross(c)) / 6.0;
        for i in 0..3 {
            let (from, to) = (triangle[i], triangle[(i + 1) % 3]);
            *edges.entry((from.min(to), from.max(to))).or_insert(0) +=
                if from < to { 1 } else { -1 };
            let vertex_normal =
                mesh.normals.as_ref().map_or(normal, |normals| normals[triangle[i] as usize]);
            assert!(
                vertex_normal.dot(normal) > 0.0,
                "{name}: a normal of {triangle:?} points inwards"
            );
        }
    }
    assert!(volume > 0.1, "{name}: {volume}");
    assert!(edges.values().all(|sum| *sum == 0), "{name} has a hole");
    for normal in mesh.normals.iter().flatten() {
        assert!((normal.length() - 1.0).abs() < 1e-15, "{name}");
    }
}
