//! Primitives as the build of a tree sees them: their boxes, and the boxes around several of them.

use std::cmp::Ordering;

/// The box around some primitives, by its corners. The fourth number of each fills the register.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub lo: [f32; 4],
    pub hi: [f32; 4],
}

impl Span {
    pub(super) const EMPTY: Self = Self { lo: [f32::INFINITY; 4], hi: [-f32::INFINITY; 4] };

    #[inline(always)]
    pub(super) fn join(&mut self, lo: [f32; 4], hi: [f32; 4]) {
        for axis in 0..4 {
            self.lo[axis] = if lo[axis] < self.lo[axis] { lo[axis] } else { self.lo[axis] };
            self.hi[axis] = if hi[axis] > self.hi[axis] { hi[axis] } else { self.hi[axis] };
        }
    }

    pub(super) fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| (self.hi[axis] - self.lo[axis]).max(0.0));
        x * y + y * z + z * x
    }
}

/// A primitive: its box and its number.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Item {
    pub lo: [f32; 3],
    pub hi: [f32; 3],
    pub number: u32,
}

impl Item {
    #[inline(always)]
    pub(super) fn corners(&self) -> ([f32; 4], [f32; 4]) {
        let ([x, y, z], [u, v, w]) = (self.lo, self.hi);
        ([x, y, z, 0.0], [u, v, w, 0.0])
    }

    /// Returns twice the centre along an axis.
    #[inline(always)]
    pub(super) fn twice_centre(&self, axis: usize) -> f32 {
        self.lo[axis] + self.hi[axis]
    }

    #[inline(always)]
    pub(super) fn twice_centres(&self) -> [f32; 4] {
        [self.twice_centre(0), self.twice_centre(1), self.twice_centre(2), 0.0]
    }

    pub(super) fn has_box_of(&self, other: &Self) -> bool {
        (self.lo, self.hi) == (other.lo, other.hi)
    }

    /// Compares two primitives in an order that puts equal boxes side by side. An outer box comes
    /// before an inner one unless both have one least corner.
    pub(super) fn by_corners(&self, other: &Self) -> Ordering {
        let corners = |item: &Self| item.lo.into_iter().chain(item.hi);
        let mut sides = corners(self).zip(corners(other)).map(|(one, other)| one.total_cmp(&other));
        sides.find(|order| order.is_ne()).unwrap_or_else(|| self.number.cmp(&other.number))
    }
}

/// The bounds of a range of primitives.
#[derive(Clone, Copy, Debug)]
pub(super) struct RangeBounds {
    /// The box around the primitives.
    pub all: Span,
    /// The box around twice their centres.
    pub twice_centres: Span,
}

impl RangeBounds {
    pub(super) const EMPTY: Self = Self { all: Span::EMPTY, twice_centres: Span::EMPTY };

    #[inline(always)]
    pub(super) fn join(mut self, item: &Item) -> Self {
        let (lo, hi) = item.corners();
        self.all.join(lo, hi);
        self.twice_centres.join(item.twice_centres(), item.twice_centres());
        self
    }

    pub(super) fn of(items: &[Item]) -> Self {
        items.iter().fold(Self::EMPTY, Self::join)
    }
}
