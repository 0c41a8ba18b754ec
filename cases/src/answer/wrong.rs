//! The pixels that known mistakes change in the picture of a case, as the answer file stores them.
//!
//! They are bytes attached to a part of the file: for each mistake the length of its id, the id,
//! the length of its layer and the layer. A layer has a byte for each channel of each pixel, row by
//! row, and is deflated by itself. Planes of half floats would take three times the bytes: they
//! separate the channels, and each number takes two bytes. The one plane of the part, `Y`, holds
//! the number of mistakes that change each pixel.

use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use super::levels::{Levels, byte_plane};
use crate::film::PictureError;
use crate::film::exr::{self, Part};

/// The pixels that a known mistake changes in the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The id of the mistake.
    pub id: String,
    /// Indices of the changed pixels, row by row from the top, ascending.
    pub pixels: Vec<u32>,
    /// The colour that the mistake gives each of them. The file stores every eighth level.
    pub colours: Vec<Levels>,
}

/// Step in levels to which the colours of mistakes are rounded in the file.
const COARSE: u16 = 8;
/// The byte of a channel that is black in a changed pixel; 0 stands for a pixel without a change.
const BLACK: u8 = 33;
/// The level of the compressor that gives the fewest bytes.
const SMALLEST: u8 = 10;
const MISTAKES: &str = "mistakes";

/// The id of a mistake and its packed layer.
type Layer<'b> = (String, &'b [u8]);

impl Wrong {
    /// Returns the mistake `id` by its change of each pixel, row by row from the top; `None` for a
    /// pixel that stays right.
    pub fn new(id: &str, changes: impl IntoIterator<Item = Option<Levels>>) -> Self {
        let changed = changes.into_iter().enumerate();
        let changed = changed.filter_map(|(n, levels)| Some((n as u32, levels?)));
        let (pixels, colours) = changed.unzip();
        Self { id: id.to_owned(), pixels, colours }
    }

    /// Returns, for each of the `n` pixels of the picture, whether the mistake changes it.
    pub fn mask(&self, n: usize) -> Vec<bool> {
        let mut mask = vec![false; n];
        self.pixels.iter().for_each(|at| mask[*at as usize] = true);
        mask
    }

    /// Returns the ids of the mistakes in a stored answer, without decompressing their pictures. A
    /// mistake with which the case passes is not stored.
    ///
    /// # Errors
    /// The file is broken.
    pub fn ids(bytes: &[u8]) -> Result<Vec<String>, PictureError> {
        Ok(layers(&attached(bytes)?)?.into_iter().map(|(id, _)| id).collect())
    }

    /// Decodes the pictures of all mistakes in a stored answer of `width` × `height` pixels,
    /// ordered by id. A file without mistakes gives an empty list.
    ///
    /// # Errors
    /// The file is broken, or a layer has another size.
    pub fn decode_all(bytes: &[u8], width: u32, height: u32) -> Result<Vec<Self>, PictureError> {
        let attached = attached(bytes)?;
        let n_pixels = width as usize * height as usize;
        let wrong = |(id, packed): (String, &[u8])| {
            unpacked(&id, packed, n_pixels).ok_or_else(|| {
                PictureError::Broken(format!("the layer of {id} does not fit the picture"))
            })
        };
        let mut all = layers(&attached)?
            .into_iter()
            .map(wrong)
            .collect::<Result<Vec<Self>, PictureError>>()?;
        all.sort_by(|a, b| a.id.cmp(&b.id));
        Ok(all)
    }
}

/// Returns the part that stores these mistakes of a picture of `n_pixels`, or `None` for none.
///
/// # Errors
/// A pixel lies outside the picture, or an id is longer than 255 bytes.
pub(super) fn part(wrong: &[Wrong], n_pixels: usize) -> Result<Option<Part>, PictureError> {
    if wrong.is_empty() {
        return Ok(None);
    }
    let mut counts = vec![0u8; n_pixels];
    let mut attached = Vec::new();
    for one in wrong {
        let fits = one.pixels.iter().all(|pixel| (*pixel as usize) < n_pixels);
        let length = u8::try_from(one.id.len()).ok().filter(|_| fits).ok_or_else(|| {
            PictureError::Broken(format!("the layer of {} cannot be stored", one.id))
        })?;
        for pixel in &one.pixels {
            let count = &mut counts[*pixel as usize];
            *count = count.saturating_add(1);
        }
        let packed = packed(one, n_pixels);
        attached.push(length);
        attached.extend(one.id.as_bytes());
        attached.extend((packed.len() as u32).to_le_bytes());
        attached.extend(packed);
    }
    let planes = vec![byte_plane("Y".to_owned(), counts.into_iter())];
    Ok(Some(Part { name: MISTAKES.to_owned(), planes, attached }))
}

fn attached(bytes: &[u8]) -> Result<Vec<u8>, PictureError> {
    exr::attached(bytes, MISTAKES)
}

/// Returns the id and the packed layer of each mistake.
fn layers(mut attached: &[u8]) -> Result<Vec<Layer<'_>>, PictureError> {
    let mut all = Vec::new();
    while !attached.is_empty() {
        let (layer, rest) = next_layer(attached)
            .ok_or_else(|| PictureError::Broken("the list of mistakes ends early".to_owned()))?;
        all.push(layer);
        attached = rest;
    }
    Ok(all)
}

/// Returns the first layer and the bytes behind it, or `None` where they end early or the id is no
/// text.
fn next_layer(bytes: &[u8]) -> Option<(Layer<'_>, &[u8])> {
    let (length, rest) = bytes.split_first()?;
    let (id, rest) = rest.split_at_checked(usize::from(*length))?;
    let (length, rest) = rest.split_first_chunk::<4>()?;
    let (packed, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
    Some(((std::str::from_utf8(id).ok()?.to_owned(), packed), rest))
}

fn packed(wrong: &Wrong, n_pixels: usize) -> Vec<u8> {
    let coarse = |level: u8| match (u16::from(level) + COARSE / 2) / COARSE {
        0 => BLACK,
        n => n as u8, // at most 32
    };
    let mut bytes = vec![[0; 3]; n_pixels];
    for (pixel, levels) in wrong.pixels.iter().zip(&wrong.colours) {
        bytes[*pixel as usize] = levels.map(coarse);
    }
    compress_to_vec_zlib(bytes.as_flattened(), SMALLEST)
}

/// Returns the changes in a packed layer, or `None` if it is broken or has another number of
/// pixels.
fn unpacked(id: &str, packed: &[u8], n_pixels: usize) -> Option<Wrong> {
    let bytes = decompress_to_vec_zlib_with_limit(packed, 3 * n_pixels).ok()?;
    let fine = |byte: u8| match byte {
        BLACK => 0,
        n => u8::try_from(u16::from(n) * COARSE).unwrap_or(u8::MAX),
    };
    let (pixels, []) = bytes.as_chunks::<3>() else { return None };
    let change = |pixel: &[u8; 3]| (*pixel != [0; 3]).then(|| pixel.map(fine));
    (pixels.len() == n_pixels).then(|| Wrong::new(id, pixels.iter().map(change)))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::Course;
    use crate::answer::{Digest, ImageAnswer};
    use crate::film::Image;

    fn file(wrong: &[Wrong], width: u32) -> Vec<u8> {
        let answer = ImageAnswer::exact(Image::from_fn(width, 1, |_, _| DVec3::ZERO), 1.0, 0);
        answer.encode(&Digest::of_mistakes(&Course::default()), wrong).unwrap()
    }

    #[test]
    fn mistakes_come_back_in_order() {
        let (a, b) = (Some([8, 0, 248]), Some([0, 0, 0]));
        let all = [Wrong::new("z", [a, None, b]), Wrong::new("a", [None, None, b])];
        let bytes = file(&all, 3);
        assert_eq!(Wrong::ids(&bytes).unwrap(), ["z", "a"]);
        let [z, a] = all;
        assert_eq!(z.mask(3), [true, false, true]);
        assert_eq!(Wrong::decode_all(&bytes, 3, 1).unwrap(), [a, z]);
        assert!(Wrong::decode_all(&bytes, 4, 1).is_err());
        assert!(Wrong::decode_all(&bytes, 2, 1).is_err());
    }

    #[test]
    fn a_change_is_stored_in_steps_and_never_lost() {
        let given = [[0, 0, 0], [1, 2, 3], [254, 255, 253], [130, 129, 127]];
        let wrong = Wrong::new("x", given.map(Some).into_iter().chain([None]));
        let back = Wrong::decode_all(&file(&[wrong], 5), 5, 1).unwrap();
        assert_eq!(back[0].pixels, [0, 1, 2, 3]);
        assert_eq!(back[0].colours, [[0; 3], [0; 3], [255; 3], [128; 3]]);
    }

    #[test]
    fn a_list_that_ends_early_is_broken() {
        let wrong = Wrong::new("x", [None, Some([9; 3])]);
        let part = part(std::slice::from_ref(&wrong), 2).unwrap().unwrap();
        assert_eq!(layers(&part.attached).unwrap().len(), 1);
        for end in 1..part.attached.len() {
            assert!(layers(&part.attached[..end]).is_err(), "cut at {end}");
        }
        assert!(super::part(&[wrong], 1).is_err(), "a pixel outside the picture");
    }
}
