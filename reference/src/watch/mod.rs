//! Watches are called for every ray during tracing: counters for `--stats`, a recorder for
//! `explain`.

pub mod metered;
pub mod work;

use cases::Effect;
use cases::glam::DVec3;
use cases::ray_tree::{self, RayKind};
use serde::Serialize;

use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;
use crate::watch::work::{Amounts, Tally, Work};

/// The hit of a traced ray.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the fields of `cases::ray_tree::Met`")]
pub struct HitRecord<'a, T> {
    pub object: &'a str,
    pub t: T,
    pub point: Vec3<T>,
    pub normal: Vec3<T>,
    pub is_inside: bool,
    pub direct: Vec3<T>,
}

/// A watch, which is called for every ray and for the work that rays cause.
pub trait Watch: Tally {
    /// Whether every ray that the rules cast is traced, even one that cannot change the pixel.
    const SEES_ALL: bool = false;
    /// Called before a ray is traced.
    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>);
    /// Called if the ray hits an object. A watch that needs the hit calls `hit`.
    fn hit<'a, T: Real>(&mut self, hit: impl FnOnce() -> HitRecord<'a, T>);
    /// Called with the colour that the ray returns.
    fn leave<T: Real>(&mut self, colour: Vec3<T>);
    /// Called for every shadow ray.
    fn shadow_ray(&mut self);
    /// Returns whether rays of this depth may be spawned. If not, the picture will not be used.
    #[inline(always)]
    fn allows(&self, _depth: u32) -> bool {
        true
    }
    /// Called if rays are left out for depth or weight. `weight` returns the largest total weight
    /// that they could have had. [rule 13]
    #[inline(always)]
    fn left_out<T: Real>(&mut self, _weight: impl FnOnce() -> Vec3<T>) {}
    /// Called if a light is skipped as too weak. `light` returns the most that it could have added
    /// to the pixel.
    #[inline(always)]
    fn faint_light<T: Real>(&mut self, _light: impl FnOnce() -> Vec3<T>) {}
}

/// Numbers of rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rays from the eye.
    pub eye: u64,
    /// Rays towards a light.
    pub shadow: u64,
    /// Reflected rays.
    pub reflected: u64,
    /// Refracted rays.
    pub refracted: u64,
}

impl Counts {
    /// Returns the sums of both counts.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            eye: self.eye + other.eye,
            shadow: self.shadow + other.shadow,
            reflected: self.reflected + other.reflected,
            refracted: self.refracted + other.refracted,
        }
    }

    /// Returns the number of all rays.
    pub fn total(self) -> u64 {
        self.eye + self.shadow + self.reflected + self.refracted
    }
}

impl Tally for Counts {}

impl Watch for Counts {
    #[inline(always)]
    fn enter<T: Real>(&mut self, kind: RayKind, _depth: u32, _ray: &Ray<T>) {
        match kind {
            RayKind::Eye => self.eye += 1,
            RayKind::Reflected => self.reflected += 1,
            RayKind::Refracted => self.refracted += 1,
        }
    }

    #[inline(always)]
    fn hit<'a, T: Real>(&mut self, _hit: impl FnOnce() -> HitRecord<'a, T>) {}

    #[inline(always)]
    fn leave<T: Real>(&mut self, _colour: Vec3<T>) {}

    #[inline(always)]
    fn shadow_ray(&mut self) {
        self.shadow += 1;
    }
}

/// The figures of a picture, collected while it is rendered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Notes {
    /// Rays by kind.
    pub rays: Counts,
    /// The weight of the rays that the current pixel has left out so far, channel by channel,
    /// summed over the pixel's eye rays.
    open: DVec3,
    /// The greatest weight left out in any pixel, the mean over its eye rays, channel by channel.
    pub left_out: DVec3,
    /// The light that the current pixel has skipped as too weak so far, summed over the pixel's eye
    /// rays.
    open_light: DVec3,
    /// The most light skipped in any pixel, the mean over its eye rays, channel by channel.
    pub faint_light: DVec3,
}

impl Notes {
    /// Ends the current pixel, which had `n_rays` eye rays. Returns the weight that it left out,
    /// the mean over these rays.
    #[inline(always)]
    pub fn end_pixel(&mut self, n_rays: f64) -> DVec3 {
        let left_out = self.open / n_rays;
        (self.left_out, self.open) = (self.left_out.max(left_out), DVec3::ZERO);
        (self.faint_light, self.open_light) =
            (self.faint_light.max(self.open_light / n_rays), DVec3::ZERO);
        left_out
    }

    /// Returns the figures of a picture from those of two parts of it.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            rays: self.rays.plus(other.rays),
            left_out: self.left_out.max(other.left_out),
            faint_light: self.faint_light.max(other.faint_light),
            ..Self::default()
        }
    }
}

impl Tally for Notes {}

impl Watch for Notes {
    #[inline(always)]
    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>) {
        self.rays.enter(kind, depth, ray);
    }

    #[inline(always)]
    fn hit<'a, T: Real>(&mut self, _hit: impl FnOnce() -> HitRecord<'a, T>) {}

    #[inline(always)]
    fn leave<T: Real>(&mut self, _colour: Vec3<T>) {}

    #[inline(always)]
    fn shadow_ray(&mut self) {
        self.rays.shadow += 1;
    }

    #[inline(always)]
    fn left_out<T: Real>(&mut self, weight: impl FnOnce() -> Vec3<T>) {
        self.open += weight().f64();
    }

    #[inline(always)]
    fn faint_light<T: Real>(&mut self, light: impl FnOnce() -> Vec3<T>) {
        self.open_light += light().f64();
    }
}

/// A watch over one part of a picture. The books of two parts can be merged.
pub trait Book: Watch + Copy + Default + Send + Sync {
    /// Returns the figures collected so far.
    fn notes(&mut self) -> &mut Notes;
    /// Returns the book of both parts.
    #[must_use]
    fn plus(self, other: Self) -> Self;
}

impl Book for Notes {
    #[inline(always)]
    fn notes(&mut self) -> &mut Notes {
        self
    }

    fn plus(self, other: Self) -> Self {
        Self::plus(self, other)
    }
}

/// The figures of a picture and counts of all work, as `--stats` shows them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// The figures that are collected for every picture.
    pub notes: Notes,
    /// Counts of work, by kind.
    pub work: Amounts,
}

/// Returns how many rays or units of work `effect` has caused, and their name.
pub fn made_by(effect: Effect, rays: &Counts, work: &Amounts) -> (u64, &'static str) {
    match effect {
        Effect::Shadows => (rays.shadow, "shadow rays"),
        Effect::Reflection => (rays.reflected, "reflected rays"),
        Effect::Refraction => (rays.refracted, "refracted rays"),
        Effect::TintedShadows => (work.tinted_crossings, Work::TintedCrossing.name()),
        Effect::SmoothNormals => (work.smooth_normals, Work::SmoothNormal.name()),
        Effect::Transforms => (work.moved_rays, Work::MovedRay.name()),
        Effect::Attenuation => (work.attenuations, Work::Attenuation.name()),
        Effect::AdaptiveDepth => (work.faint_paths, Work::FaintPath.name()),
    }
}

impl Book for Ledger {
    #[inline(always)]
    fn notes(&mut self) -> &mut Notes {
        &mut self.notes
    }

    fn plus(self, other: Self) -> Self {
        Self { notes: self.notes.plus(other.notes), work: self.work.plus(other.work) }
    }
}

impl Tally for Ledger {
    #[inline(always)]
    fn did(&mut self, work: Work) {
        self.work.did(work);
    }
}

impl Watch for Ledger {
    #[inline(always)]
    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>) {
        self.notes.enter(kind, depth, ray);
    }

    #[inline(always)]
    fn hit<'a, T: Real>(&mut self, _hit: impl FnOnce() -> HitRecord<'a, T>) {}

    #[inline(always)]
    fn leave<T: Real>(&mut self, _colour: Vec3<T>) {}

    #[inline(always)]
    fn shadow_ray(&mut self) {
        self.notes.shadow_ray();
    }

    #[inline(always)]
    fn left_out<T: Real>(&mut self, weight: impl FnOnce() -> Vec3<T>) {
        self.notes.left_out(weight);
    }

    #[inline(always)]
    fn faint_light<T: Real>(&mut self, light: impl FnOnce() -> Vec3<T>) {
        self.notes.faint_light(light);
    }
}

/// Records rays and hits in the tree of [`cases::ray_tree`], within [`ray_tree::record`].
#[derive(Clone, Copy, Debug)]
pub struct Recorder;

impl Tally for Recorder {}

impl Watch for Recorder {
    const SEES_ALL: bool = true;

    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>) {
        let (origin, direction) = (ray.origin.f64(), ray.direction.f64());
        ray_tree::enter(kind, depth, &cases::Ray::new(origin, direction));
    }

    fn hit<'a, T: Real>(&mut self, hit: impl FnOnce() -> HitRecord<'a, T>) {
        let hit = hit();
        ray_tree::hit(|| ray_tree::Met {
            object: hit.object.to_owned(),
            t: hit.t.f64(),
            point: hit.point.f64(),
            normal: hit.normal.f64(),
            inside: hit.is_inside,
            direct: hit.direct.f64(),
        });
    }

    fn leave<T: Real>(&mut self, colour: Vec3<T>) {
        ray_tree::leave(colour.f64());
    }

    fn shadow_ray(&mut self) {}
}
