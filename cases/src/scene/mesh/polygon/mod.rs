//! Cuts faces of more than three corners into triangles.
//!
//! A convex polygon becomes a fan about its first corner. Any other simple polygon is triangulated
//! by a sweep ([`sweep`]). Both flatten the polygon along the axis that is most nearly its normal.
//! The corners need not lie in one plane exactly, because files round them and modellers bend them;
//! the triangles are then the surface. A polygon that is bent so much that this surface is a guess
//! is an error, and so is one that crosses itself.

mod plane;
mod regions;
mod sweep;

use glam::DVec3;
use robust::orient2d;

use plane::{Plane, Point, order};

/// Greatest distance of a corner from the mean plane, as a share of the diagonal of the polygon's
/// box.
const MOST_BENT: f64 = 0.1;

/// Thickness below which a polygon that crosses itself has no area; the largest coordinate is 1.
///
/// It is four roundings to single precision, in which most files are written.
const THIN: f64 = 4.0 / 16_777_216.0;

/// The reason why no triangles are certain to be the surface of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(super) enum PolygonError {
    /// The order of the corners encloses no surface.
    #[error("crosses or touches itself")]
    Crosses,
    /// The corners are too far from one plane: by this share of the polygon's size.
    #[error("is not flat: a corner lies {:.1} % of the face's size off the mean plane, and {:.0} \
        % is allowed",
        .0 * 100.0, MOST_BENT * 100.0)]
    Bent(f64),
}

/// Triangulates the polygon with these finite corners. The triangles are indices of corners.
///
/// Each triangle has the polygon's orientation, and all of them have an area. A polygon without
/// area has no triangles. A corner at the place of an earlier one is replaced by that one.
///
/// # Errors
/// The polygon is bent by more than [`MOST_BENT`], or crosses itself as seen along its normal.
pub(super) fn triangulate(corners: &[DVec3]) -> Result<Vec<[usize; 3]>, PolygonError> {
    let corners = &scaled(corners)[..];
    let shape = Shape::of(corners);
    let flat = shape.flattened(corners);
    if is_strictly_convex(&flat) {
        shape.check_bend(corners)?;
        return Ok((2..corners.len()).map(|n| [0, n - 1, n]).collect());
    }
    let plane = Plane::of(&flat);
    match sweep::triangles(&plane) {
        Some(triangles) if shape.is_unfolded(corners, &plane) => {
            shape.check_bend(corners).map(|()| triangles)
        }
        _ if is_thin(corners) => Ok(vec![]),
        _ => shape.check_bend(corners).and(Err(PolygonError::Crosses)),
    }
}

/// Returns the corners divided by a power of two, so that the largest coordinate is from 1 to 2.
///
/// Products of coordinates then neither overflow nor vanish. No coordinate is rounded, unless it is
/// 2¹⁰⁰⁰ times smaller than the largest one.
fn scaled(corners: &[DVec3]) -> Vec<DVec3> {
    const EXPONENT: u64 = 0x7ff << 52;
    let largest =
        corners.iter().fold(0.0, |largest, corner| f64::max(largest, corner.abs().max_element()));
    let unit = f64::from_bits(largest.to_bits() & EXPONENT).max(f64::MIN_POSITIVE);
    corners.iter().map(|corner| *corner / unit).collect()
}

/// Returns whether all scaled corners lie on one line, up to the rounding of single precision.
fn is_thin(corners: &[DVec3]) -> bool {
    let far = |corner: &&DVec3| (**corner - corners[0]).length();
    let end = corners.iter().max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(&corners[0]);
    let along = (*end - corners[0]).normalize_or_zero();
    corners.iter().all(|corner| (*corner - corners[0]).cross(along).length() <= THIN)
}

/// The properties of a polygon that is not flattened yet.
struct Shape {
    /// The vector area, which points along the mean normal.
    area: DVec3,
    /// The axis along which the polygon is flattened.
    axis: usize,
    /// The diagonal of the box around the corners.
    size: f64,
}

impl Shape {
    fn of(corners: &[DVec3]) -> Self {
        let (mut area, mut sizes) = (DVec3::ZERO, DVec3::ZERO);
        for pair in corners.windows(2) {
            let part = (pair[0] - corners[0]).cross(pair[1] - corners[0]);
            area += part;
            sizes += part.abs();
        }
        // Sizes do not cancel, so that the axis is right even for a polygon that crosses itself.
        let axis = (0..3).fold(0, |best, axis| if sizes[axis] > sizes[best] { axis } else { best });
        let (min, max) = corners
            .iter()
            .fold((corners[0], corners[0]), |(min, max), c| (min.min(*c), max.max(*c)));
        Self { area, axis, size: (max - min).length() }
    }

    /// Returns the corners without the coordinate along the axis.
    fn flattened(&self, corners: &[DVec3]) -> Vec<Point> {
        let [x, y] = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        corners.iter().map(|corner| Point { x: corner[x], y: corner[y] }).collect()
    }

    fn check_bend(&self, corners: &[DVec3]) -> Result<(), PolygonError> {
        let normal = self.area.normalize_or_zero();
        let heights = || corners.iter().map(|corner| normal.dot(*corner - corners[0]));
        let mean = heights().sum::<f64>() / corners.len() as f64;
        let off = heights().fold(0.0, |most, height| f64::max(most, (height - mean).abs()));
        if off <= MOST_BENT * self.size { Ok(()) } else { Err(PolygonError::Bent(off / self.size)) }
    }

    /// Returns whether corners that coincide when flattened coincide in space.
    fn is_unfolded(&self, corners: &[DVec3], plane: &Plane) -> bool {
        let firsts = plane.place_of.iter().map(|place| plane.corners[*place]);
        firsts.zip(corners).all(|(first, corner)| corners[first][self.axis] == corner[self.axis])
    }
}

/// Returns whether the polygon turns to the same side at every corner, and goes around once.
fn is_strictly_convex(corners: &[Point]) -> bool {
    let n = corners.len();
    let at = |n: usize| corners[n % corners.len()];
    let turn = |n: usize| orient2d(at(n), at(n + 1), at(n + 2));
    let side = turn(0).signum();
    let turns_alike = turn(0) != 0.0 && (1..n).all(|n| turn(n) * side > 0.0);
    let is_leftmost =
        |n: usize| order(at(n + 1), at(n)).is_lt() && order(at(n + 1), at(n + 2)).is_lt();
    turns_alike && (0..n).filter(|n| is_leftmost(*n)).count() == 1
}

#[cfg(test)]
mod tests;
