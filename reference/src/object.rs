//! A thing in the world: a shape, in the world itself or in a space of its own. [rule 20]

use cases::Shape;

use crate::bounds::Bounds;
use crate::frame::Frame;
use crate::mesh::Mesh;
use crate::ray::Ray;
use crate::real::Real;
use crate::rules::RuleSource;
use crate::shapes::{Cuboid, Meeting, Plane, Round, Solid, Sphere, Square};
use crate::vec3::Vec3;
use crate::work::{OfTriangles, Tally, Work};

/// A thing in the world.
#[derive(Clone, Debug)]
pub struct Object<T> {
    /// For people.
    pub name: String,
    /// Index into [`World::materials`](crate::world::World::materials).
    pub material: usize,
    pub(crate) shape: Form<T>,
    /// Apart from the rest, which a search goes through.
    pub(crate) frame: Option<Box<Frame<T>>>,
}

/// The shape of an object.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form<T> {
    Solid(Solid<T>),
    /// Index into the world's meshes.
    Mesh(usize),
}

impl<T: Real> Object<T> {
    /// The object in the precision `T`.
    pub fn of(object: &cases::Object) -> Self {
        let frame = || Box::new(Frame::of(&object.world_from_object, &object.object_from_world));
        Self {
            name: object.name.clone(),
            material: object.material,
            shape: form(&object.shape),
            frame: (!object.is_untransformed()).then(frame),
        }
    }

    /// The box around it in world space; `None` where it has no end.
    pub(crate) fn bounds(&self, meshes: &[Mesh<T>]) -> Option<Bounds<T>> {
        let bounds = match &self.shape {
            Form::Solid(solid) => solid.bounds()?,
            Form::Mesh(mesh) => meshes[*mesh].bounds(),
        };
        Some(self.frame.as_ref().map_or(bounds, |frame| frame.bounds_to_world(bounds)))
    }

    /// What it costs to ask it, about, in questions to a bare solid: a matrix is one more, a tree
    /// of its own makes it three.
    pub(crate) fn cost(&self) -> usize {
        let of_shape = if matches!(self.shape, Form::Mesh(_)) { 3 } else { 1 };
        of_shape + usize::from(self.frame.is_some())
    }

    /// The ray in the object's own space; `None` where that is the world.
    #[inline(always)]
    pub(crate) fn ray_in_frame<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        tally: &mut impl Tally,
    ) -> Option<Ray<T>> {
        let frame = self.frame.as_ref()?;
        tally.did(Work::MovedRay);
        Some(Frame::ray_to_object(rules, &frame.object_from_world, ray))
    }

    /// Tells `found` of the first meeting of the ray with it, where it may have a space of its own
    /// if `FRAMES` says so. A meeting that is told, not returned, stays in registers unless a call
    /// has left it in memory.
    #[inline(always)]
    pub(crate) fn meet<R: RuleSource, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
        found: impl FnOnce(Meeting<T>),
    ) {
        if FRAMES && self.frame.is_some() {
            if let Some(met) = self.meet_there(rules, ray, meshes, tally) {
                found(met);
            }
            return;
        }
        match &self.shape {
            Form::Solid(solid) => {
                if let Some(met) = solid.meet(rules, ray) {
                    found(met);
                }
            }
            Form::Mesh(mesh) => {
                if let Some(met) = meshes[*mesh].meet(rules, ray, &mut OfTriangles(tally)) {
                    found(met);
                }
            }
        }
    }

    /// The first meeting of the ray with an object that has a space of its own. Kept out of the
    /// search, which then works out once what is the ray's alone: searches among objects without a
    /// matrix execute some 10 % fewer instructions so.
    #[inline(never)]
    fn meet_there<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> Option<Meeting<T>> {
        let moved = self.ray_in_frame(rules, ray, tally)?;
        match &self.shape {
            Form::Solid(solid) => solid.meet(rules, &moved),
            Form::Mesh(mesh) => meshes[*mesh].meet(rules, &moved, &mut OfTriangles(tally)),
        }
    }

    /// Every crossing of the ray with it, told to `found` in order of t, where it may have a space
    /// of its own if `FRAMES` says so. [rule 6]
    #[inline(always)]
    pub(crate) fn crossings<R: RuleSource, Y: Tally, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut Y,
        mut found: impl FnMut(&mut Y, T),
    ) {
        let moved = if FRAMES { self.ray_in_frame(rules, ray, tally) } else { None };
        let there = moved.as_ref().unwrap_or(ray);
        match &self.shape {
            Form::Solid(solid) => solid.crossings(rules, there, ray, |t| found(tally, t)),
            Form::Mesh(mesh) => {
                let mut rest = *ray;
                while let Some(met) =
                    meshes[*mesh].meet(rules, &rest.along(there), &mut OfTriangles(tally))
                {
                    found(tally, met.t);
                    rest = rest.beyond(rules, met.t);
                }
            }
        }
    }

    /// Whether the ray meets it, where it may have a space of its own if `FRAMES` says so.
    #[inline(always)]
    pub(crate) fn is_met<R: RuleSource, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> bool {
        if FRAMES && self.frame.is_some() {
            return self.is_met_there(rules, ray, meshes, tally);
        }
        self.is_met_here(rules, ray, meshes, tally)
    }

    /// The same for a ray in the space of the shape.
    #[inline(always)]
    fn is_met_here<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> bool {
        match &self.shape {
            Form::Solid(solid) => solid.meet(rules, ray).is_some(),
            Form::Mesh(mesh) => meshes[*mesh].is_met(rules, ray, &mut OfTriangles(tally)),
        }
    }

    /// The same for an object with a space of its own.
    #[inline(never)]
    fn is_met_there<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> bool {
        let moved = self.ray_in_frame(rules, ray, tally);
        moved.is_some_and(|moved| self.is_met_here(rules, &moved, meshes, tally))
    }
}

fn form<T: Real>(shape: &Shape) -> Form<T> {
    Form::Solid(match *shape {
        Shape::Sphere { center, radius } => {
            Solid::Sphere(Sphere { center: Vec3::of(center), radius: T::of(radius) })
        }
        Shape::Plane { normal, k } => Solid::Plane(Plane { normal: Vec3::of(normal), k: T::of(k) }),
        Shape::Square {} => Solid::Square(Square),
        Shape::Box { min, max } => Solid::Cuboid(Cuboid { min: Vec3::of(min), max: Vec3::of(max) }),
        Shape::Cylinder { radius, z_min, z_max, capped } => Solid::Round(Round {
            bottom_radius: T::of(radius),
            top_radius: T::of(radius),
            z_min: T::of(z_min),
            z_max: T::of(z_max),
            is_capped: capped,
        }),
        Shape::Cone { bottom_radius, top_radius, z_min, z_max, capped } => Solid::Round(Round {
            bottom_radius: T::of(bottom_radius),
            top_radius: T::of(top_radius),
            z_min: T::of(z_min),
            z_max: T::of(z_max),
            is_capped: capped,
        }),
        Shape::Mesh { mesh } => return Form::Mesh(mesh),
    })
}
