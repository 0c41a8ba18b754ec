//! The scene made ready for rays: numbers in one precision, trees built, nearest hits found. [rule
//! 2]

mod together;

use cases::{Effects, Scene};

pub use crate::bvh::Search;
use crate::bvh::{Bvh, Lanes};
pub use crate::frame::Frame;
use crate::lights::Light;
use crate::mesh::{self, Mesh};
use crate::object::Form;
pub use crate::object::Object;
use crate::ray::{Ray, Spot};
use crate::real::Real;
use crate::rules::RuleSource;
use crate::shapes::Meeting;
use crate::vec3::Vec3;
use crate::work::{Tally, Work};

/// A tree finds the nearest of objects that would cost more than this to ask, one after another, in
/// units of `Object::cost`: measured on the public cases.
const FEW: usize = 7;

/// A scene made ready for rays.
#[derive(Clone, Debug)]
pub struct World<T> {
    /// Where the picture is taken from.
    pub camera: cases::Camera,
    /// Size of the picture and depth of the recursion.
    pub render: cases::scene::Render,
    /// What the scene asks to be simulated.
    pub effects: Effects,
    /// Colour of a ray that meets nothing.
    pub background: Vec3<T>,
    /// In the scene's order.
    pub lights: Vec<Light<T>>,
    /// In the scene's order.
    pub materials: Vec<Material<T>>,
    /// In the scene's order.
    pub objects: Vec<Object<T>>,
    pub(crate) meshes: Vec<Mesh<T>>,
    /// Whether some object has a space of its own. Where none has, searches do not ask each.
    pub(crate) has_frames: bool,
    /// Objects without an end, which no tree can hold.
    pub(crate) endless: Vec<u32>,
    /// The objects in the tree, and the tree over them.
    pub(crate) tree: Option<(Vec<u32>, Bvh)>,
}

/// How a surface answers light. [rule 3]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the letters of rule 3, as in `cases::Material`")]
pub struct Material<T> {
    pub ke: Vec3<T>,
    pub ka: Vec3<T>,
    pub kd: Vec3<T>,
    pub ks: Vec3<T>,
    pub kt: Vec3<T>,
    pub kr: Vec3<T>,
    pub ns: T,
    pub index: T,
}

impl<T: Real> Material<T> {
    /// The material in the precision `T`.
    pub fn of(m: &cases::Material) -> Self {
        Self {
            ke: Vec3::of(m.ke),
            ka: Vec3::of(m.ka),
            kd: Vec3::of(m.kd),
            ks: Vec3::of(m.ks),
            kt: Vec3::of(m.kt),
            kr: Vec3::of(m.kr),
            ns: T::of(m.ns),
            index: T::of(m.index),
        }
    }
}

/// The nearest thing a ray meets, in world space.
#[derive(Clone, Copy, Debug)]
pub struct Hit<T> {
    /// Along the ray.
    pub t: T,
    /// Where.
    pub point: Vec3<T>,
    /// How far along each axis the surface may lie from `point`, at most.
    pub error: Vec3<T>,
    /// Unit normal of the surface itself, outwards. [rule 19]
    pub n_geom: Vec3<T>,
    /// Unit normal to shade with: the interpolated one where there is one, else `n_geom`. [rule 18]
    pub n_shading: Vec3<T>,
    /// Index into [`World::objects`].
    pub object: usize,
}

impl<T> Hit<T> {
    /// The place, with the normal that tells the sides of the surface apart.
    #[inline(always)]
    pub fn spot(&self, n_geom: Vec3<T>) -> Spot<T>
    where
        T: Copy,
    {
        Spot { point: self.point, error: self.error, n_geom }
    }
}

impl<T: Real> World<T> {
    /// The scene made ready, searched through trees.
    pub fn new(scene: &Scene) -> Self {
        Self::with_search(scene, Search::Tree)
    }

    /// The scene made ready, searched in the given way.
    pub fn with_search(scene: &Scene, search: Search) -> Self {
        let mut world = Self {
            camera: scene.camera,
            render: scene.render,
            effects: scene.effects,
            background: Vec3::of(scene.background),
            lights: scene.lights.iter().map(Light::of).collect(),
            materials: scene.materials.iter().map(Material::of).collect(),
            objects: scene.objects.iter().map(Object::of).collect(),
            meshes: scene.meshes.iter().map(|mesh| Mesh::of(mesh, search)).collect(),
            has_frames: scene.objects.iter().any(|object| !object.is_untransformed()),
            endless: Vec::new(),
            tree: None,
        };
        if search == Search::Tree {
            world.plant();
        }
        world
    }

    /// The same, searched by other instructions, which find the same.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        let meshes = self.meshes.into_iter().map(|mesh| mesh.with_lanes(lanes)).collect();
        let tree = self.tree.map(|(inside, tree)| (inside, tree.with_lanes(lanes)));
        Self { meshes, tree, ..self }
    }

    /// Plants the tree over the objects that have an end, where it pays.
    fn plant(&mut self) {
        let (mut inside, mut bounds, mut endless) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..self.objects.len() as u32 {
            match self.objects[i as usize].bounds(&self.meshes) {
                Some(one) => (inside.push(i), bounds.push(one)).0,
                None => endless.push(i),
            }
        }
        if inside.iter().map(|i| self.objects[*i as usize].cost()).sum::<usize>() <= FEW {
            return;
        }
        let loss =
            self.objects.iter().filter_map(|object| object.frame.as_deref()).map(Frame::loss);
        let (tree, order) = Bvh::build(&bounds);
        let inside = order.into_iter().map(|n| inside[n as usize]).collect();
        self.tree = Some((inside, tree.with_loss(loss.fold(T::ONE, T::greatest).f64())));
        self.endless = endless;
    }

    /// Bytes that lights, materials, objects, meshes and trees take; names are not counted.
    pub fn bytes(&self) -> usize {
        let lists = size_of_val(&*self.lights)
            + size_of_val(&*self.materials)
            + size_of_val(&*self.objects);
        let tree =
            self.tree.as_ref().map_or(0, |(inside, tree)| size_of_val(&**inside) + tree.bytes());
        let frames = self.objects.iter().filter(|object| object.frame.is_some()).count()
            * size_of::<Frame<T>>();
        lists
            + frames
            + self.meshes.iter().map(Mesh::bytes).sum::<usize>()
            + size_of_val(&*self.endless)
            + tree
    }

    /// A meeting with an object, its place and normals worked out; the interpolated normal where
    /// `is_smooth`, else the geometric one.
    #[inline(always)]
    pub fn hit<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        (index, met): (usize, Meeting<T>),
        is_smooth: bool,
        tally: &mut impl Tally,
    ) -> Hit<T> {
        let object = &self.objects[index];
        let frame = object.frame.as_deref();
        let places_hits = rules.get().places_hits();
        let (place, n_shading) = match &object.shape {
            Form::Solid(solid) => {
                let moved = object.ray_in_frame(rules, ray, tally);
                let ray = moved.as_ref().unwrap_or(ray);
                let place = match places_hits {
                    true => solid.place(rules, ray, &met),
                    false => Spot::along(ray, met.t, solid.normal_where(rules, ray, &met)),
                };
                (place, None)
            }
            Form::Mesh(mesh) => {
                let mesh = &self.meshes[*mesh];
                let normals = if is_smooth { mesh.corner_normals(&met) } else { None };
                let n_shading = normals.and_then(|normals| {
                    tally.did(Work::SmoothNormal);
                    mesh::interpolate(rules, met.weights, normals)
                });
                (mesh.place(rules, &met), n_shading)
            }
        };
        let spot = match frame {
            _ if !places_hits => {
                let n_geom = frame.map_or(place.n_geom, |f| f.normal_to_world(rules, place.n_geom));
                Spot::along(ray, met.t, n_geom)
            }
            None => place,
            Some(frame) => frame.spot_to_world(rules, &place),
        };
        let to_world = |n| frame.map_or(n, |f| f.normal_to_world(rules, n));
        let Spot { point, error, n_geom } = spot;
        Hit {
            t: met.t,
            point,
            error,
            n_geom,
            n_shading: n_shading.map_or(n_geom, to_world),
            object: index,
        }
    }
}
