//! Pictures: linear RGB in memory, the one way to bytes, and files.

mod encode;
#[cfg(feature = "authoring")]
pub mod exr;
mod image;
#[cfg(feature = "authoring")]
mod rows;

pub use self::encode::{Quantiser, byte, level};
pub use image::Image;
#[cfg(feature = "authoring")]
pub use rows::Rows;

mod files;

pub use files::{Kind, PictureError, encode, encode_by, read_exact, replace, write};
