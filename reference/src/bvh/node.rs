//! A node of eight boxes, and the children still to visit.

use std::ops::Range;

use arrayvec::ArrayVec;

use super::lanes::{Eight, Test};
use super::slab::Slab;

/// Children of a node.
pub(super) const WIDTH: usize = 8;
/// At most this many things a leaf.
pub(super) const MOST_THINGS: usize = 8;
/// Deeper than this no tree gets, see [`super::build`].
pub(super) const DEEPEST: usize = 64;

/// A node: eight lanes of boxes, lanes without a child last, with planes that no ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Least x of the eight, greatest x, least y and so on.
    planes: [Eight; 6],
    children: [Child; WIDTH],
}

/// What a box holds: a node, or things that are numbered one after another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Child(u32);

impl Child {
    /// The first node.
    pub(super) const ROOT: Self = Self(0);
    const LEAF: u32 = 1 << 31;
    const COUNT: u32 = 28;

    /// A node by its number.
    pub(super) fn of_node(node: usize) -> Self {
        assert!(
            node < 1 << 31,
            "a node number of 31 bits: trees over 2^28 things have fewer nodes"
        );
        Self(node as u32)
    }

    /// `count` things from `first` on, 1 to [`MOST_THINGS`].
    pub(super) fn of_things(first: usize, count: usize) -> Self {
        assert!(
            first < 1 << Self::COUNT && (1..=MOST_THINGS).contains(&count),
            "things of a number of 28 bits"
        );
        Self(Self::LEAF | (count as u32 - 1) << Self::COUNT | first as u32)
    }

    /// The same where all nodes are numbered from `by` on.
    pub(super) fn moved(self, by: usize) -> Self {
        if self.0 & Self::LEAF == 0 { Self::of_node(self.0 as usize + by) } else { self }
    }

    /// The things of a leaf; `None` for a node.
    #[inline(always)]
    pub(super) fn things(self) -> Option<Range<u32>> {
        let first = self.0 & ((1 << Self::COUNT) - 1);
        let count = (self.0 >> Self::COUNT & 7) + 1;
        (self.0 & Self::LEAF != 0).then_some(first..first + count)
    }

    /// Its number, if it is a node.
    #[inline(always)]
    pub(super) fn node(self) -> usize {
        self.0 as usize
    }
}

impl Node {
    /// The node of these boxes, eight at most.
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

    /// The same where all nodes are numbered from `by` on.
    pub(super) fn moved(mut self, by: usize) -> Self {
        self.children = self.children.map(|child| child.moved(by));
        self
    }

    /// The nearest child that the ray enters before `reach`; the others that it enters are put
    /// among the open ones, the nearest last.
    #[inline(always)]
    pub(super) fn enter<P: Test>(&self, ray: &Slab, reach: f32, open: &mut Open) -> Option<Child> {
        let planes = ray.near.map(|near| [&self.planes[near], &self.planes[near ^ 1]]);
        let (enter, entered) = P::boxes(planes, ray, reach);
        self.open(enter, entered, open)
    }

    /// Least x of the eight boxes, greatest x, least y and so on.
    #[inline(always)]
    pub(super) fn planes(&self) -> &[Eight; 6] {
        &self.planes
    }

    /// The children with these bits.
    #[inline(always)]
    pub(super) fn children(&self, mut bits: u32) -> impl Iterator<Item = Child> {
        std::iter::from_fn(move || {
            let lane = bits.trailing_zeros() as usize;
            bits &= bits.wrapping_sub(1);
            (lane < WIDTH).then(|| self.children[lane % WIDTH])
        })
    }

    /// The nearest of the children with the bits `entered`, by where they are entered; the others
    /// are put among the open ones, the nearest last.
    #[inline(always)]
    pub(super) fn open(&self, enter: Eight, mut entered: u32, open: &mut Open) -> Option<Child> {
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

/// Has every leaf begin at a multiple of four: gives the things of the leaves new numbers, and
/// their order by these.
pub(super) fn in_fours(nodes: &mut [Node], order: &[u32]) -> Vec<u32> {
    let mut padded = Vec::with_capacity(order.len() + order.len() / 2);
    for child in nodes.iter_mut().flat_map(|node| &mut node.children) {
        if let Some(things) = child.things() {
            let things = things.start as usize..things.end as usize;
            *child = Child::of_things(padded.len(), things.len());
            padded.extend(&order[things.clone()]);
            padded.resize(padded.len().next_multiple_of(4), order[things.end - 1]);
        }
    }
    padded
}

/// Children still to visit, each with the τ at which the ray enters it.
pub(super) struct Open(ArrayVec<(Child, f32), { DEEPEST * (WIDTH - 1) + 1 }>);

impl Open {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self(ArrayVec::new())
    }

    /// Puts a child among those from `begin` on, which come farthest first.
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

    /// Takes the child put last that is entered before `reach`.
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
