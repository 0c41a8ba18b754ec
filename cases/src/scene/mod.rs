//! The resolved scene, which every tracer renders.
//!
//! The following holds for every [`Scene`]: every number is finite; every direction and normal is a
//! unit vector; every index is in range; every matrix has an inverse, which is stored beside it;
//! nothing is relative to anything else. Code that gets a scene never has to check whether a part
//! is there.

pub(crate) mod affine;
#[cfg(feature = "authoring")]
mod file;
pub mod json;
#[cfg(feature = "authoring")]
mod limits;
#[cfg(feature = "authoring")]
mod mesh;
mod model;
#[cfg(feature = "authoring")]
pub(crate) mod raw;
#[cfg(feature = "authoring")]
pub(crate) mod resolve;
#[cfg(feature = "authoring")]
mod shapes;
#[cfg(feature = "authoring")]
pub(crate) mod transform;
#[cfg(feature = "authoring")]
mod validate;

#[cfg(feature = "authoring")]
pub use file::{MAX_SCENE_BYTES, parse, parse_json};
#[cfg(feature = "authoring")]
pub(crate) use file::{body, document, load, read, root};
pub use model::*;
