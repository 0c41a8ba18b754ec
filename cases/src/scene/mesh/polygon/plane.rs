//! Polygons in the plane: their corners in the order of a sweep, and their edges.

use std::cmp::Ordering;

use robust::{Coord, orient2d};

/// A point of the plane.
pub(super) type Point = Coord<f64>;

/// Compares two points in the order of a sweep: from left to right, and upwards on a vertical.
pub(super) fn order(a: Point, b: Point) -> Ordering {
    let axis = |a: f64, b: f64| a.partial_cmp(&b).unwrap_or(Ordering::Equal);
    axis(a.x, b.x).then(axis(a.y, b.y))
}

/// The corners of a polygon, where corners at one place are merged.
pub(super) struct Plane {
    /// The places of the corners, in the order of the sweep.
    pub places: Vec<Point>,
    /// The first corner at each place.
    pub corners: Vec<usize>,
    /// The number of the place of each corner.
    pub place_of: Vec<usize>,
}

/// An edge between two places, of which `left` comes first in the sweep.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub left: usize,
    pub right: usize,
    /// Whether the polygon runs along it from left to right.
    pub is_forward: bool,
}

impl Plane {
    /// Returns the places of these finite corners.
    pub(super) fn of(corners: &[Point]) -> Self {
        let mut sorted: Vec<usize> = (0..corners.len()).collect();
        sorted.sort_by(|i, j| order(corners[*i], corners[*j]));
        let mut plane = Self { places: vec![], corners: vec![], place_of: vec![0; corners.len()] };
        for corner in sorted {
            if plane.places.last().is_none_or(|last| order(*last, corners[corner]).is_ne()) {
                plane.places.push(corners[corner]);
                plane.corners.push(corner);
            }
            plane.place_of[corner] = plane.places.len() - 1;
        }
        plane
    }

    /// Returns the edges in the order of their left ends, and again in the order of their right
    /// ends.
    ///
    /// Edges that cancel are left out. The result is `None` if the polygon runs along an edge twice
    /// in the same direction.
    pub(super) fn edges(&self) -> Option<(Vec<Edge>, Vec<Edge>)> {
        let next = self.place_of.iter().cycle().skip(1);
        let mut steps: Vec<(usize, usize, i32)> = self
            .place_of
            .iter()
            .zip(next)
            .filter(|(from, to)| from != to)
            .map(|(from, to)| if from < to { (*from, *to, 1) } else { (*to, *from, -1) })
            .collect();
        steps.sort_unstable();
        let mut starting = vec![];
        for same in steps.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (left, right, _) = same[0];
            match same.iter().map(|step| step.2).sum() {
                0 => {}
                1 => starting.push(Edge { left, right, is_forward: true }),
                -1 => starting.push(Edge { left, right, is_forward: false }),
                _ => return None,
            }
        }
        let mut ending = starting.clone();
        ending.sort_by_key(|edge| edge.right);
        Some((starting, ending))
    }

    /// Returns the edge in the form in which the sweep compares edges.
    pub(super) fn active(&self, edge: &Edge) -> Active {
        let [left, right] = [edge.left, edge.right].map(|place| self.places[place]);
        Active { left, right, is_forward: edge.is_forward }
    }
}

/// An active edge: the sweep has passed its left end, but not its right end.
///
/// Active edges are ordered from below to above. The order is total as long as no two of them
/// cross.
#[derive(Clone, Copy)]
pub(super) struct Active {
    pub left: Point,
    pub right: Point,
    /// Whether the polygon runs along it from left to right.
    pub is_forward: bool,
}

impl Active {
    /// Returns an edge without length, which compares as an edge that starts at the point.
    pub(super) fn at(point: Point) -> Self {
        Self { left: point, right: point, is_forward: true }
    }

    /// Returns a number below 0 for a point below the edge, and 0 for a point on the line through
    /// it.
    fn side(&self, point: Point) -> f64 {
        orient2d(self.left, self.right, point)
    }

    /// Returns whether the edge stays below `above`, its neighbour on that side, until one of them
    /// ends.
    pub(super) fn stays_below(&self, above: &Self) -> bool {
        match order(self.right, above.right) {
            Ordering::Equal => true,
            Ordering::Less => above.side(self.right) < 0.0,
            Ordering::Greater => self.side(above.right) > 0.0,
        }
    }
}

impl Ord for Active {
    fn cmp(&self, other: &Self) -> Ordering {
        let sign = |side: f64| side.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        match order(self.left, other.left) {
            Ordering::Less => sign(self.side(other.left)).reverse(),
            Ordering::Equal => sign(self.side(other.right)).reverse(),
            Ordering::Greater => sign(other.side(self.left)),
        }
    }
}

impl PartialOrd for Active {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Active {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Active {}
