//! A bounding volume hierarchy over numbered primitives, of which it knows only the bounds.
//!
//! Boxes only prune: the visitor of a walk tests the primitives that are left in full precision. A
//! walk therefore finds what a scan of the whole list finds, bit for bit, on every machine. `slab`
//! says why no box hides a hit.

mod build;
mod frustum;
mod item;
mod node;
mod slab;

use std::ops::Range;

use crate::lanes::{LaneTask, LaneTests, Lanes};
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::rays::ray::Ray;
pub(crate) use frustum::{Pyramid, VisitPacket};
use node::{Child, Node};
use slab::{Space, TreeRay};

/// The structure that is searched for hits; both give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Search {
    /// Trees of boxes.
    #[default]
    Tree,
    /// Whole lists, one primitive after another: slow, but obviously correct.
    Scan,
}

/// A counter of the work that a search does; `()` counts nothing.
pub trait VisitCounter {
    /// Counts the visit of a node of a tree.
    fn node(&mut self);
    /// Counts the intersection test of a primitive: an object, or a triangle of a mesh.
    fn primitive(&mut self);
}

impl VisitCounter for () {
    #[inline(always)]
    fn node(&mut self) {}

    #[inline(always)]
    fn primitive(&mut self) {}
}

/// A bounding volume hierarchy with eight children per node.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    space: Space,
    lanes: Lanes,
}

impl Bvh {
    /// Builds the tree over `bounds.len()` primitives. Also returns the order in which the tree
    /// numbers them: primitive n of the tree has `bounds[order[n]]`.
    ///
    /// Ranges are split where the surface-area heuristic is cheapest, on all threads of the current
    /// `rayon` pool. The same bounds give the same tree on any number of threads. Without bounds
    /// the tree is empty.
    ///
    /// ```
    /// use reference::{bvh::Bvh, numbers::bounds::Bounds, numbers::vec3::Vec3};
    ///
    /// let segment = |x| Bounds::around([Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 0.0, 0.0)]);
    /// let (tree, order) = Bvh::build(&[segment(0.0), segment(2.0)]);
    /// assert_eq!(order.len(), 2);
    /// // one node: 8 lanes of 6 planes and 1 child of 4 bytes each are 224 bytes, aligned to 64
    /// assert_eq!(tree.bytes(), 256);
    /// ```
    ///
    /// # Panics
    /// Panics if a leaf would begin at the number 2²⁸ or above.
    pub fn build<T: Real>(bounds: &[Bounds<T>]) -> (Self, Vec<u32>) {
        let space = Space::of(bounds);
        let build::Built { nodes, order, .. } = build::build(bounds, &space, 1);
        (Self { nodes, space, lanes: Lanes::best() }, order)
    }

    /// Like [`Bvh::build`], for primitives that are tested four at a time. Every leaf holds at most
    /// four primitives and starts at a multiple of four.
    ///
    /// Numbers between leaves are never visited; in the order, the last primitive before them is
    /// repeated for them. The last list holds the indices into `bounds` of all primitives that
    /// share their box with four others or more: a tree cannot separate these.
    ///
    /// # Panics
    /// Panics if a leaf would begin at the number 2²⁸ or above.
    pub fn build_in_fours<T: Real>(bounds: &[Bounds<T>]) -> (Self, Vec<u32>, Vec<u32>) {
        let space = Space::of(bounds);
        let build::Built { mut nodes, order, crowd } = build::build(bounds, &space, 4);
        let order = node::in_fours(&mut nodes, &order);
        (Self { nodes, space, lanes: Lanes::best() }, order, crowd)
    }

    /// Returns the bytes that the nodes take.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// Returns the tree for primitives that are tested in frames of their own. On the way to these
    /// frames, rounding errors grow by up to the factor `loss`, 1 or more.
    pub fn with_loss(self, loss: f64) -> Self {
        Self { space: self.space.with_loss(loss), ..self }
    }

    /// Returns the tree, walked with another instruction set: the same steps find the same hits.
    pub fn with_lanes(self, lanes: Lanes) -> Self {
        Self { lanes, ..self }
    }

    /// Calls `visitor` for every primitive whose box the ray enters before the limit, nearer boxes
    /// first.
    #[inline]
    pub(crate) fn walk<T: Real, Y: VisitCounter>(
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

/// A visitor of primitives, by their numbers.
pub(crate) trait Visit<T, Y> {
    /// Visits a primitive, and returns the new limit.
    ///
    /// Only a hit before `limit` can still count. The visitor returns a lower limit after a hit,
    /// and −∞ to end the walk.
    fn visit(&mut self, tally: &mut Y, primitive: u32, limit: T) -> T;

    /// Returns a bit for each primitive of a leaf that is to be visited. The others are known at
    /// once to change nothing.
    #[inline(always)]
    fn left<P: LaneTests>(&mut self, primitives: &Range<u32>) -> u32 {
        (1 << primitives.len()) - 1
    }
}

impl<T, Y, F: FnMut(&mut Y, u32, T) -> T> Visit<T, Y> for F {
    #[inline(always)]
    fn visit(&mut self, tally: &mut Y, primitive: u32, limit: T) -> T {
        self(tally, primitive, limit)
    }
}

struct Walk<'a, T, Y, V> {
    tree: &'a Bvh,
    ray: &'a Ray<T>,
    tally: &'a mut Y,
    visitor: V,
}

impl<T: Real, Y: VisitCounter, V: Visit<T, Y>> LaneTask for Walk<'_, T, Y, V> {
    #[inline(always)]
    fn run<P: LaneTests>(self) {
        let Self { tree, ray, tally, mut visitor } = self;
        let Some(slab) = TreeRay::new(ray, &tree.space) else { return };
        let (mut limit, mut reach) = (ray.t_max, slab.reach(ray.t_max));
        let mut open = node::OpenChildren::new();
        let mut at = Child::ROOT;
        loop {
            let nearest = match at.primitives() {
                None => {
                    tally.node();
                    tree.nodes[at.node()].enter::<P>(&slab, reach, &mut open)
                }
                Some(primitives) => {
                    primitives.clone().for_each(|_| tally.primitive());
                    let mut left = visitor.left::<P>(&primitives);
                    while left != 0 {
                        limit =
                            visitor.visit(tally, primitives.start + left.trailing_zeros(), limit);
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
