//! Tests that mesh files with random changes are read or refused, and that nothing else happens.

use std::path::{Path, PathBuf};

use cases::problem::Problems;
use cases::{Mesh, scene};
use fastrand::Rng;

const SCRAPS: [&[u8]; 40] = [
    b"",
    b"\n",
    b"\r",
    b"\r\n",
    b" ",
    b"\\\n",
    b"\\",
    b"#",
    b"\0",
    b"\xff",
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b"/",
    b"//",
    b"0",
    b"-1",
    b"1",
    b"2",
    b"3",
    b"4",
    b"255",
    b"4294967295",
    b"99999999999999999999",
    b"nan",
    b"-inf",
    b"1e400",
    b"1e-400",
    b"0.5",
    b"1e18",
    b"\nv 0 0 1\n",
    b"\nvn 0 0 0\n",
    b"\nf 1 2 3 4\n",
    b"\nf -1 -2 -3 -4 -5\n",
    b"\nl 1 2\n",
    b"\nf 1//1 2//1 3//1\n",
    b"property float nx\n",
    b"property list uchar int a\n",
    b"element vertex 4\n",
    b"element face 1000000000000000000\n",
    b"end_header\n",
];

/// Returns `bytes` with a digit changed, or with one or two stretches replaced: by scraps, by other
/// stretches, or by random bytes.
fn mutated(bytes: &[u8], dice: &mut Rng) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    if dice.usize(..3) == 0 {
        let digits: Vec<usize> =
            (0..bytes.len()).filter(|at| bytes[*at].is_ascii_digit()).collect();
        bytes[digits[dice.usize(..digits.len())]] = b'0' + dice.usize(..10) as u8;
        return bytes;
    }
    for _ in 0..1 + dice.usize(..2) {
        let at = dice.usize(..bytes.len() + 1);
        let end = (at + dice.usize(..5)).min(bytes.len());
        let put = match dice.usize(..4) {
            0 => {
                let from = dice.usize(..bytes.len().max(1));
                bytes[from..(from + dice.usize(..60)).min(bytes.len())].to_vec()
            }
            1 => (0..dice.usize(..6)).map(|_| dice.u8(..)).collect(),
            _ => pick(dice, &SCRAPS).to_vec(),
        };
        bytes.splice(at..end, put);
    }
    bytes
}

/// Returns one of the list.
fn pick<'a, T: ?Sized>(dice: &mut Rng, list: &[&'a T]) -> &'a T {
    list[dice.usize(..list.len())]
}

/// Returns random bytes, some of which begin like a file of one of the formats.
fn arbitrary(dice: &mut Rng) -> Vec<u8> {
    let start: &[u8] = pick(
        dice,
        &[
            &b""[..],
            b"ply\nformat ascii 1.0\n",
            b"ply\nformat binary_big_endian 1.0\n",
            b"v 0 0 0\n",
        ],
    );
    let rest = (0..dice.usize(..200)).flat_map(|_| match dice.usize(..3) {
        0 => vec![dice.u8(..)],
        1 => vec![b' ', b'0' + dice.usize(..10) as u8],
        _ => pick(dice, &SCRAPS).to_vec(),
    });
    start.iter().copied().chain(rest).collect()
}

fn read(path: &Path, smooth: &str) -> Result<Mesh, Problems> {
    let name = path.file_name().unwrap().to_str().unwrap();
    let text = format!(
        "render = {{ size = [1, 1] }}\n[scene]\nmaterials = {{ m = {{}} }}\n\
         camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }}\n\
         objects = [{{ mesh = {{ file = \"{name}\"{smooth} }}, material = \"m\" }}]\n"
    );
    scene::parse("test", &text, path.parent().unwrap(), &cases::Course::default())
        .map(|mut scene| scene.meshes.remove(0))
}

/// Returns whether what holds for every scene holds for a mesh.
fn is_sound(mesh: &Mesh) -> bool {
    let n = mesh.vertices.len();
    let is_usable = |v: &cases::glam::DVec3| v.is_finite() && v.abs().max_element() <= 1e18;
    let is_unit = |v: &cases::glam::DVec3| (v.length() - 1.0).abs() < 1e-9;
    !mesh.triangles.is_empty()
        && mesh.vertices.iter().all(is_usable)
        && mesh.triangles.iter().flatten().all(|index| (*index as usize) < n)
        && mesh
            .normals
            .as_ref()
            .is_none_or(|normals| normals.len() == n && normals.iter().all(is_unit))
}

/// Reads each of `n` files that `draw` makes, in every way. The result must be a sound mesh, or a
/// problem with a message that people can read. Returns how many were read and how many were
/// refused.
fn check(end: &str, n: usize, mut draw: impl FnMut(&mut Rng) -> Vec<u8>) -> [usize; 2] {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("mesh.{end}"));
    let (mut dice, mut counts) = (Rng::with_seed(7), [0, 0]);
    for _ in 0..n {
        let bytes = draw(&mut dice);
        std::fs::write(&path, &bytes).unwrap();
        let of_file = || String::from_utf8_lossy(&bytes);
        for smooth in ["", ", smooth = false"] {
            match read(&path, smooth) {
                Ok(mesh) => {
                    counts[0] += 1;
                    assert!(is_sound(&mesh), "{mesh:?}\n{}", of_file());
                    assert!(smooth.is_empty() || mesh.normals.is_none(), "{}", of_file());
                }
                Err(problems) => {
                    counts[1] += 1;
                    let problem = problems.iter().next().unwrap();
                    let text =
                        format!("{}{}", problem.label, problem.help.as_deref().unwrap_or_default());
                    let is_readable = text.len() < 900 && !text.contains(char::is_control);
                    assert!(
                        is_readable && problem.label.contains("mesh."),
                        "{problem:?}\n{}",
                        of_file()
                    );
                }
            }
        }
    }
    counts
}

/// Returns the files of that format that can be read and are small enough to be changed often.
fn seeds(end: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    let list = |name: &str| {
        std::fs::read_dir(folder.join(name)).unwrap().map(|entry| entry.unwrap().path())
    };
    let mut paths: Vec<PathBuf> = ["same", "read"].iter().flat_map(|name| list(name)).collect();
    paths.retain(|path| path.extension().is_some_and(|of| of == end));
    paths.sort();
    paths
        .iter()
        .map(|path| std::fs::read(path).unwrap())
        .filter(|bytes| (1..4000).contains(&bytes.len()))
        .collect()
}

fn check_mutations(end: &str) {
    let seeds = seeds(end);
    assert!(seeds.len() > 30, "{end} has only {} seeds", seeds.len());
    let [n_read, n_refused] = check(end, 4000, |dice| {
        let seed = dice.usize(..seeds.len());
        mutated(&seeds[seed], dice)
    });
    assert!(
        n_read > 500 && n_refused > 500,
        "{n_read} read, {n_refused} refused: too wild, or too tame"
    );
}

#[test]
fn mutated_wavefront_files_never_panic() {
    check_mutations("obj");
}

#[test]
fn mutated_ply_files_never_panic() {
    check_mutations("ply");
}

#[test]
fn arbitrary_bytes_never_panic() {
    for end in ["obj", "ply"] {
        let [_, n_refused] = check(end, 2000, arbitrary);
        assert!(n_refused > 1000, "{n_refused} refused");
    }
}
