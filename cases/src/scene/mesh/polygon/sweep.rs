//! Triangulates a simple polygon in the plane by a sweep with exact predicates.
//!
//! The sweep passes the corners from left to right and keeps the active edges in order from below
//! to above; the interior lies between one edge and the next. The work is O(n log n) for every
//! polygon. (M. I. Shamos and D. Hoey, Geometric intersection problems, 1976; M. R. Garey and
//! others, Triangulating a simple polygon, 1978.)
//!
//! No decision depends on rounding, so a polygon is either triangulated without gap and overlap or
//! refused. Corners may repeat, lie in a row, and be joined by a bridge to a hole: an edge along
//! which the polygon runs once in each direction bounds nothing.

use std::collections::BTreeMap;

use super::plane::{Active, Edge, Plane};
use super::regions::{Regions, Side};

/// Returns the triangles of a polygon, as indices of its corners.
///
/// Every triangle has the orientation of the polygon. Of several corners at one place, the first
/// stands for all. A polygon without area has no triangles. The result is `None` if the polygon
/// crosses itself, or touches itself at other points than common corners.
pub(super) fn triangles(plane: &Plane) -> Option<Vec<[usize; 3]>> {
    let (starting, ending) = plane.edges()?;
    let Some(first) =
        starting.iter().filter(|edge| edge.left == starting[0].left).map(|e| plane.active(e)).min()
    else {
        return Some(vec![]);
    };
    // The interior lies above the lowest edge of the leftmost corner.
    let is_ccw = first.is_forward;
    let regions = Regions::new(plane, is_ccw);
    let mut sweep = Sweep { plane, is_ccw, active: BTreeMap::new(), regions };
    let (mut starting, mut ending) = (&*starting, &*ending);
    for place in 0..plane.places.len() {
        let ended = starting_with(&mut ending, |edge| edge.right == place);
        let started = starting_with(&mut starting, |edge| edge.left == place);
        sweep.pass(place, ended, started)?;
    }
    Some(sweep.regions.into_triangles())
}

/// Removes the edges at the head of the list for which `holds` is true, and returns them.
fn starting_with<'a>(edges: &mut &'a [Edge], holds: impl Fn(&Edge) -> bool) -> &'a [Edge] {
    let (taken, rest) = edges.split_at(edges.iter().take_while(|edge| holds(edge)).count());
    *edges = rest;
    taken
}

/// An active edge, and the number of the region that it bounds.
type Bound = (Active, usize);

/// The state of a sweep. Its steps return `None` if the polygon is not simple.
struct Sweep<'a> {
    plane: &'a Plane,
    /// Whether the polygon runs counter-clockwise.
    is_ccw: bool,
    active: BTreeMap<Active, usize>,
    regions: Regions<'a>,
}

impl Sweep<'_> {
    /// Passes a place at which the edges `ending` end and the edges `starting` start.
    fn pass(&mut self, place: usize, ending: &[Edge], starting: &[Edge]) -> Option<()> {
        let mut ended: Vec<Bound> = vec![];
        for edge in ending {
            ended.push(self.active.remove_entry(&self.plane.active(edge))?);
        }
        ended.sort_unstable();
        let mut started: Vec<Active> =
            starting.iter().map(|edge| self.plane.active(edge)).collect();
        started.sort_unstable();
        let (below, above) = self.neighbours(place, &started)?;
        let low = match ended.first() {
            Some((edge, region)) => (!self.is_bottom(edge)).then_some(*region),
            None => below.filter(|(edge, _)| self.is_bottom(edge)).map(|(_, region)| region),
        };
        let high = if ended.is_empty() { low } else { self.close(place, low, &ended)? };
        let (is_bottom, is_top) =
            (below.map(|b| self.is_bottom(&b.0)), above.map(|a| !self.is_bottom(&a.0)));
        if is_bottom.unwrap_or(false) != low.is_some() || is_top.unwrap_or(false) != high.is_some()
        {
            return None;
        }
        match (low, high, started.is_empty()) {
            (Some(low), Some(high), true) if !ended.is_empty() => {
                self.regions.intersect(place, low, high);
                self.active.insert(above?.0, low);
                Some(())
            }
            (.., true) => (low == high).then_some(()),
            (Some(region), _, false) if ended.is_empty() => {
                let upper = self.regions.split(place, region);
                self.active.insert(above?.0, upper);
                self.open(place, Some(region), Some(upper), &started)
            }
            (.., false) => {
                low.into_iter().for_each(|region| self.regions.add(place, region, Side::Upper));
                high.into_iter().for_each(|region| self.regions.add(place, region, Side::Lower));
                self.open(place, low, high, &started)
            }
        }
    }

    /// Returns whether the interior lies above the edge.
    fn is_bottom(&self, edge: &Active) -> bool {
        self.is_ccw == edge.is_forward
    }

    /// Returns the active edges next below and above a place at which the edges `started` start.
    ///
    /// Neighbours are compared as soon as they become neighbours, so that no crossing is missed.
    fn neighbours(
        &self,
        place: usize,
        started: &[Active],
    ) -> Option<(Option<Bound>, Option<Bound>)> {
        let here = Active::at(self.plane.places[place]);
        if self.active.contains_key(&here) {
            return None;
        }
        let bound = |(edge, region): (&Active, &usize)| (*edge, *region);
        let below = self.active.range(..here).next_back().map(bound);
        let above = self.active.range(here..).next().map(bound);
        let lowest = started.first().copied().or(above.map(|(edge, _)| edge));
        let highest = started.last().copied().or(below.map(|(edge, _)| edge));
        let pairs = [(below.map(|(edge, _)| edge), lowest), (highest, above.map(|(edge, _)| edge))];
        let stay =
            |pair| !matches!(pair, (Some(low), Some(high)) if !Active::stays_below(&low, &high));
        pairs.into_iter().all(stay).then_some((below, above))
    }

    /// Closes the regions between edges that end at a place. Returns the region above them.
    fn close(
        &mut self,
        place: usize,
        low: Option<usize>,
        ended: &[Bound],
    ) -> Option<Option<usize>> {
        let mut inside = low;
        for (n, (edge, region)) in ended.iter().enumerate() {
            inside = match inside {
                None if self.is_bottom(edge) => Some(*region),
                Some(open) if !self.is_bottom(edge) && open == *region => {
                    if n > 0 {
                        self.regions.finish(place, open);
                    }
                    None
                }
                _ => return None,
            };
        }
        Some(inside)
    }

    /// Inserts the edges that start at a place, between the regions `low` and `high`.
    fn open(
        &mut self,
        place: usize,
        low: Option<usize>,
        high: Option<usize>,
        started: &[Active],
    ) -> Option<()> {
        let mut inside = low;
        for (n, edge) in started.iter().enumerate() {
            let (region, is_top) = match (inside, high) {
                (Some(open), _) => (open, true),
                (None, Some(high)) if n + 1 == started.len() => (high, false),
                (None, _) => (self.regions.start(place), false),
            };
            if is_top == self.is_bottom(edge) || self.active.insert(*edge, region).is_some() {
                return None;
            }
            inside = (!is_top).then_some(region);
        }
        (inside == high).then_some(())
    }
}
