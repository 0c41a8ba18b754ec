//! Encodes triangles as a binary PLY file in single precision, which every renderer here can read.

use cases::Mesh;

/// Returns the bytes of the file. A vertex has x, y, z, and also nx, ny, nz if the mesh has
/// normals, each as a float. A face has three corners.
pub fn encode(mesh: &Mesh) -> Vec<u8> {
    let normals = mesh.normals.as_deref();
    let mut out = header(mesh).into_bytes();
    for (i, vertex) in mesh.vertices.iter().enumerate() {
        let numbers = vertex
            .to_array()
            .into_iter()
            .chain(normals.into_iter().flat_map(|all| all[i].to_array()));
        numbers.for_each(|x| out.extend((x as f32).to_le_bytes()));
    }
    for corners in &mesh.triangles {
        out.push(3);
        corners.iter().for_each(|i| out.extend((*i as i32).to_le_bytes()));
    }
    out
}

fn header(mesh: &Mesh) -> String {
    let of_normals = if mesh.normals.is_some() {
        "property float nx\nproperty float ny\nproperty float nz\n"
    } else {
        ""
    };
    format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n\
            property float y\nproperty float z\n{of_normals}\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.triangles.len(),
    )
}
