//! Limits on the size of a scene.

/// Largest number of pixels of a picture: 4096 × 2048.
pub(crate) const MAX_PIXELS: u64 = 1 << 23;
/// Largest number of objects of a scene once its groups are dissolved.
pub(crate) const MAX_OBJECTS: usize = 100_000;
/// Largest number of triangles of a scene, and of vertices.
pub(crate) const MAX_TRIANGLES: usize = 2_000_000;
/// Largest depth of groups within groups.
pub(crate) const MAX_NESTING: usize = 16;
