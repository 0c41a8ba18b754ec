//! Limits on the number and the depth of rays, for any watch.

use std::sync::atomic::{AtomicU64, Ordering};

use cases::ray_tree::RayKind;

use super::work::{Tally, Work};
use super::{Book, HitRecord, Notes, Watch};
use crate::numbers::real::Real;
use crate::numbers::vec3::Vec3;
use crate::rays::ray::Ray;

/// The number of rays that a part of a picture counts for itself before it reports them, so that
/// threads rarely write to the same memory.
const BATCH: u64 = 1024;

/// The greatest number of rays that a picture may take, and the rays that were reported so far by
/// any part of it.
#[derive(Debug)]
pub struct RayBudget {
    most: u64,
    reported: AtomicU64,
}

impl RayBudget {
    /// Returns a budget of at most `most` rays of all kinds.
    pub fn new(most: u64) -> Self {
        Self { most, reported: AtomicU64::new(0) }
    }

    /// Returns whether more rays were reported than the budget allows.
    #[inline(always)]
    pub fn is_exceeded(&self) -> bool {
        self.reported.load(Ordering::Relaxed) > self.most
    }

    fn report(&self, n_rays: u64) {
        self.reported.fetch_add(n_rays, Ordering::Relaxed);
    }
}

/// A watch that spawns no more rays once a budget is exceeded, or beyond a depth. Colours that
/// lack such rays are of no use.
///
/// Rays are reported in batches. Whether the budget is exceeded is therefore exact, and the same
/// with any number of threads, only after [`Metered::settled`].
#[derive(Clone, Copy, Debug)]
pub struct Metered<'a, W> {
    watch: W,
    budget: Option<&'a RayBudget>,
    unreported: u64,
    deepest: u32,
}

impl<'a, W> Metered<'a, W> {
    /// Returns a watch that reports its rays to `budget`, if there is one.
    pub fn new(watch: W, budget: Option<&'a RayBudget>) -> Self {
        Self { watch, budget, unreported: 0, deepest: u32::MAX }
    }

    /// Returns the watch, limited to rays of depth `deepest` or less.
    #[must_use]
    pub fn to_depth(self, deepest: u32) -> Self {
        Self { deepest, ..self }
    }

    /// Reports all rays, and returns the watch within.
    pub fn settled(mut self) -> W {
        self.report();
        self.watch
    }

    #[inline(always)]
    fn count(&mut self) {
        self.unreported += 1;
        if self.unreported == BATCH {
            self.report();
        }
    }

    fn report(&mut self) {
        if let Some(budget) = self.budget {
            budget.report(self.unreported);
        }
        self.unreported = 0;
    }
}

impl<W: Default> Default for Metered<'_, W> {
    fn default() -> Self {
        Self::new(W::default(), None)
    }
}

impl<W: Tally> Tally for Metered<'_, W> {
    #[inline(always)]
    fn did(&mut self, work: Work) {
        self.watch.did(work);
    }
}

impl<W: Watch> Watch for Metered<'_, W> {
    const SEES_ALL: bool = W::SEES_ALL;

    #[inline(always)]
    fn enter<T: Real>(&mut self, kind: RayKind, depth: u32, ray: &Ray<T>) {
        self.count();
        self.watch.enter(kind, depth, ray);
    }

    #[inline(always)]
    fn hit<'a, T: Real>(&mut self, hit: impl FnOnce() -> HitRecord<'a, T>) {
        self.watch.hit(hit);
    }

    #[inline(always)]
    fn leave<T: Real>(&mut self, colour: Vec3<T>) {
        self.watch.leave(colour);
    }

    #[inline(always)]
    fn shadow_ray(&mut self) {
        self.count();
        self.watch.shadow_ray();
    }

    #[inline(always)]
    fn allows(&self, depth: u32) -> bool {
        depth <= self.deepest
            && !self.budget.is_some_and(RayBudget::is_exceeded)
            && self.watch.allows(depth)
    }

    #[inline(always)]
    fn left_out<T: Real>(&mut self, weight: impl FnOnce() -> Vec3<T>) {
        self.watch.left_out(weight);
    }

    #[inline(always)]
    fn faint_light<T: Real>(&mut self, light: impl FnOnce() -> Vec3<T>) {
        self.watch.faint_light(light);
    }
}

impl<B: Book> Book for Metered<'_, B> {
    #[inline(always)]
    fn notes(&mut self) -> &mut Notes {
        self.watch.notes()
    }

    fn plus(self, other: Self) -> Self {
        let unreported = self.unreported + other.unreported;
        Self { watch: self.watch.plus(other.watch), unreported, ..self }
    }
}
