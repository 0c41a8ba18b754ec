//! Exports a scene for Mitsuba 3 as XML, with a PLY file for each mesh.

use std::f64::consts::PI;
use std::fmt::Write as _;

use cases::glam::DVec3;
use cases::{Light, Material, Scene};

use super::{File, Known};
use crate::performance::ply;

/// Returns `scene.xml` and its meshes. Mitsuba casts one ray per pixel. From its hit it casts a
/// shadow ray to each light on average, or, if something reflects or refracts, follows one branch
/// at random. Ellipsoids become spheres of the same volume. Ambient light and background are left
/// out.
///
/// # Errors
/// Returns the name of an object that is neither a sphere nor an untransformed mesh.
pub fn export(scene: &Scene) -> Result<Vec<File>, String> {
    let mut out = head(scene);
    for light in &scene.lights {
        out += &emitter(light);
    }
    for (n, material) in scene.materials.iter().enumerate() {
        out += &bsdf(n, material);
    }
    let mut files = vec![];
    for (n, object) in scene.objects.iter().enumerate() {
        let _ = match super::known(scene, object)? {
            Known::Mesh(mesh) => {
                let name = format!("mesh_{n}.ply");
                files.push((name.clone(), ply::encode(mesh)));
                write!(out, "<shape type=\"ply\"><string name=\"filename\" value=\"{name}\"/>")
            }
            Known::Sphere { center, radius } => {
                let (c, radius) = super::as_sphere(object, center, radius);
                let place =
                    format!("<point name=\"center\" x=\"{}\" y=\"{}\" z=\"{}\"/>", c.x, c.y, c.z);
                write!(
                    out,
                    "<shape type=\"sphere\">{place}<float name=\"radius\" value=\"{radius}\"/>"
                )
            }
        };
        let _ = writeln!(out, "<ref id=\"m{}\"/></shape>", object.material);
    }
    out += "</scene>\n";
    files.insert(0, ("scene.xml".to_owned(), out.into_bytes()));
    Ok(files)
}

fn head(scene: &Scene) -> String {
    let camera = &scene.camera;
    let spawns =
        |m: &Material| scene.render.max_depth > 0 && (m.kr != DVec3::ZERO || m.kt != DVec3::ZERO);
    let integrator = if scene.materials.iter().any(spawns) {
        // Mitsuba's depth counts the eye ray. Russian roulette would end paths early.
        let depth = scene.render.max_depth + 1;
        format!(
            "<integrator type=\"path\"><integer name=\"max_depth\" value=\"{depth}\"/><integer \
                name=\"rr_depth\" value=\"1000\"/></integrator>"
        )
    } else {
        let n = scene.lights.len();
        format!(
            "<integrator type=\"direct\"><integer name=\"emitter_samples\" \
                value=\"{n}\"/><integer name=\"bsdf_samples\" value=\"0\"/></integrator>"
        )
    };
    format!(
        "<scene version=\"3.0.0\">\n{integrator}\n<sensor type=\"perspective\">\n\
            <float name=\"fov\" value=\"{}\"/><string name=\"fov_axis\" value=\"y\"/>\n\
         <transform name=\"to_world\"><lookat origin=\"{}\" target=\"{}\" up=\"{}\"/></transform>\n\
         <film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" \
         value=\"{}\"/>\
         <string name=\"pixel_format\" value=\"rgb\"/><rfilter type=\"box\"/></film>\n\
         <sampler type=\"independent\"><integer name=\"sample_count\" value=\"1\"/></sampler>\n\
         </sensor>\n",
        camera.fov_y_deg,
        v(camera.eye),
        v(camera.eye + camera.forward),
        v(camera.up),
        scene.render.width,
        scene.render.height,
    )
}

/// Returns a light. Mitsuba's light falls off with the square of the distance. At the distance of
/// the origin it is as bright as the scene's.
fn emitter(light: &Light) -> String {
    match light {
        Light::Point { position, colour, .. } => format!(
            "<emitter type=\"point\"><point name=\"position\" x=\"{}\" y=\"{}\" z=\"{}\"/><rgb \
                name=\"intensity\" value=\"{}\"/></emitter>\n",
            position.x,
            position.y,
            position.z,
            v(*colour * PI * position.length_squared()),
        ),
        Light::Directional { direction, colour, .. } => format!(
            "<emitter type=\"directional\"><vector name=\"direction\" x=\"{}\" y=\"{}\" \
                z=\"{}\"/><rgb name=\"irradiance\" value=\"{}\"/></emitter>\n",
            direction.x,
            direction.y,
            direction.z,
            v(*colour * PI),
        ),
    }
}

/// Returns a material. Glass is two-sided by itself; the other materials are wrapped to be
/// two-sided.
fn bsdf(n: usize, m: &Material) -> String {
    if m.kt != DVec3::ZERO {
        let index = super::relative_index(m);
        let indices = format!(
            "<float name=\"int_ior\" value=\"{index}\"/><float name=\"ext_ior\" value=\"1\"/>"
        );
        return format!("<bsdf type=\"dielectric\" id=\"m{n}\">{indices}</bsdf>\n");
    }
    let (kind, name, colour) = match super::mean(m.kr) > 0.5 {
        true => ("conductor", "specular_reflectance", m.kr),
        false => ("diffuse", "reflectance", m.kd),
    };
    let inner =
        format!("<bsdf type=\"{kind}\"><rgb name=\"{name}\" value=\"{}\"/></bsdf>", v(colour));
    format!("<bsdf type=\"twosided\" id=\"m{n}\">{inner}</bsdf>\n")
}

fn v(v: DVec3) -> String {
    super::numbers(v, ", ")
}
