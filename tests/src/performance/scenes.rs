//! The scenes that all renderers render: case files, and the meshes that they name.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use cases::Mesh;
use cases::files;
use cases::glam::{DVec2, DVec3};

use super::{ply, stone};
use crate::dice::Dice;

/// The width and height of every picture: 307,200 eye rays.
pub const SIZE: (u32, u32) = (640, 480);

/// The number of divisions of the stone for each size of mesh, and the name of that size: 1,280 to
/// 1,310,720 triangles.
pub const STONES: [(u32, &str); 6] =
    [(3, "1k"), (4, "5k"), (5, "20k"), (6, "82k"), (7, "328k"), (8, "1m")];

/// The smaller stone in the compared pictures: 81,920 triangles.
pub const STONE: (u32, &str) = STONES[3];

/// The height of every floor, on which the stone lies.
const FLOOR: f64 = -1.1;

/// The number of squares along a side of the checkered floor.
const N_SQUARES: u32 = 16;

/// The number of transformed spheres in `spheres.toml`.
const N_SPHERES: usize = 1000;

/// Writes every scene and mesh into `folder`, which is created if it is missing. The bytes are the
/// same on every machine.
///
/// # Errors
/// Returns the error of a file that cannot be written, with its path.
pub fn write(folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|why| format!("{}: {why}", folder.display()))?;
    let put = |name: String, bytes: &[u8]| {
        let path = folder.join(name);
        files::write(&path, bytes).map_err(|why| why.to_string())
    };
    put("floor.ply".to_owned(), &ply::encode(&squares(1, |_| true)))?;
    put("white.ply".to_owned(), &ply::encode(&squares(N_SQUARES, |n| n % 2 == 0)))?;
    put("black.ply".to_owned(), &ply::encode(&squares(N_SQUARES, |n| n % 2 == 1)))?;
    put("whitted.toml".to_owned(), whitted().as_bytes())?;
    put("spheres.toml".to_owned(), spheres().as_bytes())?;
    put("glass.toml".to_owned(), glass().as_bytes())?;
    for (n_divisions, name) in STONES {
        put(format!("mesh_{name}.ply"), &ply::encode(&stone::stone(n_divisions)))?;
        put(format!("mesh_{name}.toml"), mesh(name).as_bytes())?;
    }
    Ok(())
}

/// Returns squares of an `n` × `n` floor of side 12, each as two flat triangles. A square is
/// included if the sum of its row and column is `wanted`.
fn squares(n: u32, wanted: impl Fn(u32) -> bool) -> Mesh {
    let mut mesh = Mesh { vertices: vec![], triangles: vec![], normals: None };
    let side = 12.0 / f64::from(n);
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).filter(|(i, j)| wanted(i + j)) {
        let least = DVec2::new(f64::from(i), f64::from(j)) * side - 6.0;
        let first = mesh.vertices.len() as u32;
        let corner = |x: f64, z: f64| DVec3::new(least.x + x * side, FLOOR, least.y + z * side);
        mesh.vertices.extend([
            corner(0.0, 0.0),
            corner(0.0, 1.0),
            corner(1.0, 1.0),
            corner(1.0, 0.0),
        ]);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    mesh
}

/// Returns the beginning of a scene file.
fn head(max_depth: u32, eye: [f64; 3], look_at: [f64; 3]) -> String {
    let (width, height) = SIZE;
    format!(
        "[render]\nsize = [{width}, {height}]\nmax_depth = {max_depth}\n\n[scene]\n\
            background = [0.1, 0.2, 0.35]\n\n\
         [scene.camera]\neye = {eye:?}\nlook_at = {look_at:?}\nup = [0, 1, 0]\nfov_y_deg = 40\n\n"
    )
}

const LAMP: &str = "[[scene.lights]]\npoint = { position = [4, 5, 5], colour = [0.9, 0.9, 0.9], \
    ambient = [0.1, 0.1, 0.1] }\n\n";

/// Returns the scene of three spheres over a checkered floor. One is a mirror and one is of glass;
/// there is one light, and the depth is 5.
fn whitted() -> String {
    head(5, [0.0, 0.5, 5.0], [0.0, -0.5, 0.0])
        + LAMP
        + "\
[scene.materials]
white = { kd = [0.9, 0.9, 0.9] }
black = { kd = [0.1, 0.1, 0.1] }
red = { kd = [0.7, 0.2, 0.1], ks = [0.3, 0.3, 0.3], kr = [0, 0, 0], ns = 40 }
mirror = { kd = [0.05, 0.05, 0.05], ks = [0.8, 0.8, 0.8], ns = 100 }
glass = { kd = [0.02, 0.02, 0.02], ks = [0.1, 0.1, 0.1], ns = 100, kt = [0.85, 0.85, 0.85], index \
= 1.5 }

[[scene.objects]]
mesh = { file = \"white.ply\" }
material = \"white\"

[[scene.objects]]
mesh = { file = \"black.ply\" }
material = \"black\"

[[scene.objects]]
sphere = { center = [-1.3, -0.3, -0.8], radius = 0.8 }
material = \"mirror\"

[[scene.objects]]
sphere = { center = [0.4, -0.4, 0.9], radius = 0.7 }
material = \"glass\"

[[scene.objects]]
sphere = { center = [1.5, -0.5, -0.9], radius = 0.6 }
material = \"red\"
"
}

/// Returns the scene of a thousand spheres, each stretched, turned and moved. It has a point and a
/// directional light, and no mirrors.
fn spheres() -> String {
    let mut text = head(0, [0.0, 0.9, 7.0], [0.0, 0.4, 0.0])
        + LAMP
        + "[[scene.lights]]\ndirectional = { direction = [1, -2, -1], colour = [0.4, 0.4, 0.4] \
            }\n\n[scene.materials]\n\
           floor = { kd = [0.6, 0.6, 0.6] }\n";
    for (name, kd) in
        [("red", [0.8, 0.2, 0.2]), ("green", [0.2, 0.7, 0.3]), ("blue", [0.2, 0.3, 0.8])]
    {
        let _ = writeln!(text, "{name} = {{ kd = {kd:?} }}");
    }
    text += "\n[[scene.objects]]\nmesh = { file = \"floor.ply\" }\nmaterial = \"floor\"\n";
    let mut dice = Dice::new(5);
    let mut tamely = |least: f64, most: f64| (dice.between(least, most) * 1e4).round() / 1e4;
    for n in 0..N_SPHERES {
        let scale = [(); 3].map(|()| tamely(0.15, 0.45));
        let axis = [tamely(-1.0, 1.0), tamely(-1.0, 1.0), tamely(0.1, 1.0)];
        let degrees = tamely(0.0, 360.0);
        let place = [tamely(-3.2, 3.2), tamely(-0.8, 2.5), tamely(-3.2, 1.6)];
        let _ = write!(
            text,
            "\n[[scene.objects]]\nsphere = {{}}\nmaterial = \"{}\"\n\
                transforms = [{{ scale = {scale:?} }}, {{ rotate = {{ axis = {axis:?}, angle_deg \
                = {degrees} }} }}, {{ translate = {place:?} }}]\n",
            ["red", "green", "blue"][n % 3],
        );
    }
    text
}

/// Returns the scene of the stone over the floor.
fn stone_of(name: &str, max_depth: u32, material: &str) -> String {
    head(max_depth, [0.0, 0.4, 4.0], [0.0, -0.1, 0.0])
        + LAMP
        + &format!(
            "[scene.materials]\nfloor = {{ kd = [0.6, 0.6, 0.6] }}\nstone = {material}\n\n\
             [[scene.objects]]\nmesh = {{ file = \"floor.ply\" }}\nmaterial = \"floor\"\n\n\
             [[scene.objects]]\nmesh = {{ file = \"mesh_{name}.ply\" }}\nmaterial = \"stone\"\n"
        )
}

/// Returns the scene of a dull stone, with only eye rays and shadow rays.
fn mesh(name: &str) -> String {
    stone_of(name, 0, "{ kd = [0.7, 0.5, 0.4] }")
}

/// Returns the scene of a stone of glass with depth 8.
fn glass() -> String {
    let glass = "{ kd = [0.02, 0.02, 0.02], ks = [0.1, 0.1, 0.1], ns = 100, kt = [0.85, 0.85, \
        0.85], index = 1.5 }";
    stone_of(STONE.1, 8, glass)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn every_scene_can_be_read_and_is_what_its_name_says() {
        let folder = tempfile::tempdir().expect("a folder");
        write(folder.path()).expect("it is written");
        let read = |name: &str| {
            cases::stage::load_scene(&folder.path().join(name), &cases::Course::default())
                .expect("it is valid")
        };
        let whitted = read("whitted.toml");
        assert_eq!(
            (whitted.objects.len(), whitted.lights.len(), whitted.render.max_depth),
            (5, 1, 5)
        );
        assert_eq!(whitted.meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>(), 512);
        let spheres = read("spheres.toml");
        let moved = spheres.objects.iter().filter(|object| !object.is_untransformed());
        assert_eq!((moved.count(), spheres.lights.len()), (1000, 2));
        for (n_divisions, name) in STONES {
            let scene = read(&format!("mesh_{name}.toml"));
            let n_triangles: BTreeMap<usize, bool> = scene
                .meshes
                .iter()
                .map(|mesh| (mesh.triangles.len(), mesh.normals.is_some()))
                .collect();
            assert_eq!(
                n_triangles,
                BTreeMap::from([(2, false), (stone::n_triangles(n_divisions), true)])
            );
        }
        assert_eq!(read("glass.toml").render.max_depth, 8);
    }
}
