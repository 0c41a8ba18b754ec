//! Exports a scene for Tachyon 0.99, which is left-handed: the sign of z is flipped.

use std::fmt::Write as _;

use cases::glam::DVec3;
use cases::{Light, Material, Mesh, Scene};

use super::{File, Known};

/// Returns one file, `scene.dat`. Tachyon has no ellipsoids, which become spheres of the same
/// volume, and no refraction: rays go straight through.
///
/// # Errors
/// Returns the name of an object that is neither a sphere nor an untransformed mesh.
pub fn export(scene: &Scene) -> Result<Vec<File>, String> {
    let mut out = head(scene);
    for light in &scene.lights {
        let colour = super::numbers(light.colour(), " ");
        let _ = match light {
            Light::Point { position, .. } => {
                writeln!(out, "LIGHT CENTER {} RAD 0 COLOR {colour}", v(*position))
            }
            Light::Directional { direction, .. } => {
                writeln!(out, "DIRECTIONAL_LIGHT DIRECTION {} COLOR {colour}", v(*direction))
            }
        };
    }
    let _ = writeln!(out, "BACKGROUND {}", super::numbers(scene.background, " "));
    for (n, material) in scene.materials.iter().enumerate() {
        out += &texture(scene, n, material);
    }
    for object in &scene.objects {
        match super::known(scene, object)? {
            Known::Mesh(mesh) => triangles(&mut out, mesh, object.material),
            Known::Sphere { center, radius } => {
                let (center, radius) = super::as_sphere(object, center, radius);
                let _ =
                    writeln!(out, "SPHERE CENTER {} RAD {radius} m{}", v(center), object.material);
            }
        }
    }
    out += "END_SCENE\n";
    Ok(vec![("scene.dat".to_owned(), out.into_bytes())])
}

fn head(scene: &Scene) -> String {
    let camera = &scene.camera;
    format!(
        "BEGIN_SCENE\nRESOLUTION {} {}\nCAMERA\nZOOM {}\nASPECTRATIO 1\nANTIALIASING 0\n\
            RAYDEPTH {}\nCENTER {}\nVIEWDIR {}\nUPDIR {}\nEND_CAMERA\n",
        scene.render.width,
        scene.render.height,
        0.5 / super::half_height(scene),
        scene.render.max_depth + 1,
        v(camera.eye),
        v(camera.forward),
        v(camera.up),
    )
}

fn texture(scene: &Scene, n: usize, m: &Material) -> String {
    let brightest = m.kd.max_element().max(1e-3);
    let mut text = format!(
        "TEXDEF m{n} AMBIENT {} DIFFUSE {brightest} SPECULAR {} OPACITY {}",
        super::mean(super::ambient(scene)) * brightest,
        super::mean(m.kr),
        1.0 - super::mean(m.kt),
    );
    if m.ks != DVec3::ZERO {
        let _ = write!(text, " PHONG PLASTIC {} PHONG_SIZE {}", super::mean(m.ks), m.ns);
    }
    let _ = writeln!(text, " COLOR {} TEXFUNC 0", super::numbers(m.kd / brightest, " "));
    text
}

fn triangles(out: &mut String, mesh: &Mesh, material: usize) {
    let short = |p: DVec3| format!("{} {} {}", p.x as f32, p.y as f32, (0.0 - p.z) as f32);
    for [a, b, c] in &mesh.triangles {
        // The orientation is reversed for the left-handed frame.
        let corners = [a, c, b];
        let corner = |of: &[DVec3], k: usize| short(of[*corners[k] as usize]);
        *out += if mesh.normals.is_some() { "STRI" } else { "TRI" };
        for k in 0..3 {
            let _ = write!(out, " V{k} {}", corner(&mesh.vertices, k));
        }
        if let Some(normals) = &mesh.normals {
            for k in 0..3 {
                let _ = write!(out, " N{k} {}", corner(normals, k));
            }
        }
        let _ = writeln!(out, " m{material}");
    }
}

fn v(v: DVec3) -> String {
    super::numbers(DVec3::new(v.x, v.y, -v.z), " ")
}
