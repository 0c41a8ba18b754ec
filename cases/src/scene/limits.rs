//! Limits on the size of a scene.

/// Pixels of a picture: 4096 × 2048.
pub(crate) const MAX_PIXELS: u64 = 1 << 23;
/// Objects of a scene once its groups are dissolved.
pub(crate) const MAX_OBJECTS: usize = 100_000;
/// Triangles of a scene, and likewise vertices.
pub(crate) const MAX_TRIANGLES: usize = 2_000_000;
/// Groups within groups.
pub(crate) const MAX_NESTING: usize = 16;
