//! The kernel traces rays and computes the light that they return. [rule 2] [rule 5] to [rule 13]

mod direct;
mod mistaken;
mod weights;

use arrayvec::ArrayVec;
use cases::ray_tree::RayKind;
use cases::{Effect, Effects};

use crate::light::optics;
use crate::light::shade;
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::camera::Lens;
use crate::rays::ray::{HitPoint, Ray};
use crate::rules::{Cut, Cutoff, Depth, InsideBy, Mixing, RuleSource, TotalReflection, Turning};
use crate::shapes::ShapeHit;
use crate::trace::simulated::{AllEffects, EffectSource};
use crate::watch::work::Work;
use crate::watch::{HitRecord, Watch};
use crate::world::packet;
use crate::world::{Hit, World};

/// A world with the rules and effects by which it is rendered, chosen once for a picture.
#[derive(Clone, Copy, Debug)]
pub struct Kernel<'w, T, R, E = AllEffects> {
    /// The world.
    pub world: &'w World<T>,
    /// The rules.
    pub rules: R,
    lens: Lens<T>,
    effects: E,
    /// Whether [`Rules::is_proven`](crate::rules::Rules::is_proven).
    is_proven: bool,
}

/// A point of the picture: a pixel and the position in it, as in [`Kernel::eye`].
pub type Point<T> = ((u32, u32), (T, T));

/// The path of a ray: its kind, depth and weight.
#[derive(Clone, Copy, Debug)]
pub struct Path<T> {
    /// The kind of the ray.
    pub kind: RayKind,
    /// The depth; 0 for the eye ray.
    pub depth: u32,
    /// The product of the kr and kt along the path; (1, 1, 1) for the eye ray.
    pub weight: Vec3<T>,
}

impl<T: Real> Path<T> {
    /// Returns the path of an eye ray with the depth `depth`.
    pub fn eye(depth: u32) -> Self {
        Self { kind: RayKind::Eye, depth, weight: Vec3::ONE }
    }
}

/// A point to shade, with the direction from which it is seen.
#[derive(Clone, Copy, Debug)]
pub struct ShadingPoint<T> {
    /// The point.
    pub hit_point: HitPoint<T>,
    /// The normal used for shading, turned against the ray. [rule 11]
    pub normal: Vec3<T>,
    /// The direction −d towards the viewer.
    pub to_viewer: Vec3<T>,
    /// Whether the ray is inside the object.
    pub is_inside: bool,
    /// The index of the material in [`World::materials`].
    pub material: usize,
}

/// How a ray leaves a surface.
#[derive(Clone, Copy, Debug)]
struct Leaves<T> {
    /// Whether it goes to the outside of the object.
    outside: bool,
    /// The product of its direction and the surface's normal.
    along: T,
}

/// Returns whether a ray of this depth and weight spawns further rays. A threshold of 0 switches
/// the test of the weight off. [rule 13]
#[inline(always)]
pub fn goes_on<T: Real, R: RuleSource>(
    rules: R,
    depth: u32,
    max_depth: u32,
    weight: Vec3<T>,
    threshold: T,
) -> bool {
    is_shallow(rules, depth, max_depth) && !is_faint(rules, weight, threshold)
}

/// Returns whether a ray of this depth may spawn further rays. [rule 13]
#[inline(always)]
fn is_shallow<R: RuleSource>(rules: R, depth: u32, max_depth: u32) -> bool {
    match rules.get().depth {
        Depth::Less => depth < max_depth,
        Depth::OneMore => depth <= max_depth && max_depth > 0,
        Depth::LessOrEqual => depth <= max_depth,
        Depth::OneLess => depth + 1 < max_depth,
        Depth::EyeOnly => depth == 0 && max_depth > 0,
        Depth::Five => depth < 5,
    }
}

/// Returns whether a path of this weight ends because of the threshold. [rule 13]
#[inline(always)]
fn is_faint<T: Real, R: RuleSource>(rules: R, weight: Vec3<T>, threshold: T) -> bool {
    let greatest = match rules.get().cutoff {
        Cutoff::AllChannels | Cutoff::LastOnly | Cutoff::OrEqual => weight.max_element(),
        Cutoff::AnyChannel => weight.min_element(),
        Cutoff::Absent => T::INFINITY,
        Cutoff::Mean => weight.dot(Vec3::ONE) / T::of(3.0),
    };
    let is_equal = rules.get().cutoff == Cutoff::OrEqual && greatest == threshold;
    threshold > T::ZERO && (greatest < threshold || is_equal)
}

impl<'w, T: Real, R: RuleSource> Kernel<'w, T, R> {
    /// Returns the kernel that simulates `effects` and no others.
    pub fn new(world: &'w World<T>, rules: R, effects: Effects) -> Self {
        Self::by(world, rules, AllEffects::of(effects, 0.0))
    }
}

impl<'w, T: Real, R: RuleSource, E: EffectSource> Kernel<'w, T, R, E> {
    /// Returns the kernel that simulates the effects of `effects`.
    pub fn by(world: &'w World<T>, rules: R, effects: E) -> Self {
        let (width, height) = (world.render.width, world.render.height);
        let lens = Lens::new(rules, &world.camera, width, height);
        Self { world, rules, lens, effects, is_proven: rules.get().is_proven() }
    }

    /// Returns the kernel that leaves out no work because of a proof, for a world that may
    /// contradict itself, such as by a matrix that is not the inverse of the other.
    #[must_use]
    pub fn without_proofs(self) -> Self {
        Self { is_proven: false, ..self }
    }

    /// Returns the light through a point of the pixel in column i from the left and row j from the
    /// top. `at` is (`dx`, `dy`), the position in the pixel from its top left corner, both from 0
    /// to 1. [rule 1]
    pub fn eye(&self, (i, j): (u32, u32), at: (T, T), watch: &mut impl Watch) -> Vec3<T> {
        self.trace(&self.eye_ray((i, j), at), Path::eye(0), watch)
    }

    fn eye_ray(&self, (i, j): (u32, u32), at: (T, T)) -> Ray<T> {
        let row =
            if self.rules.get().picture_from_top { j } else { self.world.render.height - 1 - j };
        self.lens.eye_ray(self.rules, (i, row), at)
    }

    /// Returns whether [`Kernel::eyes`] can be called, and is faster than [`Kernel::eye`].
    pub(crate) fn gains_by_packets(&self) -> bool {
        R::IS_LECTURE && self.world.gains_by_packets()
    }

    /// Calls `light` with the result of [`Kernel::eye`] at each of at most [`packet::MOST`] points,
    /// in order, by the rules of the lecture. The hits of all rays are searched for together, then
    /// shaded one after another.
    pub(crate) fn eyes<W: Watch>(
        &self,
        points: impl Iterator<Item = Point<T>>,
        watch: &mut W,
        mut light: impl FnMut(&mut W, Vec3<T>),
    ) {
        let rays: ArrayVec<Ray<T>, { packet::MOST }> =
            points.map(|(pixel, at)| self.eye_ray(pixel, at)).collect();
        for (ray, found) in rays.iter().zip(self.world.first_of_packet(&rays, watch)) {
            watch.enter(RayKind::Eye, 0, ray);
            let colour = self.light_of(ray, Path::eye(0), found, watch);
            watch.leave(colour);
            light(watch, colour);
        }
    }

    /// Returns the light along `ray`: shade + kr · trace(R) + kt · trace(T). [rule 7] [rule 8]
    pub fn trace(&self, ray: &Ray<T>, path: Path<T>, watch: &mut impl Watch) -> Vec3<T> {
        watch.enter(path.kind, path.depth, ray);
        let found = self.world.first(self.rules, ray, watch);
        let colour = self.light_of(ray, path, found, watch);
        watch.leave(colour);
        colour
    }

    /// Returns the light of a ray whose nearest hit is `found`, or the background for `None`.
    #[inline(always)]
    fn light_of(
        &self,
        ray: &Ray<T>,
        path: Path<T>,
        found: Option<(usize, ShapeHit<T>)>,
        watch: &mut impl Watch,
    ) -> Vec3<T> {
        let Some(found) = found else { return self.background(path.kind) };
        let is_smooth = self.simulates(Effect::SmoothNormals);
        let hit = self.world.hit(self.rules, ray, found, is_smooth, watch);
        self.light_at(ray, path, hit, watch)
    }

    fn light_at(
        &self,
        ray: &Ray<T>,
        path: Path<T>,
        hit: Hit<T>,
        watch: &mut impl Watch,
    ) -> Vec3<T> {
        let d = ray.direction;
        let object = &self.world.objects[hit.object];
        let material = &self.world.materials[object.material];
        let (outwards, turned, is_inside) = self.turned(d, &hit);
        let (n_geom, n_shading) = turned;
        let normal =
            if self.rules.get().turning == Turning::NotShading { outwards } else { n_shading };
        let hit_point = hit.hit_point(n_geom);
        let at =
            ShadingPoint { hit_point, normal, to_viewer: -d, is_inside, material: object.material };
        let mut colour = self.cut(Cut::Surface, self.shade(&at, path.weight, watch));
        watch.hit(|| HitRecord {
            object: &object.name,
            t: hit.t,
            point: hit.point,
            normal,
            is_inside,
            direct: colour,
        });
        if !self.goes_on(path) {
            if self.simulates(Effect::Reflection) || self.simulates(Effect::Refraction) {
                let sent_on = || self.weight_sent_on(material, is_inside, hit.t);
                if is_shallow(self.rules, path.depth, self.world.render.max_depth)
                    && sent_on() != Vec3::ZERO
                {
                    watch.did(Work::FaintPath);
                }
                watch.left_out(|| path.weight * sent_on());
            }
            return colour;
        }
        let eta = self.indices(&hit, material, is_inside, watch);
        let way_through = || optics::smooth_refract(self.rules, d, n_geom, n_shading, eta);
        let kr = self.mirror_weight(material, is_inside);
        let kr = self.by_angle(kr, -d.dot(n_shading));
        if kr.max_element() > T::ZERO {
            let r = optics::smooth_reflect(self.rules, d, n_geom, n_shading);
            let is_black = self.rules.get().total_reflection == TotalReflection::Black
                && way_through().is_none();
            if !is_black {
                colour = self.own_light(colour, Mixing::OneMinusKr, Mixing::MirrorReplaces, kr);
                let ray = Ray::spawned(self.rules, &hit_point, r);
                let kind = RayKind::Reflected;
                let leaves = Leaves { outside: !is_inside, along: r.dot(n_geom) };
                colour += kr * self.spawn(kind, &ray, path, kr, leaves, watch);
            }
        }
        if self.simulates(Effect::Refraction) && material.kt.max_element() > T::ZERO {
            let kt = self.transmit_weight(material, is_inside, hit.t);
            if let Some(t) = way_through() {
                let (own, other) = (Mixing::OneMinusKt, Mixing::GlassReplaces);
                colour = self.own_light(colour, own, other, kt);
                let ray = Ray::spawned(self.rules, &hit_point, t);
                let leaves = Leaves { outside: is_inside, along: t.dot(n_geom) };
                colour += kt * self.spawn(RayKind::Refracted, &ray, path, kt, leaves, watch);
            } else if self.rules.get().total_reflection == TotalReflection::Background {
                colour += kt * self.world.background;
            } else if self.rules.get().total_reflection == TotalReflection::MirroredByKt {
                let r = optics::smooth_reflect(self.rules, d, n_geom, n_shading);
                let ray = Ray::spawned(self.rules, &hit_point, r);
                let leaves = Leaves { outside: !is_inside, along: r.dot(n_geom) };
                colour += kt * self.spawn(RayKind::Reflected, &ray, path, kt, leaves, watch);
            }
        }
        colour
    }

    /// Returns the shading normal as stored, both normals turned against the ray, and whether the
    /// ray is inside. The pair of turned normals is (`n_geom`, `n_shading`). [rule 11] [rule 19]
    #[inline(always)]
    fn turned(&self, d: Vec3<T>, hit: &Hit<T>) -> (Vec3<T>, (Vec3<T>, Vec3<T>), bool) {
        let n_shading = hit.n_shading;
        let decides = if self.rules.get().inside_by == InsideBy::Interpolated {
            n_shading
        } else {
            hit.n_geom
        };
        let is_inside = shade::is_inside(self.rules, d, decides);
        let turns = shade::turns(self.rules, is_inside);
        (
            n_shading,
            if turns { (-hit.n_geom, -n_shading) } else { (hit.n_geom, n_shading) },
            is_inside,
        )
    }

    fn goes_on(&self, path: Path<T>) -> bool {
        goes_on(self.rules, path.depth, self.world.render.max_depth, path.weight, self.threshold())
    }

    /// Returns the threshold of adaptive depth, or 0 if no path ends because of its weight.
    fn threshold(&self) -> T {
        if self.simulates(Effect::AdaptiveDepth) {
            T::of(self.world.render.threshold)
        } else {
            T::ZERO
        }
    }

    /// Traces a ray that is spawned with `weight` and `leaves` a surface, and returns its light. A
    /// ray that contributes nothing to the pixel is not cast and returns 0. Neither is a ray cast
    /// that can only miss: it returns the background.
    fn spawn<W: Watch>(
        &self,
        kind: RayKind,
        ray: &Ray<T>,
        parent: Path<T>,
        weight: Vec3<T>,
        leaves: Leaves<T>,
        watch: &mut W,
    ) -> Vec3<T> {
        let weight = if self.rules.get().cutoff == Cutoff::LastOnly {
            weight
        } else {
            parent.weight * weight
        };
        if weight == Vec3::ZERO && !W::SEES_ALL {
            return Vec3::ZERO;
        }
        if !self.rules.get().casts_faint_rays && is_faint(self.rules, weight, self.threshold()) {
            watch.did(Work::FaintPath);
            watch.left_out(|| weight);
            return Vec3::ZERO;
        }
        if self.misses_surely::<W>(leaves) {
            watch.did(Work::SureMiss);
            return self.world.background;
        }
        let depth = parent.depth + self.rules.get().depth_step;
        if !watch.allows(depth) {
            return Vec3::ZERO;
        }
        self.cut(Cut::Spawned, self.trace(ray, Path { kind, depth, weight }, watch))
    }

    /// Returns whether a ray that leaves a surface can only miss.
    #[inline(always)]
    fn misses_surely<W: Watch>(&self, leaves: Leaves<T>) -> bool {
        let is_clear = self.world.alone.is_clear(leaves.outside, leaves.along);
        is_clear && self.is_proven && !W::SEES_ALL
    }
}
