//! Reads layers that are black nearly everywhere, without a list of all of their samples.

use std::io::Cursor;

use ::exr::block::UncompressedBlock;
use ::exr::block::chunk::Chunk;
use ::exr::block::reader::ChunksReader;
use ::exr::error::Error;
use ::exr::meta::header::Header;
use ::exr::prelude::{SampleType, f16};

use super::{broken, demand, guarded, name, plane_name};
use crate::film::PictureError;

/// Bytes of a sample in half precision.
const SAMPLE: usize = 2;

/// The pixels of a layer at which a channel is not 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse {
    /// The name of the layer.
    pub name: String,
    /// Indices of the pixels, row by row from the top, ascending.
    pub pixels: Vec<u32>,
    /// The red, green and blue sample of each of the pixels.
    pub samples: Vec<[f32; 3]>,
}

/// Decodes all layers of the part `part`, ordered by name. The planes of each layer are its red,
/// green and blue in half precision. A file without the part gives an empty list.
///
/// # Errors
/// See [`decode`](super::decode). It is also an error if a plane is of another kind or the blocks
/// are not in the order of their rows.
pub fn decode_sparse(
    bytes: &[u8],
    width: u32,
    height: u32,
    part: &str,
) -> Result<Vec<Sparse>, PictureError> {
    let headers = demand(bytes, (width, height))?;
    let Some(at) = headers.iter().position(|header| name(header) == part) else {
        return Ok(vec![]);
    };
    let planes = places(&headers[at], part)?;
    let mut layers: Vec<Sparse> = planes
        .iter()
        .map(|(name, _)| Sparse { name: name.clone(), pixels: vec![], samples: vec![] })
        .collect();
    let mut band = Band {
        width: width as usize,
        n_planes: headers[at].channels.list.len(),
        top: 0,
        blocks: vec![],
    };
    guarded(|| {
        let reader = ::exr::block::read(Cursor::new(bytes), true)?;
        let mut chunks = reader.filter_chunks(true, |_, _, block| block.layer == at)?;
        let meta = chunks.meta_data().clone();
        chunks.try_for_each(|chunk: Result<Chunk, Error>| {
            let block = UncompressedBlock::decompress_chunk(chunk?, &meta, true)?;
            if !band.take(block) {
                return Err(Error::Invalid("order of blocks".into()));
            }
            if band.is_whole() {
                for (layer, (_, planes)) in layers.iter_mut().zip(&planes) {
                    band.add_to(layer, *planes);
                }
                band.end();
            }
            Ok(())
        })
    })?;
    let is_whole = band.top == height as usize && band.blocks.is_empty();
    if is_whole { Ok(layers) } else { Err(broken(Error::Invalid("number of rows".into()))) }
}

/// The blocks that lie side by side in a picture.
struct Band {
    /// The width of the picture.
    width: usize,
    n_planes: usize,
    /// The first row of the blocks.
    top: usize,
    /// The blocks from the left.
    blocks: Vec<UncompressedBlock>,
}

impl Band {
    /// Returns the number of columns of the blocks.
    fn n_columns(&self) -> usize {
        self.blocks.iter().map(|block| block.index.pixel_size.x()).sum()
    }

    fn is_whole(&self) -> bool {
        self.n_columns() == self.width
    }

    /// Adds the next block, or returns `false` if it is another one.
    fn take(&mut self, block: UncompressedBlock) -> bool {
        let (place, size) = (block.index.pixel_position, block.index.pixel_size);
        let is_next = (place.x(), place.y()) == (self.n_columns(), self.top)
            && place.x() + size.x() <= self.width
            && block.data.len() == size.area() * self.n_planes * SAMPLE
            && self.blocks.first().is_none_or(|first| first.index.pixel_size.y() == size.y());
        self.blocks.push(block);
        is_next
    }

    /// Adds the pixels of a layer that are not black. `planes` are the indices of its planes.
    fn add_to(&self, layer: &mut Sparse, planes: [usize; 3]) {
        let height = self.blocks.first().map_or(0, |block| block.index.pixel_size.y());
        for row in 0..height {
            for block in &self.blocks {
                let bytes = block.index.pixel_size.x() * SAMPLE;
                let line = &block.data[row * self.n_planes * bytes..];
                let first = (self.top + row) * self.width + block.index.pixel_position.x();
                add(layer, first, planes.map(|plane| &line[plane * bytes..][..bytes]));
            }
        }
    }

    /// Ends the band. The next one lies below.
    fn end(&mut self) {
        self.top += self.blocks.first().map_or(0, |block| block.index.pixel_size.y());
        self.blocks.clear();
    }
}

/// Returns the layers of a part, each with the indices of its red, green and blue plane.
fn places(header: &Header, part: &str) -> Result<Vec<(String, [usize; 3])>, PictureError> {
    let list = &header.channels.list;
    let is_half = |plane: &::exr::meta::attribute::ChannelDescription| {
        plane.sample_type == SampleType::F16 && (plane.sampling.x(), plane.sampling.y()) == (1, 1)
    };
    if header.deep || !list.iter().all(is_half) {
        return Err(PictureError::Broken(format!("part \"{part}\" has a plane of another kind")));
    }
    let place = |wanted: String| {
        let none = || PictureError::Broken(format!("part \"{part}\" has no plane {wanted}"));
        list.iter().position(|plane| plane.name.eq(wanted.as_str())).ok_or_else(none)
    };
    let names = list.iter().map(|plane| plane.name.to_string());
    names
        .filter_map(|name| name.strip_suffix(".R").map(str::to_owned))
        .map(|name| {
            let [red, green, blue] = ["R", "G", "B"].map(|one| place(plane_name(&name, one)));
            Ok((name, [red?, green?, blue?]))
        })
        .collect()
}

/// Adds the pixels of a line that are not black. `first` is the index of the first of them, and
/// `planes` are the bytes of the samples.
fn add(layer: &mut Sparse, first: usize, planes: [&[u8]; 3]) {
    if planes.iter().all(|plane| is_zero(plane)) {
        return;
    }
    let [red, green, blue] = planes.map(|plane| plane.chunks_exact(SAMPLE));
    for (n, ((r, g), b)) in red.zip(green).zip(blue).enumerate() {
        let bits = [r, g, b].map(|sample| u16::from_ne_bytes([sample[0], sample[1]]));
        if bits != [0; 3] {
            layer.pixels.push((first + n) as u32);
            layer.samples.push(bits.map(|bits| f16::from_bits(bits).to_f32()));
        }
    }
}

/// Returns whether all bytes are 0. Without an early exit, many bytes are tested at once.
fn is_zero(bytes: &[u8]) -> bool {
    bytes.iter().fold(0, |all, byte| all | byte) == 0
}

#[cfg(test)]
mod tests {
    use super::super::{Depth, Part, Plane, encode};
    use super::*;

    /// Returns a file with the planes of one part, each given as name and samples of 3 × 2 pixels.
    fn file(planes: &[(&str, [f32; 6])], depth: Depth) -> Vec<u8> {
        let plane = |(name, samples): &(&str, [f32; 6])| Plane {
            name: (*name).to_owned(),
            samples: samples.to_vec(),
            depth,
        };
        let planes = planes.iter().map(plane).collect();
        encode((3, 2), &[Part { name: "layers".to_owned(), planes }], "").unwrap()
    }

    #[test]
    fn pixels_that_are_not_black_come_back() {
        let none = [0.0; 6];
        let planes = [
            ("ab.R", [0.0, 0.5, 0.0, 0.0, 0.0, 0.25]),
            ("ab.G", none),
            ("ab.B", [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
            ("a.R", none),
            ("a.G", none),
            ("a.B", none),
        ];
        let bytes = file(&planes, Depth::Half);
        let expected = [
            Sparse { name: "a".to_owned(), pixels: vec![], samples: vec![] },
            Sparse {
                name: "ab".to_owned(),
                pixels: vec![1, 5],
                samples: vec![[0.5, 0.0, 0.0], [0.25, 0.0, 1.0]],
            },
        ];
        assert_eq!(decode_sparse(&bytes, 3, 2, "layers").unwrap(), expected);
        assert_eq!(decode_sparse(&bytes, 3, 2, "others").unwrap(), []);
        assert!(matches!(
            decode_sparse(&bytes, 2, 3, "layers"),
            Err(PictureError::Size { found: (3, 2), wanted: (2, 3) })
        ));
    }

    #[test]
    fn pixels_are_ascending_across_the_blocks_of_a_file() {
        let (width, height) = (150, 130);
        let samples: Vec<f32> =
            (0..width * height).map(|n| f32::from(u8::from(n % 7 == 0))).collect();
        let plane = |name: &str| Plane {
            name: name.to_owned(),
            samples: samples.clone(),
            depth: Depth::Half,
        };
        let part = |name: &str| Part {
            name: name.to_owned(),
            planes: ["a.R", "a.G", "a.B"].map(plane).into(),
        };
        let bytes = encode((width, height), &[part("first"), part("second")], "").unwrap();
        let layers = decode_sparse(&bytes, width, height, "second").unwrap();
        let expected: Vec<u32> = (0..width * height).step_by(7).collect();
        assert_eq!(layers[0].pixels, expected);
    }

    #[test]
    fn a_layer_needs_three_planes_in_half_precision() {
        let planes = ["a.R", "a.G", "a.B"].map(|name| (name, [0.0; 6]));
        for (bytes, says) in [
            (file(&planes[..2], Depth::Half), "has no plane a.B"),
            (file(&planes, Depth::Float), "a plane of another kind"),
        ] {
            let why = decode_sparse(&bytes, 3, 2, "layers").unwrap_err().to_string();
            assert!(why.contains(says), "{why}");
        }
    }

    #[test]
    fn every_cut_and_every_broken_byte_is_an_error_or_a_list_but_no_panic() {
        let planes = ["a.R", "a.G", "a.B"].map(|name| (name, [0.5; 6]));
        let bytes = file(&planes, Depth::Half);
        for end in 0..bytes.len() {
            assert!(decode_sparse(&bytes[..end], 3, 2, "layers").is_err(), "cut at {end}");
        }
        for at in 0..bytes.len() {
            let mut broken = bytes.clone();
            broken[at] ^= 0x55;
            let _ = decode_sparse(&broken, 3, 2, "layers");
        }
    }
}
