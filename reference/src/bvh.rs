//! A tree of boxes over numbered things, known by their bounds alone.

use crate::bounds::{Bounds, BoxRay};
use crate::ray::Ray;
use crate::real::Real;

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

/// At most this many things a leaf, unless they cannot be told apart.
const LEAF: usize = 4;
/// Places at which a split is tried.
const BINS: usize = 16;
/// Deeper than this the tree is split in halves, so that a walk's stack is bounded.
const DEEP: usize = 40;

/// The tree. Its nodes lie in one list, a left child right behind its parent.
#[derive(Clone, Debug)]
pub struct Bvh<T> {
    nodes: Vec<Node<T>>,
    /// The things' numbers, leaf by leaf.
    order: Vec<u32>,
    loss: T,
}

#[derive(Clone, Copy, Debug)]
struct Node<T> {
    bounds: Bounds<T>,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Inner { right: u32 },
    Leaf { first: u32, count: u32 },
}

impl<T: Real> Bvh<T> {
    /// The tree over `bounds.len()` things, split where the surface-area heuristic finds it cheapest. The same bounds give the same tree.
    pub fn build(bounds: &[Bounds<T>]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: Vec::new(), loss: T::ONE };
        let mut items: Vec<u32> = (0..bounds.len() as u32).collect();
        tree.grow(bounds, &mut items, 0);
        tree
    }

    /// Bytes it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.order)
    }

    /// The tree over things that are asked in frames of their own, on the way to which roundings grow by up to this factor, 1 or more.
    pub fn with_loss(self, loss: T) -> Self {
        Self { loss, ..self }
    }

    fn grow(&mut self, bounds: &[Bounds<T>], items: &mut [u32], depth: usize) {
        let all = items.iter().fold(Bounds::empty(), |all, i| all.join(bounds[*i as usize]));
        let at = self.nodes.len();
        let leaf = Kind::Leaf { first: self.order.len() as u32, count: items.len() as u32 };
        self.nodes.push(Node { bounds: all, kind: leaf });
        let middle = if items.len() <= LEAF { None } else { split(bounds, items, depth) };
        let Some(middle) = middle else {
            self.order.extend_from_slice(items);
            return;
        };
        let (left, right) = items.split_at_mut(middle);
        self.grow(bounds, left, depth + 1);
        self.nodes[at].kind = Kind::Inner { right: self.nodes.len() as u32 };
        self.grow(bounds, right, depth + 1);
    }

    /// Calls `visit` for every thing whose box the ray enters before the limit, nearer boxes first. `visit` gets the tally and the limit, and returns
    /// the new one: a lower one where it has met something, −∞ to end the walk.
    #[inline]
    pub fn walk<Y: Tally>(&self, ray: &Ray<T>, tally: &mut Y, mut visit: impl FnMut(&mut Y, u32, T) -> T) {
        let Some(root) = self.nodes.first() else { return };
        let boxed = BoxRay::new(ray, root.bounds, self.loss);
        let mut limit = ray.t_max;
        let mut stack = [(0, T::ZERO); 2 * DEEP];
        let mut n_open = 0;
        let mut next = boxed.enter(&root.bounds, limit).map(|_| 0);
        while let Some(at) = next {
            tally.node();
            match self.nodes[at as usize].kind {
                Kind::Leaf { first, count } => {
                    for item in &self.order[first as usize..(first + count) as usize] {
                        tally.thing();
                        limit = visit(tally, *item, limit);
                    }
                    next = None;
                }
                Kind::Inner { right } => {
                    let enter = |child: u32| boxed.enter(&self.nodes[child as usize].bounds, limit).map(|t| (child, t));
                    next = match (enter(at + 1), enter(right)) {
                        (Some(left), Some(right)) => {
                            let (near, far) = if right.1 < left.1 { (right, left) } else { (left, right) };
                            stack[n_open] = far;
                            n_open += 1;
                            Some(near.0)
                        }
                        (one, other) => one.or(other).map(|(child, _)| child),
                    };
                }
            }
            while next.is_none() && n_open > 0 {
                n_open -= 1;
                let (child, t) = stack[n_open];
                next = (t <= limit).then_some(child);
            }
        }
    }
}

/// Puts `items` in order and returns how many go left; `None` where a leaf is as good.
fn split<T: Real>(bounds: &[Bounds<T>], items: &mut [u32], depth: usize) -> Option<usize> {
    let middle = |i: u32| bounds[i as usize].middle();
    let spread = Bounds::around(items.iter().map(|i| middle(*i)));
    let side = spread.max - spread.min;
    let axis = (0..3).fold(0, |longest, axis| if side[axis] > side[longest] { axis } else { longest });
    if side[axis] <= T::ZERO {
        return None;
    }
    let bin = |i: u32| {
        let share = (middle(i)[axis] - spread.min[axis]) / side[axis];
        ((share.f64() * BINS as f64) as usize).min(BINS - 1)
    };
    if depth < DEEP
        && let Some(best) = cheapest(bounds, items, bin)
    {
        items.sort_by_key(|i| bin(*i)); // stable: the order within a bin stays
        return Some(items.partition_point(|i| bin(*i) <= best));
    }
    items.sort_by(|i, j| middle(*i)[axis].f64().total_cmp(&middle(*j)[axis].f64()));
    Some(items.len() / 2)
}

/// The bin that ends the left side of the cheapest split with something on both sides.
fn cheapest<T: Real>(bounds: &[Bounds<T>], items: &[u32], bin: impl Fn(u32) -> usize) -> Option<usize> {
    let mut bins = [(Bounds::empty(), 0usize); BINS];
    for i in items {
        let (all, count) = &mut bins[bin(*i)];
        *all = all.join(bounds[*i as usize]);
        *count += 1;
    }
    let side = |bins: &[(Bounds<T>, usize)]| {
        let all = bins.iter().fold(Bounds::empty(), |all, one| all.join(one.0));
        let count: usize = bins.iter().map(|one| one.1).sum();
        (all.half_area().f64() * count as f64, count)
    };
    let cost = |last: usize| {
        let (left, right) = (side(&bins[..=last]), side(&bins[last + 1..]));
        (left.1 > 0 && right.1 > 0).then_some((last, left.0 + right.0))
    };
    (0..BINS - 1).filter_map(cost).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(last, _)| last)
}
