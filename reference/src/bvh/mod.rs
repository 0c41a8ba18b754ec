//! A tree of boxes over numbered things, known by their bounds alone.
//!
//! Boxes only prune: what they leave is asked in full precision by whoever walks, so that a walk finds what a scan of the whole list finds,
//! bit for bit, on every machine. `slab` says why no box hides a hit.

mod build;
mod lanes;
mod node;
mod slab;

use crate::bounds::Bounds;
use crate::ray::Ray;
use crate::real::Real;
pub use lanes::Lanes;
use lanes::{Test, Work};
use node::{Child, Node};
use slab::{Slab, Space};

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
pub struct Bvh<T> {
    nodes: Vec<Node>,
    space: Space<T>,
    loss: T,
    lanes: Lanes,
}

impl<T: Real> Bvh<T> {
    /// The tree over `bounds.len()` things, and the order in which it numbers them: its thing n is the one with `bounds[order[n]]`. Split where the
    /// surface-area heuristic finds it cheapest, on all threads of the current `rayon` pool; the same bounds give the same tree on any number of them.
    pub fn build(bounds: &[Bounds<T>]) -> (Self, Vec<u32>) {
        let space = Space::of(bounds);
        let (nodes, order) = build::build(bounds, &space);
        (Self { nodes, space, loss: T::ONE, lanes: Lanes::best() }, order)
    }

    /// Bytes it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// The tree over things that are asked in frames of their own, on the way to which roundings grow by up to this factor, 1 or more.
    pub fn with_loss(self, loss: T) -> Self {
        Self { loss, ..self }
    }

    /// The tree walked by other instructions, which finds the same by the same steps.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        Self { lanes, ..self }
    }

    /// Has `visitor` visit every thing whose box the ray enters before the limit, nearer boxes first.
    #[inline]
    pub fn walk<Y: Tally>(&self, ray: &Ray<T>, tally: &mut Y, visitor: impl Visit<T, Y>) {
        if !self.nodes.is_empty() {
            self.lanes.run(Walk { tree: self, ray, tally, visitor });
        }
    }
}

/// Visits things by their numbers.
pub trait Visit<T, Y> {
    /// Visits a thing; gets the limit before which something may still be met, and returns the new one: a lower one where it has met something, −∞ to
    /// end the walk.
    fn visit(&mut self, tally: &mut Y, thing: u32, limit: T) -> T;
}

impl<T, Y, F: FnMut(&mut Y, u32, T) -> T> Visit<T, Y> for F {
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, thing: u32, limit: T) -> T {
        self(tally, thing, limit)
    }
}

struct Walk<'a, T, Y, V> {
    tree: &'a Bvh<T>,
    ray: &'a Ray<T>,
    tally: &'a mut Y,
    visitor: V,
}

impl<T: Real, Y: Tally, V: Visit<T, Y>> Work for Walk<'_, T, Y, V> {
    #[inline(always)]
    fn run<P: Test>(self) {
        let Self { tree, ray, tally, mut visitor } = self;
        let Some(slab) = Slab::new(ray, &tree.space, tree.loss) else { return };
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
                    for thing in things {
                        tally.thing();
                        limit = visitor.visit(tally, thing, limit);
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
