//! Writes pictures in every format that can be compared.
#![allow(dead_code)] // Each test file uses a part of this.

use cases::film::exr::{self, Depth, Part, rgb};
use cases::film::{Image, Kind, encode};

/// The format of a picture file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    Png,
    DeepPng,
    Pfm,
    Exr,
    HalfExr,
}

impl Form {
    /// Returns the content of the file of a picture.
    pub(crate) fn bytes(self, image: &Image) -> Vec<u8> {
        let exr = |depth| {
            let part = Part {
                name: "colour".to_owned(),
                planes: rgb("", image, depth).into(),
                attached: vec![],
            };
            exr::encode((image.width(), image.height()), &[part], "").unwrap()
        };
        match self {
            Self::Png => encode(Kind::Png, image).unwrap(),
            Self::DeepPng => encode(Kind::DeepPng, image).unwrap(),
            Self::Pfm => encode(Kind::Pfm, image).unwrap(),
            Self::Exr => exr(Depth::Float),
            Self::HalfExr => exr(Depth::Half),
        }
    }
}
