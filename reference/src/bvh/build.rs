//! Builds trees: ranges of primitives are split in place, along the axis and at the bin where the
//! surface-area heuristic is cheapest.
//!
//! Sums and bounds do not depend on the order in which threads finish, so the tree does not either.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::item::{Item, RangeBounds, Span};
use super::node::{Child, DEEPEST, Node, WIDTH};
use super::slab::Space;
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;

/// The greatest number of primitives in a leaf where they are tested one by one.
const FEW: usize = 2;
/// The greatest number of bins along an axis; a split is tried between every two neighbours.
const BINS: usize = 16;
/// Beyond this depth, ranges are split in halves: 2^28 primitives are then separated well before
/// [`DEEPEST`].
const DEEP: usize = DEEPEST - 30;
/// Ranges longer than this are divided among several threads.
const FORK: usize = 8192;
/// The least number of primitives with one box that form a crowd.
const MIN_EQUAL_BOXES: usize = 5;

/// The nodes of a tree, and the order in which its leaves hold the primitives.
pub(super) struct Built {
    pub nodes: Vec<Node>,
    /// The number of each primitive, leaf by leaf.
    pub order: Vec<u32>,
    /// The numbers of all primitives that share their box with [`MIN_EQUAL_BOXES`] − 1 others or
    /// more.
    pub crowd: Vec<u32>,
}

/// Builds the tree over primitives with these bounds; a leaf tests `at_once` primitives in the time
/// of one.
pub(super) fn build<T: Real>(bounds: &[Bounds<T>], space: &Space, at_once: usize) -> Built {
    if bounds.is_empty() {
        return Built { nodes: Vec::new(), order: Vec::new(), crowd: Vec::new() };
    }
    let item = |(number, bounds)| {
        let (lo, hi) = space.place(bounds);
        Item { lo, hi, number: number as u32 }
    };
    let mut items: Vec<Item> = bounds.par_iter().enumerate().with_min_len(FORK).map(item).collect();
    let around = RangeBounds::of(&items);
    let mut nodes = Vec::with_capacity(items.len() / 4 + 1);
    grow(&mut items, 0, around, Bottom { most: at_once.max(FEW), at_once, depth: 0 }, &mut nodes);
    // No split by bins divides equal boxes, and other splits keep them side by side.
    let crowds = items.chunk_by(Item::has_box_of).filter(|run| run.len() >= MIN_EQUAL_BOXES);
    let crowd = crowds.flatten().map(|item| item.number).collect();
    Built { nodes, order: items.iter().map(|item| item.number).collect(), crowd }
}

/// The limits within which a tree is divided further.
#[derive(Clone, Copy)]
struct Bottom {
    /// The greatest number of primitives in a leaf.
    most: usize,
    /// The number of primitives that are tested in the time of one.
    at_once: usize,
    /// The depth that the splits have reached.
    depth: usize,
}

/// A part of a range of primitives: their count and their bounds.
type Part = (usize, RangeBounds);

/// Appends the node over `items`, which are numbered from `first` on, and all nodes below it.
fn grow(
    items: &mut [Item],
    first: usize,
    around: RangeBounds,
    bottom: Bottom,
    nodes: &mut Vec<Node>,
) {
    let (parts, bottom) = divide(items, around, bottom);
    let at = nodes.len();
    nodes.push(Node::of([]));
    let mut children = ArrayVec::<_, WIDTH>::new();
    let is_leaf = |count: usize| count <= bottom.most;
    if items.len() <= FORK {
        let mut begin = 0;
        for (count, around) in parts {
            let child = if is_leaf(count) {
                Child::of_primitives(first + begin, count)
            } else {
                let child = Child::of_node(nodes.len());
                grow(&mut items[begin..begin + count], first + begin, around, bottom, nodes);
                child
            };
            children.push((around.all, child));
            begin += count;
        }
    } else {
        let mut rest = (items, first);
        let mut jobs = ArrayVec::<_, WIDTH>::new();
        for (count, around) in parts {
            let (items, after) = rest.0.split_at_mut(count);
            jobs.push((items, rest.1, around));
            rest = (after, rest.1 + count);
        }
        let grow_part = |(items, first, around): (&mut [Item], usize, RangeBounds)| {
            let mut nodes = Vec::new();
            if is_leaf(items.len()) {
                return (Child::of_primitives(first, items.len()), around, nodes);
            }
            nodes.reserve(items.len() / 4 + 1);
            grow(items, first, around, bottom, &mut nodes);
            (Child::ROOT, around, nodes)
        };
        let grown: Vec<_> = jobs
            .as_mut_slice()
            .into_par_iter()
            .map(|(items, first, around)| grow_part((items, *first, *around)))
            .collect();
        for (child, around, below) in grown {
            let by = nodes.len();
            children.push((around.all, child.moved(by)));
            nodes.extend(below.into_iter().map(|node| node.moved(by)));
        }
    }
    let corners =
        |span: Span| ([span.lo[0], span.lo[1], span.lo[2]], [span.hi[0], span.hi[1], span.hi[2]]);
    nodes[at] = Node::of(
        children.into_iter().map(|(span, child)| (corners(span).0, corners(span).1, child)),
    );
}

/// Returns the parts that the children of a node over `items` hold, in order, and the depth that
/// the splits have reached. While there is room, the part with the greatest box is split again.
fn divide(
    items: &mut [Item],
    around: RangeBounds,
    bottom: Bottom,
) -> (ArrayVec<Part, WIDTH>, Bottom) {
    let Bottom { most, at_once, .. } = bottom;
    let mut parts = ArrayVec::<Part, WIDTH>::new();
    if items.len() <= WIDTH && at_once == 1 {
        parts.extend(items.iter().map(|item| (1, RangeBounds::EMPTY.join(item))));
        return (parts, bottom);
    }
    parts.push((items.len(), around));
    while !parts.is_full() {
        let weight =
            |(count, around): &Part| if *count > most { around.all.half_area() } else { -1.0 };
        let largest = (0..parts.len())
            .fold(0, |best, n| if weight(&parts[n]) > weight(&parts[best]) { n } else { best });
        let (count, around) = parts[largest];
        if count <= most {
            break;
        }
        let begin: usize = parts[..largest].iter().map(|part| part.0).sum();
        let (left, right) = split(&mut items[begin..begin + count], around, bottom);
        parts[largest] = left;
        parts.insert(largest + 1, right);
    }
    (parts, Bottom { depth: bottom.depth + 1, ..bottom })
}

/// Splits a range of at least two primitives in two parts, neither of them empty.
fn split(items: &mut [Item], around: RangeBounds, bottom: Bottom) -> (Part, Part) {
    if bottom.depth < DEEP
        && let Some(cut) = cheapest(items, &around, bottom.at_once)
    {
        let (count, left, right) = part(items, |item| cut.bin(item) <= cut.last);
        return ((count, left), (items.len() - count, right));
    }
    // All centres are equal, or the tree is deep. Sorting puts equal boxes side by side.
    items.sort_unstable_by(Item::by_corners);
    let count = items.len() / 2;
    let (left, right) = items.split_at(count);
    ((count, RangeBounds::of(left)), (right.len(), RangeBounds::of(right)))
}

/// Moves the primitives that go left before the others. Returns their count, and the bounds of both
/// parts.
fn part(
    items: &mut [Item],
    goes_left: impl Fn(&Item) -> bool,
) -> (usize, RangeBounds, RangeBounds) {
    let (mut left, mut right) = (RangeBounds::EMPTY, RangeBounds::EMPTY);
    let (mut begin, mut end) = (0, items.len());
    while begin < end {
        if goes_left(&items[begin]) {
            left = left.join(&items[begin]);
            begin += 1;
        } else {
            right = right.join(&items[begin]);
            end -= 1;
            items.swap(begin, end);
        }
    }
    (begin, left, right)
}

/// A split behind bin `last` along an axis.
struct Cut {
    axis: usize,
    last: usize,
    grid: Grid,
}

impl Cut {
    #[inline(always)]
    fn bin(&self, item: &Item) -> usize {
        self.grid.bin(item, self.axis)
    }
}

/// Bins of equal width between the least and the greatest centre.
#[derive(Clone, Copy)]
struct Grid {
    n_bins: usize,
    least: [f32; 4],
    per_width: [f32; 4],
}

impl Grid {
    #[inline(always)]
    fn bin(&self, item: &Item, axis: usize) -> usize {
        (((item.twice_centre(axis) - self.least[axis]) * self.per_width[axis]) as usize)
            .min(self.n_bins - 1)
    }
}

#[derive(Clone, Copy)]
struct Bin {
    all: Span,
    count: usize,
}

type Bins = [[Bin; BINS]; 3];

/// Returns the cheapest split with primitives on both sides; `None` where all centres are equal.
fn cheapest(items: &[Item], around: &RangeBounds, at_once: usize) -> Option<Cut> {
    let n_bins = (4 + items.len() / 4).min(BINS);
    let Span { lo: least, hi: most } = around.twice_centres;
    let per_width = [0, 1, 2, 3].map(|axis| {
        let width = most[axis] - least[axis];
        if width > 0.0 { n_bins as f32 * 0.9999 / width } else { 0.0 }
    });
    if per_width[..3] == [0.0; 3] {
        return None;
    }
    let grid = Grid { n_bins, least, per_width };
    let bins = if items.len() > 8 * FORK {
        items.par_chunks(FORK).map(|items| fill(items, grid)).reduce(|| EMPTY, merge)
    } else {
        fill(items, grid)
    };
    let cost = |bin: &Bin| bin.all.half_area() * bin.count.div_ceil(at_once) as f32;
    let mut best = (f32::INFINITY, 0, 0);
    for axis in (0..3).filter(|axis| per_width[*axis] > 0.0) {
        let mut right = [(0.0, 0); BINS];
        let mut so_far = Bin { all: Span::EMPTY, count: 0 };
        for n in (1..n_bins).rev() {
            so_far = join(so_far, bins[axis][n]);
            right[n - 1] = (cost(&so_far), so_far.count);
        }
        let mut so_far = Bin { all: Span::EMPTY, count: 0 };
        for n in 0..n_bins - 1 {
            so_far = join(so_far, bins[axis][n]);
            let cost = cost(&so_far) + right[n].0;
            if so_far.count > 0 && right[n].1 > 0 && cost < best.0 {
                best = (cost, axis, n);
            }
        }
    }
    best.0.is_finite().then_some(Cut { axis: best.1, last: best.2, grid })
}

const EMPTY: Bins = [[Bin { all: Span::EMPTY, count: 0 }; BINS]; 3];

#[inline(always)]
fn join(mut one: Bin, other: Bin) -> Bin {
    one.all.join(other.all.lo, other.all.hi);
    one.count += other.count;
    one
}

fn fill(items: &[Item], grid: Grid) -> Bins {
    let mut bins = EMPTY;
    for item in items {
        let (lo, hi) = item.corners();
        for (axis, bins) in bins.iter_mut().enumerate() {
            let bin = &mut bins[grid.bin(item, axis)];
            bin.all.join(lo, hi);
            bin.count += 1;
        }
    }
    bins
}

fn merge(mut one: Bins, other: Bins) -> Bins {
    for (bins, others) in one.iter_mut().zip(&other) {
        for (bin, other) in bins.iter_mut().zip(others) {
            *bin = join(*bin, *other);
        }
    }
    one
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::vec3::Vec3;

    /// Returns more boxes than it takes for threads to share the bins. Some lie within others, some
    /// in one place.
    fn boxes() -> Vec<Bounds<f64>> {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 12) / 1_048_576.0
        };
        let mut one = |n: usize| {
            let (at, size) = (Vec3::new(next(), next(), next()), next() * 0.01);
            let min = if n.is_multiple_of(7) { Vec3::ZERO } else { at };
            Bounds { min, max: min + Vec3::ONE * size }
        };
        (0..10 * FORK).map(&mut one).collect()
    }

    #[test]
    fn one_thread_and_five_build_the_same_tree() {
        let bounds = boxes();
        let built = |n_threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
            pool.install(|| build(&bounds, &Space::of(&bounds), 4))
        };
        let (Built { nodes, mut order, crowd }, other) = (built(1), built(5));
        assert!(
            nodes == other.nodes && order == other.order && crowd == other.crowd,
            "the trees differ"
        );
        order.sort_unstable();
        assert!(
            order.iter().enumerate().all(|(n, number)| n as u32 == *number),
            "a primitive is lost, or held twice"
        );
    }

    /// Returns boxes around one centre: `n_equal` equal ones, and one of another size behind each
    /// of them.
    fn nested(n_equal: usize) -> Vec<Bounds<f64>> {
        let around = |size: f64| Bounds { min: Vec3::ONE * -size, max: Vec3::ONE * size };
        (0..n_equal).flat_map(|n| [around(1.0), around(2.0 + n as f64)]).collect()
    }

    #[test]
    fn a_crowd_is_found_wherever_it_stands() {
        for (n_equal, n_crowd) in
            [(MIN_EQUAL_BOXES - 1, 0), (MIN_EQUAL_BOXES, MIN_EQUAL_BOXES), (1000, 1000)]
        {
            let bounds = nested(n_equal);
            let mut crowd = build(&bounds, &Space::of(&bounds), 4).crowd;
            crowd.sort_unstable();
            assert_eq!(crowd, (0..n_crowd as u32).map(|n| 2 * n).collect::<Vec<_>>(), "{n_equal}");
        }
    }
}
