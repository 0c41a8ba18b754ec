//! Objects of the world: shapes in world space or in a space of their own. [rule 20]

use cases::Shape;

use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::frame::Frame;
use crate::rays::moved::MovedRay;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::RuleSource;
use crate::shapes::{Cuboid, Plane, Round, ShapeHit, Solid, Sphere, Square, is_exact};
use crate::watch::work::{Tally, TriangleVisits, Work};
use crate::world::mesh::Mesh;

/// An object of the world.
#[derive(Clone, Debug)]
pub struct Object<T> {
    /// The name, for people.
    pub name: String,
    /// The index into [`World::materials`](crate::world::World::materials).
    pub material: usize,
    pub(crate) shape: ObjectShape<T>,
    /// The transforms, where the object has a space of its own. Stored apart from the other fields,
    /// which a search reads for every object.
    pub(crate) frame: Option<Box<Frame<T>>>,
}

/// The shape of an object.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ObjectShape<T> {
    Solid(Solid<T>),
    /// A mesh, by its index into the world's meshes.
    Mesh(usize),
}

impl<T: Real> Object<T> {
    /// Returns the object in the precision `T`.
    pub fn of(object: &cases::Object) -> Self {
        let frame = || Box::new(Frame::of(&object.world_from_object, &object.object_from_world));
        Self {
            name: object.name.clone(),
            material: object.material,
            shape: form(&object.shape),
            frame: (!object.is_untransformed()).then(frame),
        }
    }

    /// Returns the box around the object in world space; `None` where it has no bounds.
    pub(crate) fn bounds(&self, meshes: &[Mesh<T>]) -> Option<Bounds<T>> {
        let bounds = match &self.shape {
            ObjectShape::Solid(solid) => solid.bounds()?,
            ObjectShape::Mesh(mesh) => meshes[*mesh].bounds(),
        };
        Some(self.frame.as_ref().map_or(bounds, |frame| frame.bounds_to_world(bounds)))
    }

    /// Estimated cost of one intersection test, in units of an untransformed solid. A transform
    /// adds 1; a mesh counts 3, because the ray has to enter its BVH.
    pub(crate) fn cost(&self) -> usize {
        let of_shape = if matches!(self.shape, ObjectShape::Mesh(_)) { 3 } else { 1 };
        of_shape + usize::from(self.frame.is_some())
    }

    /// Returns whether the surface separates an inside from an outside.
    pub(crate) fn has_inside(&self) -> bool {
        !matches!(self.shape, ObjectShape::Solid(Solid::Square(_)))
    }

    /// Returns the ray in the object's own space; `None` where that is world space.
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

    /// Returns the ray in the object's own space, with what its exact numbers follow from; `None`
    /// where that is world space.
    #[inline(always)]
    pub(crate) fn moved_ray<'a>(
        &'a self,
        ray: &'a Ray<T>,
        tally: &mut impl Tally,
    ) -> Option<MovedRay<'a, T>> {
        let frame = self.frame.as_ref()?;
        tally.did(Work::MovedRay);
        Some(frame.moved_ray(ray))
    }

    /// Calls `found` with the first hit of the ray. `FRAMES` says whether the object may have a
    /// space of its own.
    ///
    /// The hit is passed to a closure instead of being returned, so that it stays in registers
    /// unless a call has left it in memory (decision 006).
    #[inline(always)]
    pub(crate) fn intersect<R: RuleSource, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
        found: impl FnOnce(ShapeHit<T>),
    ) {
        if FRAMES && self.frame.is_some() {
            if let Some(hit) = self.intersect_in_frame(rules, ray, meshes, tally) {
                found(hit);
            }
            return;
        }
        match &self.shape {
            ObjectShape::Solid(solid) => {
                if let Some(hit) = solid.intersect(rules, ray) {
                    found(hit);
                }
            }
            ObjectShape::Mesh(mesh) => {
                if let Some(hit) = meshes[*mesh].intersect(rules, ray, &mut TriangleVisits(tally)) {
                    found(hit);
                }
            }
        }
    }

    /// Returns the first hit of the ray on an object that has a space of its own.
    ///
    /// Never inlined: within the search, values that depend only on the ray would be computed again
    /// for every object. With the transform in a function of its own, searches among objects
    /// without a matrix execute some 10 % fewer instructions (decision 006).
    #[inline(never)]
    fn intersect_in_frame<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> Option<ShapeHit<T>> {
        if let (ObjectShape::Solid(solid), true) = (&self.shape, is_exact(rules)) {
            return solid.intersect_moved(rules, &self.moved_ray(ray, tally)?);
        }
        let moved = self.ray_in_frame(rules, ray, tally)?;
        match &self.shape {
            ObjectShape::Solid(solid) => solid.intersect(rules, &moved),
            ObjectShape::Mesh(mesh) => {
                meshes[*mesh].intersect(rules, &moved, &mut TriangleVisits(tally))
            }
        }
    }

    /// Returns the hit point, in the object's own space, on its solid. By rules that move no hits
    /// back onto surfaces, it is the point along the ray.
    ///
    /// Never inlined, like [`Self::intersect_in_frame`].
    #[inline(never)]
    pub(crate) fn place_in_frame<R: RuleSource>(
        &self,
        rules: R,
        solid: &Solid<T>,
        ray: &Ray<T>,
        hit: &ShapeHit<T>,
        tally: &mut impl Tally,
    ) -> HitPoint<T> {
        let places_hits = rules.get().places_hits();
        if places_hits
            && is_exact(rules)
            && let Some(moved) = self.moved_ray(ray, tally)
        {
            return solid.place_moved(rules, &moved, hit);
        }
        let moved = self.ray_in_frame(rules, ray, tally);
        let ray = moved.as_ref().unwrap_or(ray);
        match places_hits {
            true => solid.place(rules, ray, hit),
            false => HitPoint::along(ray, hit.t, solid.normal_at_hit(rules, ray, hit)),
        }
    }

    /// Calls `found` with t of every crossing of the ray with the object, in ascending order.
    /// `FRAMES` says whether the object may have a space of its own. [rule 6]
    #[inline(always)]
    pub(crate) fn crossings<R: RuleSource, Y: Tally, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut Y,
        mut found: impl FnMut(&mut Y, T),
    ) {
        if let (ObjectShape::Solid(solid), true, true) = (&self.shape, FRAMES, is_exact(rules))
            && let Some(moved) = self.moved_ray(ray, tally)
        {
            return solid.moved_crossings(rules, &moved, |t| found(tally, t));
        }
        let moved = if FRAMES { self.ray_in_frame(rules, ray, tally) } else { None };
        let there = moved.as_ref().unwrap_or(ray);
        match &self.shape {
            ObjectShape::Solid(solid) => solid.crossings(rules, there, ray, |t| found(tally, t)),
            ObjectShape::Mesh(mesh) => {
                let mut rest = *ray;
                while let Some(hit) =
                    meshes[*mesh].intersect(rules, &rest.along(there), &mut TriangleVisits(tally))
                {
                    found(tally, hit.t);
                    rest = rest.beyond(rules, hit.t);
                }
            }
        }
    }

    /// Returns whether the ray hits the object. `FRAMES` says whether the object may have a space
    /// of its own.
    #[inline(always)]
    pub(crate) fn is_hit<R: RuleSource, const FRAMES: bool>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> bool {
        if FRAMES && self.frame.is_some() {
            return self.is_hit_in_frame(rules, ray, meshes, tally);
        }
        self.is_hit_in_object_space(rules, ray, meshes, tally)
    }

    /// Returns whether a ray in the space of the shape hits the object.
    #[inline(always)]
    fn is_hit_in_object_space<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> bool {
        match &self.shape {
            ObjectShape::Solid(solid) => solid.intersect(rules, ray).is_some(),
            ObjectShape::Mesh(mesh) => meshes[*mesh].is_hit(rules, ray, &mut TriangleVisits(tally)),
        }
    }

    /// Returns whether the ray hits an object that has a space of its own. Never inlined, like
    /// [`Self::intersect_in_frame`].
    #[inline(never)]
    fn is_hit_in_frame<R: RuleSource>(
        &self,
        rules: R,
        ray: &Ray<T>,
        meshes: &[Mesh<T>],
        tally: &mut impl Tally,
    ) -> bool {
        if let (ObjectShape::Solid(solid), true) = (&self.shape, is_exact(rules)) {
            let moved = self.moved_ray(ray, tally);
            return moved.is_some_and(|moved| solid.intersect_moved(rules, &moved).is_some());
        }
        let moved = self.ray_in_frame(rules, ray, tally);
        moved.is_some_and(|moved| self.is_hit_in_object_space(rules, &moved, meshes, tally))
    }
}

fn form<T: Real>(shape: &Shape) -> ObjectShape<T> {
    ObjectShape::Solid(match *shape {
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
        Shape::Mesh { mesh } => return ObjectShape::Mesh(mesh),
    })
}
