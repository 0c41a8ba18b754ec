//! The resolved scene: what every tracer renders.
//!
//! What holds once a [`Scene`] exists: every number is finite; every direction and normal is a unit vector; every index
//! points at something; every matrix has an inverse, stored beside it; nothing is relative to anything else. Code below
//! this line never asks "is it there?".

pub mod json;
mod model;

pub use model::*;
