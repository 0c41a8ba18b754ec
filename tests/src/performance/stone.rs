//! A stone of many triangles: an evenly divided sphere with waves on its surface.

use cases::Mesh;
use cases::glam::DVec3;
use cases::maths::sin;

/// Returns the number of triangles of the stone after `n_divisions`.
pub fn n_triangles(n_divisions: u32) -> usize {
    20 << (2 * n_divisions)
}

/// Returns a stone with [`n_triangles`] triangles, a radius from 0.88 to 1.12, and a unit normal
/// per vertex. The corners of each triangle are anticlockwise from outside.
pub fn stone(n_divisions: u32) -> Mesh {
    let (mut directions, mut triangles) = icosahedron();
    for _ in 0..n_divisions {
        triangles = divided(&mut directions, &triangles);
    }
    let vertices: Vec<DVec3> = directions.into_iter().map(|d| d * radius(d)).collect();
    let normals = normals(&vertices, &triangles);
    Mesh { vertices, triangles, normals: Some(normals) }
}

/// Returns the distance of the surface from the centre in the direction `d`.
fn radius(d: DVec3) -> f64 {
    let wave = |n: f64, phase: f64| {
        sin(n * d.x + phase) * sin(n * d.y + 2.0 * phase) * sin(n * d.z + 3.0 * phase)
    };
    1.0 + 0.1 * wave(5.0, 1.0) + 0.02 * wave(23.0, 2.0)
}

/// Returns the corners, on the unit sphere, and the faces.
fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let rectangle = [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)];
    let corners = rectangle
        .map(|(a, b)| DVec3::new(a, b, 0.0))
        .into_iter()
        .chain(rectangle.map(|(a, b)| DVec3::new(0.0, a, b)))
        .chain(rectangle.map(|(a, b)| DVec3::new(b, 0.0, a)))
        .map(DVec3::normalize)
        .collect();
    let faces = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (corners, faces)
}

/// Divides each triangle into four. The middles of the edges, moved out to the unit sphere, are
/// appended to `directions`.
fn divided(directions: &mut Vec<DVec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let sides =
        |[a, b, c]: [u32; 3]| [(a.min(b), a.max(b)), (b.min(c), b.max(c)), (c.min(a), c.max(a))];
    let mut edges: Vec<(u32, u32)> = triangles.iter().flat_map(|t| sides(*t)).collect();
    edges.sort_unstable();
    edges.dedup();
    let first = directions.len();
    for (a, b) in &edges {
        directions.push((directions[*a as usize] + directions[*b as usize]).normalize());
    }
    let middle = |edge: (u32, u32)| (first + edges.partition_point(|other| *other < edge)) as u32;
    let four = |t: &[u32; 3]| {
        let ([a, b, c], [ab, bc, ca]) = (*t, sides(*t).map(middle));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    triangles.iter().flat_map(four).collect()
}

/// Returns a unit normal for each vertex, from the triangles around it weighted by their areas.
fn normals(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; vertices.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|i| vertices[i as usize]);
        let twice_area = (b - a).cross(c - a);
        corners.iter().for_each(|i| sums[*i as usize] += twice_area);
    }
    sums.into_iter().map(DVec3::normalize).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stone_is_closed_and_faces_outwards() {
        let mesh = stone(3);
        let n = n_triangles(3);
        assert_eq!((mesh.triangles.len(), n), (1280, 1280));
        assert_eq!(mesh.vertices.len(), n / 2 + 2, "Euler: V − E + F = 2, where E = 3 F / 2");
        let mut edges: Vec<(u32, u32)> =
            mesh.triangles.iter().flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)]).collect();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(edges.len(), 3 * n, "each edge is walked once each way");
        assert!(edges.iter().all(|(a, b)| edges.binary_search(&(*b, *a)).is_ok()));
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|i| mesh.vertices[i as usize]);
            assert!((b - a).cross(c - a).dot(a) > 0.0);
        }
        let normals = mesh.normals.expect("it is smooth");
        assert!(
            mesh.vertices
                .iter()
                .zip(&normals)
                .all(|(v, n)| v.dot(*n) > 0.0 && (n.length() - 1.0).abs() < 1e-12)
        );
        assert!(mesh.vertices.iter().all(|v| (0.88..=1.12).contains(&v.length())));
    }
}
