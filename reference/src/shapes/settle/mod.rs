//! The second step of certified formulas: the same questions in two words a number, for what the
//! rounding of one leaves open. [rule 21]
//!
//! Lengths and directions are scaled by powers of two first, which rounds nothing: nothing over- or
//! underflows, be the scene as large or as small as it may. What is less than
//! [`DOUBT`](crate::two::DOUBT) of its terms counts as zero, and borders are closed: so no hit is
//! lost, and none is found that is farther than that beside a border. A ray without direction, or
//! one that is not finite, meets nothing.
//!
//! Shapes come as their numbers, so that nothing here depends on their files; and by reference, so
//! that a first step need not hold the numbers ready for a second one that is rare.

mod flat;
mod line;
mod round;
mod sphere;
mod triangle;

pub(super) use flat::{cuboid, plane, square};
pub(super) use round::Coil;
pub(super) use sphere::Ball;
pub(super) use triangle::{barycentric, outwards, triangle};
