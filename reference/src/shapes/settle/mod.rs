//! The second step of certified formulas: the same computations in two words per number, where the
//! rounding of one word leaves the result open. [rule 21]
//!
//! Lengths and directions are scaled by powers of two first, which rounds nothing: nothing
//! overflows or underflows, however large or small the scene is. A value that is less than
//! [`DOUBT`](crate::numbers::two::DOUBT) of its terms counts as zero, and borders are closed: so no
//! hit is lost, and none is found that is farther than that beside a border. A ray without
//! direction, or one that is not finite, hits nothing.
//!
//! A ray is passed as [`ExactRay`](crate::rays::moved::ExactRay), whose numbers have two words each
//! where a matrix has moved it into object space.
//!
//! Shapes are passed as their numbers, so that nothing here depends on their files. They are passed
//! by reference, so that a first step need not load the numbers for a second one that is rare.

mod flat;
mod line;
mod round;
mod sphere;
mod triangle;

pub(super) use flat::{cuboid, plane, square, square_at};
pub(super) use round::Coil;
pub(super) use sphere::{Ball, power};
pub(super) use triangle::{barycentric, outwards, triangle};
