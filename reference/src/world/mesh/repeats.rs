//! Triangles that repeat an earlier one of their mesh.
//!
//! A repeat has the corners of the earlier triangle, to the last bit and in the same order. Every
//! ray hits both at the same t or misses both, and at one t the earlier one wins. So the later one
//! is never the hit, whatever the formula, and a tree need not hold it: a ray would have to test
//! all of them, since no box separates them. The same corners in another order are kept, as their t
//! may differ in the last digit; there are five other orders, so these are few.
//!
//! Different triangles with one box still cost every ray that enters the box a test each.

use std::collections::HashSet;

use crate::bvh::Bvh;
use crate::numbers::bounds::Bounds;
use crate::numbers::real::Real;
use crate::shapes::Triangle;

/// Returns the tree over triangles with these bounds, and the order in which it holds its
/// triangles.
///
/// The tree is that of [`Bvh::build_in_fours`] without the triangles that repeat an earlier one.
/// Repeats have equal boxes, so only a mesh in which many boxes are equal is searched for them.
pub(super) fn build_tree<T: Real>(
    bounds: &[Bounds<T>],
    triangle: impl Fn(u32) -> Triangle<T>,
) -> (Bvh, Vec<u32>) {
    let (tree, order, crowd) = Bvh::build_in_fours(bounds);
    let repeats = repeats(crowd, triangle);
    if repeats.is_empty() {
        return (tree, order);
    }
    let kept: Vec<u32> = (0..bounds.len() as u32).filter(|n| !repeats.contains(n)).collect();
    let bounds: Vec<Bounds<T>> = kept.iter().map(|n| bounds[*n as usize]).collect();
    let (tree, order, _) = Bvh::build_in_fours(&bounds);
    (tree, order.into_iter().map(|n| kept[n as usize]).collect())
}

/// Returns the triangles among `numbers` that repeat one with a lower number.
fn repeats<T: Real>(mut numbers: Vec<u32>, triangle: impl Fn(u32) -> Triangle<T>) -> HashSet<u32> {
    numbers.sort_unstable();
    let bits = |n: u32| triangle(n).corners.map(|corner| corner.f64().to_array().map(f64::to_bits));
    let mut seen = HashSet::new();
    numbers.into_iter().filter(|n| !seen.insert(bits(*n))).collect()
}
