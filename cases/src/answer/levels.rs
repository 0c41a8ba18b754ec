//! Colours in levels, and the planes of an answer file that hold them.

use crate::film::exr::{Depth, Plane};

/// Red, green and blue in whole 8-bit levels.
pub type Levels = [u8; 3];

/// Number of stored units in a sample of 1. A 256th is exact in half precision, unlike a 255th, and
/// half the size when packed.
pub(super) const UNIT: f32 = 256.0;

/// Returns a plane of whole numbers, which are stored as multiples of 1/256.
pub(super) fn byte_plane(name: String, bytes: impl Iterator<Item = u8>) -> Plane {
    Plane { name, samples: bytes.map(|byte| f32::from(byte) / UNIT).collect(), depth: Depth::Half }
}
