//! Pictures: linear RGB in memory, its conversion to bytes, and files.
//!
//! | file | holds |
//! |---|---|
//! | `image.rs` | a picture in memory |
//! | `encode.rs` | light to levels, and back |
//! | `kind.rs` | image files by kind: writing them, and reading one whose size is known |
//! | `signature.rs` | the kind of a picture by the first bytes of its file |
//! | `rows.rs`, `png.rs`, `pfm.rs` | a picture read row by row |
//! | `open.rs`, `exr.rs` | pictures of any size, and OpenEXR files: for staff tools |

mod encode;
mod error;
#[cfg(feature = "authoring")]
pub mod exr;
mod image;
mod kind;
#[cfg(feature = "authoring")]
mod open;
mod pfm;
mod png;
mod rows;
mod signature;

pub use encode::{Quantiser, WORDS_IN_BYTE, byte, level};
pub use error::PictureError;
pub use image::Image;
pub use kind::{Kind, encode, encode_by, read_exact, write};
#[cfg(feature = "authoring")]
pub use open::most_bytes;
pub use rows::Rows;
