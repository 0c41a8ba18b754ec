//! Rays: where they begin and end, how they are transformed, and eye rays.

pub mod camera;
pub mod frame;
pub mod moved;
pub mod ray;
