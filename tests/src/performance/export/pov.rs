//! Exports a scene for POV-Ray 3.7.

use std::fmt::Write as _;

use cases::glam::DVec3;
use cases::{Light, Material, Mesh, Scene};

use super::{File, Known};

/// The distance of the light that replaces a directional light, with parallel rays.
const FAR: f64 = 1e6;

/// Returns one file, `scene.pov`. Ellipsoids, refraction, tinted shadows and half-vector highlights
/// are as in the scene.
///
/// # Errors
/// Returns the name of an object that is neither a sphere nor an untransformed mesh.
pub fn export(scene: &Scene) -> Result<Vec<File>, String> {
    let mut out = head(scene);
    for light in &scene.lights {
        let colour = v(light.colour());
        let _ = match light {
            Light::Point { position, .. } => {
                writeln!(out, "light_source {{ {} color rgb {colour} }}", v(*position))
            }
            Light::Directional { direction, .. } => writeln!(
                out,
                "light_source {{ {} color rgb {colour} parallel point_at <0,0,0> }}",
                v(-*direction * FAR)
            ),
        };
    }
    for (object, i) in scene.objects.iter().zip(0..) {
        let _ = writeln!(out, "// {i}");
        let looks = looks(scene, &scene.materials[object.material]);
        match super::known(scene, object)? {
            Known::Mesh(mesh) => out += &self::mesh(mesh, &looks),
            Known::Sphere { center, radius } => {
                let _ = write!(out, "sphere {{ {}, {radius} {looks}", v(center));
                if !object.is_untransformed() {
                    let m = object.world_from_object;
                    let columns =
                        [m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis, m.translation];
                    let _ = write!(
                        out,
                        " matrix <{}>",
                        columns.map(|c| super::numbers(c, ",")).join(",")
                    );
                }
                out += " }\n";
            }
        }
    }
    Ok(vec![("scene.pov".to_owned(), out.into_bytes())])
}

fn head(scene: &Scene) -> String {
    let (camera, half) = (&scene.camera, super::half_height(scene));
    // A tangent that should be 1 is made exact.
    let half = if (half - 1.0).abs() < 1e-15 { 1.0 } else { half };
    format!(
        "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout 0 \
            ambient_light rgb 1 }}\n\
         background {{ color rgb {} }}\n\
         camera {{ perspective location {} right {} up {} direction {} }}\n",
        // POV-Ray's level is our depth: the same reflected and refracted rays are cast.
        scene.render.max_depth.max(1),
        v(scene.background),
        v(camera.eye),
        v(camera.right * (2.0 * half * super::aspect(scene))),
        v(camera.up * (2.0 * half)),
        v(camera.forward),
    )
}

/// Returns texture and interior. POV-Ray subtracts the transmitted share from diffuse light, so kd
/// is divided by 1 − kt.
fn looks(scene: &Scene, m: &Material) -> String {
    let kt = super::mean(m.kt);
    let mut text = format!(
        "texture {{ pigment {{ color rgb {} transmit {kt} }} finish {{ ambient rgb {} diffuse 1",
        v(m.kd / (1.0 - kt)),
        v(super::ambient(scene)),
    );
    if m.ks != DVec3::ZERO && m.ns > 0.0 {
        let _ = write!(text, " specular {} roughness {}", super::mean(m.ks), 1.0 / m.ns);
    }
    if m.kr != DVec3::ZERO {
        let _ = write!(text, " reflection {{ rgb {} }}", v(m.kr));
    }
    text += " } }";
    if kt > 0.0 {
        let _ = write!(text, " interior {{ ior {} }}", super::relative_index(m));
    }
    text
}

fn mesh(mesh: &Mesh, looks: &str) -> String {
    let list = |vectors: &[DVec3]| {
        let all: Vec<String> = vectors.iter().map(|one| v(single(*one))).collect();
        format!("{{ {}, {} }}", vectors.len(), all.join(", "))
    };
    let faces: Vec<String> =
        mesh.triangles.iter().map(|[a, b, c]| format!("<{a},{b},{c}>")).collect();
    let normals = mesh
        .normals
        .as_ref()
        .map_or_else(String::new, |all| format!("normal_vectors {}\n", list(all)));
    format!(
        "mesh2 {{ vertex_vectors {}\n{normals}face_indices {{ {}, {} }}\n{looks} }}\n",
        list(&mesh.vertices),
        faces.len(),
        faces.join(", ")
    )
}

/// Rounds to single precision as in the mesh files, so that the text has no digits that the files
/// lack.
fn single(v: DVec3) -> DVec3 {
    let short = |x: f64| (x as f32).to_string().parse().unwrap_or(x);
    DVec3::new(short(v.x), short(v.y), short(v.z))
}

fn v(v: DVec3) -> String {
    format!("<{}>", super::numbers(v, ","))
}
