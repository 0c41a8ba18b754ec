//! Resolves scenes as they are written: names become indices, lists of transforms become matrices,
//! and groups are dissolved.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};

use glam::{DAffine3, DVec3};

use super::limits::{MAX_NESTING, MAX_OBJECTS, MAX_PIXELS, MAX_TRIANGLES};
use super::model::{Attenuation, Camera, Light, Material, Mesh, Object, Render, Scene, Shape};
use super::raw::numbers::unit;
use super::raw::objects::{RawMesh, RawObject, RawTransform};
use super::raw::read::{At, Each, Maybe, Notes};
use super::raw::{RawAttenuation, RawCamera, RawLight, RawMaterial, RawRender, RawScene};
use super::{mesh, transform};
use crate::course::Course;
use crate::effects::{self, Effects};
use crate::problem::{did_you_mean, quoted};

/// The index of refraction of air. [rule 9]
const AIR: f64 = 1.0003;

/// Least sine of the angle between `up` and the view.
const LEAST_SINE_OF_UP: f64 = 1e-6;

/// Returns the scene that `raw` describes, with the effects that it calls for under `course`.
///
/// Every problem of `raw` is noted. If there is one, or if `render` is missing, the result is
/// `None`, because a part of a scene would have indices that point at nothing.
pub(crate) fn scene(
    raw: &RawScene,
    render: Option<Render>,
    base: &Path,
    course: &Course,
    notes: &mut Notes,
) -> Option<Scene> {
    let n_before = notes.len();
    let materials: Vec<Material> =
        raw.materials.iter().filter_map(|(name, raw)| material(name, raw, notes)).collect();
    let index_of =
        raw.materials.keys().enumerate().map(|(index, name)| (name.as_str(), index)).collect();
    let mut walk = Walk {
        base,
        materials: index_of,
        names: HashSet::new(),
        files: HashMap::new(),
        meshes: vec![],
        objects: vec![],
    };
    let root = Context {
        name: "objects",
        material: None,
        world_from_here: DAffine3::IDENTITY,
        nesting: 0,
    };
    walk.list(&raw.objects, &root, notes);
    let (meshes, objects) = (walk.meshes, walk.objects);
    let camera = raw.camera.0.as_ref().and_then(|raw| camera(raw, notes));
    let lights = raw.lights.0.iter().flatten().filter_map(|raw| light(raw, notes)).collect();
    if notes.len() > n_before || raw.has_hole() {
        return None;
    }
    let mut scene = Scene {
        render: render?,
        effects: Effects::NONE,
        camera: camera?,
        background: raw.background.get(),
        lights,
        materials,
        meshes,
        objects,
    };
    scene.effects = effects::called_for(&scene, course);
    Some(scene)
}

/// Returns the settings that `raw` describes, or `None` after noting that the picture is too large.
pub(crate) fn render(raw: &RawRender, notes: &mut Notes) -> Option<Render> {
    let [width, height] = raw.size.map(|side| side.0);
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        let message = format!("a picture has at most {MAX_PIXELS} pixels");
        notes.add(raw.size.span.clone(), message, format!("{width} × {height} is more"));
        return None;
    }
    Some(Render { width, height, max_depth: raw.max_depth.0, threshold: raw.threshold.get() })
}

/// Returns the camera that `raw` describes, or `None` after noting a problem. [rule 1]
pub(crate) fn camera(raw: &RawCamera, notes: &mut Notes) -> Option<Camera> {
    let eye = raw.eye.get();
    let Some(forward) = unit(raw.look_at.get() - eye) else {
        notes.add(
            raw.look_at.span.clone(),
            "the camera looks at its own eye",
            "the same point as `eye`",
        );
        return None;
    };
    let across = forward.cross(raw.up.get());
    if across.length() < LEAST_SINE_OF_UP {
        let problem = notes.add(
            raw.up.span.clone(),
            "`up` is parallel to the view",
            "the correct result is undefined",
        );
        problem.help("any direction that does not point along `look_at` − `eye` will do");
        return None;
    }
    let right = across.normalize();
    let up = right.cross(forward).normalize();
    Some(Camera { eye, right, up, forward, fov_y_deg: raw.fov_y_deg.get() })
}

/// Returns the light that `raw` describes, or `None` after noting a problem.
pub(crate) fn light(raw: &RawLight, notes: &mut Notes) -> Option<Light> {
    Some(match raw {
        RawLight::Point(raw) => Light::Point {
            position: raw.position.get(),
            colour: raw.colour.get(),
            ambient: raw.ambient.get(),
            attenuation: attenuation(&raw.attenuation, notes)?,
        },
        RawLight::Directional(raw) => Light::Directional {
            direction: raw.direction.get(),
            colour: raw.colour.get(),
            ambient: raw.ambient.get(),
        },
    })
}

fn attenuation(raw: &At<RawAttenuation>, notes: &mut Notes) -> Option<Attenuation> {
    let [quadratic, linear, constant] = [raw.quadratic.get(), raw.linear.get(), raw.constant.get()];
    if [quadratic, linear, constant] == [0.0; 3] {
        let problem = notes.add(
            raw.span.clone(),
            "an attenuation cannot be all 0",
            "this divides by 0 at every distance",
        );
        problem.help(
            "for a light that does not weaken leave `attenuation` out, or write `{ constant = 1 }`",
        );
        return None;
    }
    Some(Attenuation { quadratic, linear, constant })
}

/// Returns the material that `raw` describes, or `None` if it could not be read.
pub(crate) fn material(
    name: &str,
    raw: &Maybe<RawMaterial>,
    notes: &mut Notes,
) -> Option<Material> {
    let raw = raw.0.as_ref()?;
    let [ks, kt] = [raw.ks.get(), raw.kt.get()];
    needed(
        raw.ns.is_none() && ks != DVec3::ZERO,
        "ns",
        "ks",
        &raw.ks,
        "the specular exponent, such as `ns = 50`",
        notes,
    );
    needed(
        raw.index.is_none() && kt != DVec3::ZERO,
        "index",
        "kt",
        &raw.kt,
        "the index of refraction, such as `index = 1.52`",
        notes,
    );
    let kd = raw.kd.get();
    Some(Material {
        name: name.to_owned(),
        ke: raw.ke.get(),
        ka: raw.ka.map_or(kd, |ka| ka.get()),
        kd,
        ks,
        kt,
        kr: raw.kr.map_or(ks, |kr| kr.get()),
        ns: raw.ns.map_or(0.0, |ns| ns.get()),
        index: raw.index.map_or(AIR, |index| index.get()),
    })
}

fn needed<T>(
    is_missing: bool,
    key: &str,
    because: &str,
    at: &At<T>,
    help: &str,
    notes: &mut Notes,
) {
    if is_missing {
        let label = format!("with `{because}`, `{key}` is needed too");
        notes
            .add(at.span.clone(), format!("missing key `{key}`"), label)
            .help(format!("give {help}"));
    }
}

/// The properties that an object takes from the groups around it.
struct Context<'a> {
    name: &'a str,
    material: Option<&'a At<String>>,
    world_from_here: DAffine3,
    nesting: usize,
}

/// A walk through objects and groups, with its results so far.
struct Walk<'a> {
    base: &'a Path,
    materials: BTreeMap<&'a str, usize>,
    names: HashSet<String>,
    files: HashMap<(PathBuf, Option<bool>), Option<usize>>,
    meshes: Vec<Mesh>,
    objects: Vec<Object>,
}

impl Walk<'_> {
    fn list(&mut self, list: &Each<At<RawObject>>, around: &Context<'_>, notes: &mut Notes) {
        for (index, raw) in list.0.iter().enumerate() {
            if let Some(raw) = raw {
                self.object(raw, format!("{}[{index}]", around.name), around, notes);
            }
        }
    }

    fn object(
        &mut self,
        raw: &At<RawObject>,
        place: String,
        around: &Context<'_>,
        notes: &mut Notes,
    ) {
        let name = self.name(raw, place, notes);
        let world_from_object = around.world_from_here * product(&raw.transforms, notes);
        let material = raw.material.as_ref().or(around.material);
        if let Some(group) = &raw.group {
            if around.nesting == MAX_NESTING {
                let label = format!("more than {MAX_NESTING} groups around each other");
                notes.add(raw.span.clone(), "groups are nested too deeply", label);
                return;
            }
            let inside = Context {
                name: &name,
                material,
                world_from_here: world_from_object,
                nesting: around.nesting + 1,
            };
            return self.list(group, &inside, notes);
        }
        let material = self.material(material, raw, notes);
        let shape = self.shape(raw, notes);
        if !transform::is_invertible(&world_from_object) {
            let problem = notes.add(
                raw.span.clone(),
                "this object's matrix is singular, or nearly so",
                "all its transforms together",
            );
            problem.help(
                "together with those of its groups they flatten it, or scale it beyond the range \
                of numbers",
            );
        }
        if let (Some(material), Some(shape)) = (material, shape) {
            self.push(
                Object {
                    name,
                    shape,
                    material,
                    world_from_object,
                    object_from_world: world_from_object.inverse(),
                },
                raw,
                notes,
            );
        }
    }

    fn push(&mut self, object: Object, raw: &At<RawObject>, notes: &mut Notes) {
        if self.objects.len() == MAX_OBJECTS {
            notes.add(
                raw.span.clone(),
                format!("a scene has at most {MAX_OBJECTS} objects"),
                "too many",
            );
            return;
        }
        self.objects.push(object);
    }

    /// Returns the name of an object, or else its place. A name of another object is noted.
    fn name(&mut self, raw: &At<RawObject>, place: String, notes: &mut Notes) -> String {
        let Some(name) = &raw.name else { return place };
        if !self.names.insert(name.value.clone()) {
            notes.add(
                name.span.clone(),
                format!("two objects are called `{}`", name.value),
                "this name is taken",
            );
        }
        name.value.clone()
    }

    fn material(
        &self,
        name: Option<&At<String>>,
        raw: &At<RawObject>,
        notes: &mut Notes,
    ) -> Option<usize> {
        let known = || self.materials.keys().copied();
        let Some(name) = name else {
            let problem =
                notes.add(raw.span.clone(), "missing key `material`", "an object needs this key");
            problem.help(format!("defined here: {}", quoted(known())));
            return None;
        };
        let found = self.materials.get(name.as_str()).copied();
        if found.is_none() {
            let message = format!("unknown material `{}`", name.value);
            let problem = notes.add(name.span.clone(), message, "not defined in [scene.materials]");
            let defined = format!("defined here: {}", quoted(known()));
            problem.help(match did_you_mean(name, known()) {
                Some(meant) => format!("did you mean `{meant}`? {defined}"),
                None => defined,
            });
        }
        found
    }

    fn shape(&mut self, raw: &RawObject, notes: &mut Notes) -> Option<Shape> {
        let mesh = raw
            .mesh
            .as_ref()
            .and_then(|mesh| self.mesh(mesh, notes))
            .map(|mesh| Shape::Mesh { mesh });
        mesh.or_else(|| super::shapes::shape(raw, notes))
    }

    fn mesh(&mut self, raw: &At<RawMesh>, notes: &mut Notes) -> Option<usize> {
        let read = match &raw.value {
            RawMesh::Inline(raw) => mesh::inline(raw, notes)?,
            RawMesh::File(raw) => {
                let path = self.base.join(raw.file.as_str());
                let key = (path, raw.smooth);
                if let Some(known) = self.files.get(&key) {
                    return *known;
                }
                let read = mesh::read(raw, &key.0, notes);
                self.files.insert(key, read.is_some().then_some(self.meshes.len()));
                read?
            }
        };
        self.meshes.push(read);
        let most = |n: fn(&Mesh) -> usize| self.meshes.iter().map(n).sum::<usize>() > MAX_TRIANGLES;
        if most(|mesh| mesh.triangles.len()) || most(|mesh| mesh.vertices.len()) {
            let message =
                format!("a scene has at most {MAX_TRIANGLES} triangles and as many vertices");
            notes.add(raw.span.clone(), message, "this mesh exceeds them");
        }
        Some(self.meshes.len() - 1)
    }
}

/// Returns M = T_n … T_1 of a list of transforms. A transform without an inverse is noted.
pub(crate) fn product(steps: &Each<At<RawTransform>>, notes: &mut Notes) -> DAffine3 {
    let mut map = DAffine3::IDENTITY;
    for step in steps.0.iter().flatten() {
        match transform::matrix(step) {
            Ok(next) => map = next * map,
            Err(why) => {
                notes.add(step.span.clone(), why, "a transform must have an inverse");
            }
        }
    }
    map
}
