//! The parts of a polygon's interior that a sweep crosses, and their triangles.

use robust::orient2d;

use super::plane::Plane;

/// The side of a region on which a corner lies.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Lower,
    Upper,
}

/// Corners of a region whose triangles are not complete.
///
/// All but the first lie on one side. The chain bends away from the region, so that no two of its
/// corners see each other unless they are neighbours.
struct Chain {
    places: Vec<usize>,
    side: Side,
}

/// A part of the interior between an active edge and the next one above it.
enum Region {
    One(Chain),
    /// Two parts that were joined at a corner, with which both chains end; the first is the lower
    /// one. The line from there to the next corner of the region will bound both.
    Joined(Chain, Chain),
    Closed,
}

/// The regions of a sweep by their numbers, and the triangles so far.
pub(super) struct Regions<'a> {
    plane: &'a Plane,
    /// Whether the polygon runs counter-clockwise.
    is_ccw: bool,
    list: Vec<Region>,
    triangles: Vec<[usize; 3]>,
}

impl<'a> Regions<'a> {
    pub(super) fn new(plane: &'a Plane, is_ccw: bool) -> Self {
        Self { plane, is_ccw, list: vec![], triangles: vec![] }
    }

    /// Returns the triangles as indices of corners. Each has the orientation of the polygon.
    pub(super) fn into_triangles(self) -> Vec<[usize; 3]> {
        self.triangles
    }

    /// Starts a region at `place`, and returns its number.
    pub(super) fn start(&mut self, place: usize) -> usize {
        self.list.push(Region::One(Chain { places: vec![place], side: Side::Lower }));
        self.list.len() - 1
    }

    /// Adds a corner to one side of a region.
    pub(super) fn add(&mut self, place: usize, region: usize, side: Side) {
        let mut chain = match (self.take(region), side) {
            (Region::One(chain), _) => chain,
            (Region::Joined(mut lower, upper), Side::Lower) => {
                self.extend(&mut lower, place, side);
                upper
            }
            (Region::Joined(lower, mut upper), Side::Upper) => {
                self.extend(&mut upper, place, side);
                lower
            }
            (Region::Closed, _) => return,
        };
        self.extend(&mut chain, place, side);
        self.list[region] = Region::One(chain);
    }

    /// Ends a region at its last corner.
    pub(super) fn finish(&mut self, place: usize, region: usize) {
        let chains = match self.take(region) {
            Region::One(chain) => [Some(chain), None],
            Region::Joined(lower, upper) => [Some(lower), Some(upper)],
            Region::Closed => return,
        };
        for mut chain in chains.into_iter().flatten() {
            let opposite = if chain.side == Side::Lower { Side::Upper } else { Side::Lower };
            self.extend(&mut chain, place, opposite);
        }
    }

    /// Joins two regions at the corner where the gap between them ends. `low` becomes the result.
    pub(super) fn intersect(&mut self, place: usize, low: usize, high: usize) {
        self.add(place, low, Side::Upper);
        self.add(place, high, Side::Lower);
        if let (Region::One(lower), Region::One(upper)) = (self.take(low), self.take(high)) {
            self.list[low] = Region::Joined(lower, upper);
        }
    }

    /// Splits a region at a corner within it, along the line to its latest corner.
    ///
    /// The region becomes its lower part. Returns the number of the upper part.
    pub(super) fn split(&mut self, place: usize, region: usize) -> usize {
        let (mut lower, mut upper) = match self.take(region) {
            Region::Joined(lower, upper) => (lower, upper),
            Region::One(chain) => {
                let latest: Vec<usize> = chain.places.last().copied().into_iter().collect();
                match chain.side {
                    Side::Lower => (Chain { places: latest, side: Side::Upper }, chain),
                    Side::Upper => (chain, Chain { places: latest, side: Side::Lower }),
                }
            }
            Region::Closed => return region,
        };
        self.extend(&mut lower, place, Side::Upper);
        self.extend(&mut upper, place, Side::Lower);
        self.list[region] = Region::One(lower);
        self.list.push(Region::One(upper));
        self.list.len() - 1
    }

    fn take(&mut self, region: usize) -> Region {
        std::mem::replace(&mut self.list[region], Region::Closed)
    }

    /// Adds a corner to a chain, and emits the triangles that it completes.
    fn extend(&mut self, chain: &mut Chain, place: usize, side: Side) {
        if chain.places.len() > 1 && chain.side != side {
            chain.places.windows(2).for_each(|pair| self.emit([pair[0], pair[1], place]));
            chain.places.drain(..chain.places.len() - 1);
        }
        while let [.., a, b] = chain.places[..] {
            let turn = self.turn([a, b, place]);
            let is_convex = if side == Side::Lower { turn > 0.0 } else { turn < 0.0 };
            if !is_convex {
                break;
            }
            self.emit([a, b, place]);
            chain.places.pop();
        }
        chain.places.push(place);
        chain.side = side;
    }

    /// Returns a number above 0 if the path through the places turns left.
    fn turn(&self, places: [usize; 3]) -> f64 {
        let [a, b, c] = places.map(|place| self.plane.places[place]);
        orient2d(a, b, c)
    }

    fn emit(&mut self, [a, b, c]: [usize; 3]) {
        let is_ccw = self.turn([a, b, c]) > 0.0;
        let triangle = if is_ccw == self.is_ccw { [a, b, c] } else { [a, c, b] };
        self.triangles.push(triangle.map(|place| self.plane.corners[place]));
    }
}
