//! A tree of boxes over numbered things, known by their bounds alone.
//!
//! Boxes only prune: what they leave is asked in full precision by whoever walks, so that a walk
//! finds what a scan of the whole list finds, bit for bit, on every machine. `slab` says why no box
//! hides a hit.

mod build;
mod frustum;
mod item;
mod lanes;
mod node;
mod slab;

use std::ops::Range;

use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::Real;
pub(crate) use frustum::VisitTogether;
pub use lanes::Lanes;
use lanes::Work;
pub(crate) use lanes::{Across, Four, Test};
use node::{Child, Node};
use slab::{Slab, Space};

/// What the nearest hit is sought in; both ways give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Search {
    /// Trees of boxes.
    #[default]
    Tree,
    /// Whole lists, one thing after another: the obvious truth.
    Scan,
}

/// Is told of the work that a search does; `()` counts nothing.
pub trait Tally {
    /// A node of a tree is visited.
    fn node(&mut self);
    /// A thing is asked where the ray meets it: an object, or a triangle of a mesh.
    fn thing(&mut self);
}

impl Tally for () {
    #[inline(always)]
    fn node(&mut self) {}

    #[inline(always)]
    fn thing(&mut self) {}
}

/// The tree, eight children a node.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    space: Space,
    lanes: Lanes,
}

impl Bvh {
    /// The tree over `bounds.len()` things, and the order in which it numbers them: its thing n is
    /// the one with `bounds[order[n]]`. Split where the surface-area heuristic finds it cheapest,
    /// on all threads of the current `rayon` pool; the same bounds give the same tree on any number
    /// of them.
    pub fn build<T: Real>(bounds: &[Bounds<T>]) -> (Self, Vec<u32>) {
        let space = Space::of(bounds);
        let build::Built { nodes, order, .. } = build::build(bounds, &space, 1);
        (Self { nodes, space, lanes: Lanes::best() }, order)
    }

    /// The same tree over things that are tested four at a time, with leaves of up to four things.
    ///
    /// Leaves are numbered from a multiple of four on. Numbers between leaves are never visited; in
    /// the order the last thing before them stands for them. The last list holds the numbers of all
    /// things that share their box with four others or more: a tree cannot tell these apart.
    pub fn build_in_fours<T: Real>(bounds: &[Bounds<T>]) -> (Self, Vec<u32>, Vec<u32>) {
        let space = Space::of(bounds);
        let build::Built { mut nodes, order, crowd } = build::build(bounds, &space, 4);
        let order = node::in_fours(&mut nodes, &order);
        (Self { nodes, space, lanes: Lanes::best() }, order, crowd)
    }

    /// Bytes it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// The tree over things that are asked in frames of their own, on the way to which roundings
    /// grow by up to this factor, 1 or more.
    pub fn with_loss(self, loss: f64) -> Self {
        Self { space: self.space.with_loss(loss), ..self }
    }

    /// The tree walked by other instructions, which finds the same by the same steps.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        Self { lanes, ..self }
    }

    /// Has `visitor` visit every thing whose box the ray enters before the limit, nearer boxes
    /// first.
    #[inline]
    pub(crate) fn walk<T: Real, Y: Tally>(
        &self,
        ray: &Ray<T>,
        tally: &mut Y,
        visitor: impl Visit<T, Y>,
    ) {
        if !self.nodes.is_empty() {
            self.lanes.run(Walk { tree: self, ray, tally, visitor });
        }
    }
}

/// Visits things by their numbers.
pub(crate) trait Visit<T, Y> {
    /// Visits a thing; gets the limit before which something may still be met, and returns the new
    /// one: a lower one where it has met something, −∞ to end the walk.
    fn visit(&mut self, tally: &mut Y, thing: u32, limit: T) -> T;

    /// A bit for each thing of a leaf, all but those of which it is known at once that visiting
    /// them would change nothing.
    #[inline(always)]
    fn left<P: Test>(&mut self, things: &Range<u32>) -> u32 {
        (1 << things.len()) - 1
    }
}

impl<T, Y, F: FnMut(&mut Y, u32, T) -> T> Visit<T, Y> for F {
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, thing: u32, limit: T) -> T {
        self(tally, thing, limit)
    }
}

struct Walk<'a, T, Y, V> {
    tree: &'a Bvh,
    ray: &'a Ray<T>,
    tally: &'a mut Y,
    visitor: V,
}

impl<T: Real, Y: Tally, V: Visit<T, Y>> Work for Walk<'_, T, Y, V> {
    #[inline(always)]
    fn run<P: Test>(self) {
        let Self { tree, ray, tally, mut visitor } = self;
        let Some(slab) = Slab::new(ray, &tree.space) else { return };
        let (mut limit, mut reach) = (ray.t_max, slab.reach(ray.t_max));
        let mut open = node::Open::new();
        let mut at = Child::ROOT;
        loop {
            let nearest = match at.things() {
                None => {
                    tally.node();
                    tree.nodes[at.node()].enter::<P>(&slab, reach, &mut open)
                }
                Some(things) => {
                    things.clone().for_each(|_| tally.thing());
                    let mut left = visitor.left::<P>(&things);
                    while left != 0 {
                        limit = visitor.visit(tally, things.start + left.trailing_zeros(), limit);
                        left &= left - 1;
                    }
                    if limit == -T::INFINITY {
                        return;
                    }
                    reach = slab.reach(limit);
                    None
                }
            };
            match nearest.or_else(|| open.nearest(reach)) {
                Some(child) => at = child,
                None => return,
            }
        }
    }
}
