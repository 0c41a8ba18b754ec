//! The files that the benchmark writes.

/// Triangles.
pub struct Mesh {
    pub vertices: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Rays of one kind: origin, direction, length.
pub struct Set {
    pub is_any_hit: bool,
    pub rays: Vec<[f32; 7]>,
}

fn four<const N: usize>(bytes: &[u8]) -> [[u8; 4]; N] {
    std::array::from_fn(|k| bytes[4 * k..4 * k + 4].try_into().expect("four bytes"))
}

/// A PLY file: vertices of floats, x, y and z first; then triangles.
pub fn mesh(path: &str) -> Mesh {
    let bytes = std::fs::read(path).expect("the mesh can be read");
    let end = b"end_header\n";
    let body = bytes.windows(end.len()).position(|part| part == end).expect("a header") + end.len();
    let header = String::from_utf8_lossy(&bytes[..body]).into_owned();
    let count = |what: &str| -> usize {
        let line = header.lines().find_map(|line| line.strip_prefix(what)).expect("an element");
        line.trim().parse().expect("a number")
    };
    let size = 4 * header.matches("property float").count();
    let (vertices, faces) = bytes[body..].split_at(size * count("element vertex"));
    Mesh {
        vertices: vertices
            .chunks_exact(size)
            .map(|one| four::<3>(one).map(f32::from_le_bytes))
            .collect(),
        triangles: faces
            .chunks_exact(13)
            .map(|one| four::<3>(&one[1..]).map(u32::from_le_bytes))
            .collect(),
    }
}

/// The sets of rays.
pub fn sets(path: &str) -> Vec<Set> {
    let bytes = std::fs::read(path).expect("the rays can be read");
    let (mut sets, mut rest) = (vec![], &bytes[..]);
    while !rest.is_empty() {
        let [is_any_hit, n] = four::<2>(rest).map(u32::from_le_bytes);
        let (body, others) = rest[8..].split_at(28 * n as usize);
        rest = others;
        sets.push(Set {
            is_any_hit: is_any_hit == 1,
            rays: body.chunks_exact(28).map(|ray| four::<7>(ray).map(f32::from_le_bytes)).collect(),
        });
    }
    sets
}
