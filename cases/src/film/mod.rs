//! Pictures: linear RGB in memory, the one way to bytes, and files.

mod encode;
mod image;

pub use encode::{byte, level, word};
pub use image::Image;

mod files;

pub use files::{Kind, PictureError, read_exact, write};
