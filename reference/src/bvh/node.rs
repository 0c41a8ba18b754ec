//! Nodes of eight boxes, and the children still to visit.

use std::ops::Range;

use arrayvec::ArrayVec;

use super::slab::TreeRay;
use crate::lanes::{Eight, LaneTests};

/// The number of children of a node.
pub(super) const WIDTH: usize = 8;
/// The greatest number of primitives in a leaf.
pub(super) const MAX_LEAF_PRIMITIVES: usize = 8;
/// The depth that no tree exceeds, see [`super::build`].
pub(super) const DEEPEST: usize = 64;

/// A node: eight boxes side by side. Lanes without a child come last; no ray enters their boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// The least x of the eight boxes, the greatest x, the least y and so on.
    planes: [Eight; 6],
    children: [Child; WIDTH],
}

/// The content of a box: a node, or primitives with consecutive numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Child(u32);

impl Child {
    /// The first node, which is the root.
    pub(super) const ROOT: Self = Self(0);
    const LEAF: u32 = 1 << 31;
    const COUNT: u32 = 28;

    /// Returns the child that is the node with this number.
    pub(super) fn of_node(node: usize) -> Self {
        assert!(
            node < 1 << 31,
            "a node number of 31 bits: trees over 2^28 primitives have fewer nodes"
        );
        Self(node as u32)
    }

    /// Returns the leaf of `count` primitives from `first` on, 1 to [`MAX_LEAF_PRIMITIVES`].
    pub(super) fn of_primitives(first: usize, count: usize) -> Self {
        assert!(
            first < 1 << Self::COUNT && (1..=MAX_LEAF_PRIMITIVES).contains(&count),
            "1 to 8 primitives, the first with a number of 28 bits"
        );
        Self(Self::LEAF | (count as u32 - 1) << Self::COUNT | first as u32)
    }

    /// Returns the child for a list of nodes that is numbered from `by` on.
    pub(super) fn moved(self, by: usize) -> Self {
        if self.0 & Self::LEAF == 0 { Self::of_node(self.0 as usize + by) } else { self }
    }

    /// Returns the primitives of a leaf; `None` for a node.
    #[inline(always)]
    pub(super) fn primitives(self) -> Option<Range<u32>> {
        let first = self.0 & ((1 << Self::COUNT) - 1);
        let count = (self.0 >> Self::COUNT & 7) + 1;
        (self.0 & Self::LEAF != 0).then_some(first..first + count)
    }

    /// Returns the number of the node, if the child is one.
    #[inline(always)]
    pub(super) fn node(self) -> usize {
        self.0 as usize
    }
}

impl Node {
    /// Returns the node of these boxes, eight at most.
    pub(super) fn of(boxes: impl IntoIterator<Item = ([f32; 3], [f32; 3], Child)>) -> Self {
        let nowhere = [f32::INFINITY, -f32::INFINITY];
        let mut node = Self {
            planes: std::array::from_fn(|plane| [nowhere[plane % 2]; WIDTH]),
            children: [Child::ROOT; WIDTH],
        };
        for (lane, (lo, hi, child)) in boxes.into_iter().enumerate() {
            for axis in 0..3 {
                (node.planes[2 * axis][lane], node.planes[2 * axis + 1][lane]) =
                    (lo[axis], hi[axis]);
            }
            node.children[lane] = child;
        }
        node
    }

    /// Returns the node for a list of nodes that is numbered from `by` on.
    pub(super) fn moved(mut self, by: usize) -> Self {
        self.children = self.children.map(|child| child.moved(by));
        self
    }

    /// Returns the nearest child that the ray enters before `reach`. Pushes the others that it
    /// enters onto the open ones, the nearest last.
    #[inline(always)]
    pub(super) fn enter<P: LaneTests>(
        &self,
        ray: &TreeRay,
        reach: f32,
        open: &mut OpenChildren,
    ) -> Option<Child> {
        let planes = ray.near.map(|near| [&self.planes[near], &self.planes[near ^ 1]]);
        let (enter, entered) = P::boxes(planes, &ray.lanes, reach);
        self.open(enter, entered, open)
    }

    /// Returns the least x of the eight boxes, the greatest x, the least y and so on.
    #[inline(always)]
    pub(super) fn planes(&self) -> &[Eight; 6] {
        &self.planes
    }

    /// Returns the children whose bits are set.
    #[inline(always)]
    pub(super) fn children(&self, mut bits: u32) -> impl Iterator<Item = Child> {
        std::iter::from_fn(move || {
            let lane = bits.trailing_zeros() as usize;
            bits &= bits.wrapping_sub(1);
            (lane < WIDTH).then(|| self.children[lane % WIDTH])
        })
    }

    /// Returns the nearest of the children with the bits `entered`, by the parameters at which they
    /// are entered. Pushes the others onto the open ones, the nearest last.
    #[inline(always)]
    pub(super) fn open(
        &self,
        enter: Eight,
        mut entered: u32,
        open: &mut OpenChildren,
    ) -> Option<Child> {
        let mut next = || {
            let lane = entered.trailing_zeros() as usize;
            entered &= entered.wrapping_sub(1);
            (lane < WIDTH).then(|| (self.children[lane % WIDTH], enter[lane % WIDTH]))
        };
        let mut nearest = next()?;
        let begin = open.0.len();
        while let Some(child) = next() {
            let farther =
                if child.1 < nearest.1 { std::mem::replace(&mut nearest, child) } else { child };
            open.insert(begin, farther);
        }
        Some(nearest.0)
    }
}

/// Gives the primitives of the leaves new numbers, so that every leaf begins at a multiple of four.
/// Returns the order by these numbers.
pub(super) fn in_fours(nodes: &mut [Node], order: &[u32]) -> Vec<u32> {
    let mut padded = Vec::with_capacity(order.len() + order.len() / 2);
    for child in nodes.iter_mut().flat_map(|node| &mut node.children) {
        if let Some(primitives) = child.primitives() {
            let primitives = primitives.start as usize..primitives.end as usize;
            *child = Child::of_primitives(padded.len(), primitives.len());
            padded.extend(&order[primitives.clone()]);
            padded.resize(padded.len().next_multiple_of(4), order[primitives.end - 1]);
        }
    }
    padded
}

/// The children still to visit, each with the τ at which the ray enters it.
pub(super) struct OpenChildren(ArrayVec<(Child, f32), { DEEPEST * (WIDTH - 1) + 1 }>);

impl OpenChildren {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self(ArrayVec::new())
    }

    /// Inserts a child among those from `begin` on, which are ordered from the farthest to the
    /// nearest.
    #[inline(always)]
    fn insert(&mut self, begin: usize, child: (Child, f32)) {
        let mut at = self.0.len();
        self.0.push(child);
        while at > begin && self.0[at - 1].1 < child.1 {
            self.0[at] = self.0[at - 1];
            at -= 1;
        }
        self.0[at] = child;
    }

    /// Pops children until one is entered before `reach`, and returns it.
    #[inline(always)]
    pub(super) fn nearest(&mut self, reach: f32) -> Option<Child> {
        while let Some((child, enter)) = self.0.pop() {
            if enter <= reach {
                return Some(child);
            }
        }
        None
    }
}
