//! The scene prepared for ray tracing: numbers in one precision, trees, and searches for hits.
//! [rule 2]

pub(crate) mod clear;
pub mod mesh;
pub mod object;
pub mod packet;
mod packet_hits;
pub mod search;
mod triangles;

use cases::{Effects, Scene};

use crate::bvh::Bvh;
pub use crate::bvh::Search;
use crate::lanes::Lanes;
use crate::light::lights::Light;
use crate::light::material::{Material, ReflectedLights};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
pub use crate::rays::frame::Frame;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{InterpolatedIn, RuleSource};
use crate::shapes::ShapeHit;
use crate::watch::work::{Tally, Work};
use clear::{Alone, GlassBall};
use mesh::Mesh;
pub use object::Object;
use object::ObjectShape;

/// The greatest total cost, in units of `Object::cost`, of bounded objects that are searched
/// without a tree. Measured on the public cases.
const FEW: usize = 7;

/// A scene prepared for ray tracing, in world space.
#[derive(Clone, Debug)]
pub struct World<T> {
    /// The scene's camera.
    pub camera: cases::Camera,
    /// The size of the picture and the depth of the recursion.
    pub render: cases::scene::Render,
    /// The effects that the scene calls for.
    pub effects: Effects,
    /// The colour of a ray that hits nothing, in linear RGB.
    pub background: Vec3<T>,
    /// The lights, in the scene's order.
    pub lights: Vec<Light<T>>,
    /// The materials, in the scene's order.
    pub materials: Vec<Material<T>>,
    /// The lights that each material reflects.
    pub(crate) reflected: Vec<ReflectedLights>,
    /// Whether the light of some lamp may vanish in the sum of the others: it weakens with
    /// distance, and no term of the direct light is greater than I_j A_j (kd + ks) or negative.
    pub(crate) may_vanish: bool,
    /// The ball around the transparent objects.
    pub(crate) glass: GlassBall<T>,
    /// What a ray can still hit that leaves the only object.
    pub(crate) alone: Alone,
    /// The objects, in the scene's order.
    pub objects: Vec<Object<T>>,
    pub(crate) meshes: Vec<Mesh<T>>,
    /// Whether some object has a transform. Where none has, searches do not test each object for
    /// one.
    pub(crate) has_frames: bool,
    /// The indices of the objects without bounds, which no tree can hold.
    pub(crate) endless: Vec<u32>,
    /// The indices of the objects in the tree, and the tree over them.
    pub(crate) tree: Option<(Vec<u32>, Bvh)>,
}

/// The nearest hit of a ray, in world space.
#[derive(Clone, Copy, Debug)]
pub struct Hit<T> {
    /// The parameter along the ray, in units of the length of its direction.
    pub t: T,
    /// The point of the hit.
    pub point: Vec3<T>,
    /// The greatest distance along each axis between `point` and the surface.
    pub error: Vec3<T>,
    /// The unit normal of the surface itself, outwards. [rule 19]
    pub n_geom: Vec3<T>,
    /// The unit normal to shade with: the interpolated one where there is one, else `n_geom`.
    /// [rule 18]
    pub n_shading: Vec3<T>,
    /// The index into [`World::objects`].
    pub object: usize,
}

impl<T> Hit<T> {
    /// Returns the hit point with the normal `n_geom`, which separates the sides of the surface.
    #[inline(always)]
    pub fn hit_point(&self, n_geom: Vec3<T>) -> HitPoint<T>
    where
        T: Copy,
    {
        HitPoint { point: self.point, error: self.error, n_geom }
    }
}

impl<T: Real> World<T> {
    /// Returns the scene prepared for ray tracing, searched through trees.
    ///
    /// ```
    /// use cases::{Course, scene};
    /// use reference::world::World;
    ///
    /// let text = r#"
    ///     render = { size = [8, 6] }
    ///     scene.camera = { eye = [0, 0, 4], look_at = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }
    ///     scene.materials = { red = { kd = [1, 0, 0] } }
    ///     scene.objects = [{ sphere = { radius = 1 }, material = "red" }]"#;
    /// let scene = scene::parse("ball.toml", text, "".as_ref(), &Course::default()).unwrap();
    /// assert_eq!(World::<f64>::new(&scene).objects.len(), 1);
    /// ```
    pub fn new(scene: &Scene) -> Self {
        Self::with_search(scene, Search::Tree)
    }

    /// Returns the scene prepared for ray tracing, searched in the given way.
    pub fn with_search(scene: &Scene, search: Search) -> Self {
        let lights: Vec<Light<T>> = scene.lights.iter().map(Light::of).collect();
        let materials: Vec<Material<T>> = scene.materials.iter().map(Material::of).collect();
        let objects: Vec<Object<T>> = scene.objects.iter().map(Object::of).collect();
        let meshes: Vec<Mesh<T>> = scene.meshes.iter().map(|mesh| Mesh::of(mesh, search)).collect();
        let is_transparent = |object: &&Object<T>| materials[object.material].kt != Vec3::ZERO;
        let transparent = objects.iter().filter(is_transparent);
        let mut world = Self {
            camera: scene.camera,
            render: scene.render,
            effects: scene.effects,
            background: Vec3::of(scene.background),
            reflected: materials.iter().map(|one| ReflectedLights::of(one, &lights)).collect(),
            may_vanish: lights.iter().any(Light::weakens)
                && materials.iter().all(Material::only_weakens)
                && lights.iter().all(|light| light.colour.min_element() >= T::ZERO),
            glass: GlassBall::of(transparent, &meshes, loss(&objects)),
            alone: Alone::of(&objects, &meshes),
            lights,
            materials,
            objects,
            meshes,
            has_frames: scene.objects.iter().any(|object| !object.is_untransformed()),
            endless: Vec::new(),
            tree: None,
        };
        if search == Search::Tree {
            world.build_tree();
        }
        world
    }

    /// Returns the world, searched with another instruction set, which finds the same hits.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        let meshes = self.meshes.into_iter().map(|mesh| mesh.with_lanes(lanes)).collect();
        let tree = self.tree.map(|(inside, tree)| (inside, tree.with_lanes(lanes)));
        Self { meshes, tree, ..self }
    }

    /// Builds the tree over the objects with bounds, where it pays.
    fn build_tree(&mut self) {
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
        let (tree, order) = Bvh::build(&bounds);
        let inside = order.into_iter().map(|n| inside[n as usize]).collect();
        self.tree = Some((inside, tree.with_loss(loss(&self.objects).f64())));
        self.endless = endless;
    }

    /// Returns the bytes that lights, materials, objects, meshes and trees take; names are not
    /// counted.
    pub fn bytes(&self) -> usize {
        let lists = size_of_val(&*self.lights)
            + size_of_val(&*self.materials)
            + size_of_val(&*self.reflected)
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

    /// Computes the point and the normals, in world space, of a hit on the object with this index.
    ///
    /// `n_shading` is the interpolated normal if `is_smooth` and the mesh has normals, else the
    /// geometric one.
    #[inline(always)]
    pub fn hit<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        (index, hit): (usize, ShapeHit<T>),
        is_smooth: bool,
        tally: &mut impl Tally,
    ) -> Hit<T> {
        let object = &self.objects[index];
        let frame = object.frame.as_deref();
        let places_hits = rules.get().places_hits();
        let (place, n_shading) = match &object.shape {
            ObjectShape::Solid(solid) => {
                let place = match (frame, places_hits) {
                    (Some(_), _) => object.place_in_frame(rules, solid, ray, &hit, tally),
                    (None, true) => solid.place(rules, ray, &hit),
                    (None, false) => {
                        HitPoint::along(ray, hit.t, solid.normal_at_hit(rules, ray, &hit))
                    }
                };
                (place, None)
            }
            ObjectShape::Mesh(mesh) => {
                let mesh = &self.meshes[*mesh];
                let normals = if is_smooth { mesh.corner_normals(&hit) } else { None };
                let n_shading = normals.and_then(|normals| {
                    let normals = match (rules.get().interpolated_in, frame) {
                        (InterpolatedIn::WorldSpace, Some(frame)) => {
                            normals.map(|n| frame.normal_to_world(rules, n))
                        }
                        _ => normals,
                    };
                    tally.did(Work::SmoothNormal);
                    mesh::interpolate(rules, hit.weights, normals)
                });
                (mesh.place(rules, &hit), n_shading)
            }
        };
        let hit_point = match frame {
            _ if !places_hits => {
                let n_geom = frame.map_or(place.n_geom, |f| f.normal_to_world(rules, place.n_geom));
                HitPoint::along(ray, hit.t, n_geom)
            }
            None => place,
            Some(frame) => frame.hit_point_to_world(rules, &place),
        };
        let to_world = |n| match frame {
            Some(frame) if rules.get().interpolated_in == InterpolatedIn::ObjectSpace => {
                frame.normal_to_world(rules, n)
            }
            _ => n,
        };
        let HitPoint { point, error, n_geom } = hit_point;
        Hit {
            t: hit.t,
            point,
            error,
            n_geom,
            n_shading: n_shading.map_or(n_geom, to_world),
            object: index,
        }
    }
}

/// Returns how many times as much as in world space the tests of some object lose.
fn loss<T: Real>(objects: &[Object<T>]) -> T {
    objects
        .iter()
        .filter_map(|object| object.frame.as_deref())
        .map(Frame::loss)
        .fold(T::ONE, T::greatest)
}
