//! Who looks on while rays are traced: counters for `--stats`, a recorder for `explain`.

use cases::Effect;
use cases::glam::DVec3;
use cases::ray_tree::{self, RayKind};
use serde::Serialize;

use crate::ray::Ray;
use crate::real::Real;
use crate::vec3::Vec3;
use crate::work::{Amounts, Tally, Work};

/// What a ray met.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "as in `cases::ray_tree::Met`")]
pub struct Met<'a, T> {
    pub object: &'a str,
    pub t: T,
    pub point: Vec3<T>,
    pub normal: Vec3<T>,
    pub is_inside: bool,
    pub direct: Vec3<T>,
}

/// Is told of every ray, and of the work that rays make.
pub trait Watch: Tally {
    /// Whether it wants to see every ray that the rules cast, also one that cannot change the
    /// pixel.
    const SEES_ALL: bool = false;
    /// A ray is about to be traced.
    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>);
    /// It met something; `met` is called by those who want to know what.
    fn met<'a, T: Real>(&mut self, met: impl FnOnce() -> Met<'a, T>);
    /// It brought back this colour.
    fn leave<T: Real>(&mut self, colour: Vec3<T>);
    /// A shadow ray is cast.
    fn shadow_ray(&mut self);
    /// Rays are left out for depth or weight, which together would have had this weight at most.
    /// [rule 13]
    #[inline(always)]
    fn left_out<T: Real>(&mut self, _weight: impl FnOnce() -> Vec3<T>) {}
    /// The light of a lamp is not followed, which would have brought the pixel this much at most.
    #[inline(always)]
    fn faint_light<T: Real>(&mut self, _light: impl FnOnce() -> Vec3<T>) {}
}

/// Rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// From the eye.
    pub eye: u64,
    /// Towards a light.
    pub shadow: u64,
    /// Mirrored.
    pub reflected: u64,
    /// Transmitted.
    pub refracted: u64,
}

impl Counts {
    /// The sums.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            eye: self.eye + other.eye,
            shadow: self.shadow + other.shadow,
            reflected: self.reflected + other.reflected,
            refracted: self.refracted + other.refracted,
        }
    }

    /// All rays.
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
    fn met<'a, T: Real>(&mut self, _met: impl FnOnce() -> Met<'a, T>) {}

    #[inline(always)]
    fn leave<T: Real>(&mut self, _colour: Vec3<T>) {}

    #[inline(always)]
    fn shadow_ray(&mut self) {
        self.shadow += 1;
    }
}

/// What is noted of a picture while it is rendered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Notes {
    /// Rays by kind.
    pub rays: Counts,
    /// Weight of the rays that the pixel at hand has left out so far, channel by channel, all its
    /// rays together.
    open: DVec3,
    /// The greatest weight left out in any pixel, the mean over its rays, channel by channel.
    pub left_out: DVec3,
    /// Light of lamps that the pixel at hand has not followed so far, all its rays together.
    open_light: DVec3,
    /// The most light of lamps that was not followed in any pixel, the mean over its rays, channel
    /// by channel.
    pub faint_light: DVec3,
}

impl Notes {
    /// The pixel at hand is done, with so many rays from the eye; returns the weight that it has
    /// left out.
    #[inline(always)]
    pub fn end_pixel(&mut self, n_rays: f64) -> DVec3 {
        let left_out = self.open / n_rays;
        (self.left_out, self.open) = (self.left_out.max(left_out), DVec3::ZERO);
        (self.faint_light, self.open_light) =
            (self.faint_light.max(self.open_light / n_rays), DVec3::ZERO);
        left_out
    }

    /// Those of both parts of a picture.
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
    fn met<'a, T: Real>(&mut self, _met: impl FnOnce() -> Met<'a, T>) {}

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

/// A watch over a part of a picture.
pub trait Book: Watch + Default + Send {
    /// The notes.
    fn notes(&mut self) -> &mut Notes;
    /// The book of both parts.
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

/// The notes, and all the work besides: what `--stats` shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// As of any picture.
    pub notes: Notes,
    /// How often each piece of work was done.
    pub work: Amounts,
}

/// What `effect` has made: how many rays or pieces of work, and what they are called.
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
    fn met<'a, T: Real>(&mut self, _met: impl FnOnce() -> Met<'a, T>) {}

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

/// Hands everything to [`cases::ray_tree`], within [`ray_tree::record`].
#[derive(Clone, Copy, Debug)]
pub struct Recorder;

impl Tally for Recorder {}

impl Watch for Recorder {
    const SEES_ALL: bool = true;

    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>) {
        let (origin, direction) = (ray.origin.f64(), ray.direction.f64());
        ray_tree::enter(kind, depth, &cases::Ray::new(origin, direction));
    }

    fn met<'a, T: Real>(&mut self, met: impl FnOnce() -> Met<'a, T>) {
        let met = met();
        ray_tree::hit(|| ray_tree::Met {
            object: met.object.to_owned(),
            t: met.t.f64(),
            point: met.point.f64(),
            normal: met.normal.f64(),
            inside: met.is_inside,
            direct: met.direct.f64(),
        });
    }

    fn leave<T: Real>(&mut self, colour: Vec3<T>) {
        ray_tree::leave(colour.f64());
    }

    fn shadow_ray(&mut self) {}
}
