//! The pictures of known mistakes in the stored answer to an image case.

use super::picture::{Levels, MISTAKES, to_byte};
use crate::film::PictureError;
use crate::film::exr::{self, Sparse};

/// Step in levels to which the colours of mistakes are rounded in the file.
const COARSE: u16 = 8;

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
    /// See [`ImageAnswer::decode`](super::ImageAnswer::decode).
    pub fn ids(bytes: &[u8], width: u32, height: u32) -> Result<Vec<String>, PictureError> {
        let parts = exr::plane_names(bytes, width, height)?;
        let names =
            parts.into_iter().filter(|(part, _)| part == MISTAKES).flat_map(|(_, names)| names);
        Ok(names.filter_map(|name| name.strip_suffix(".R").map(str::to_owned)).collect())
    }

    /// Returns the levels to store for each of the `n` pixels of the picture: black where nothing
    /// changes. A change that rounds to black is stored as (1, 1, 1).
    pub(super) fn stored(&self, n: usize) -> Vec<Levels> {
        let coarse = |level: u8| {
            u8::try_from((u16::from(level) + COARSE / 2) / COARSE * COARSE).unwrap_or(u8::MAX)
        };
        let mut stored = vec![[0; 3]; n];
        for (at, levels) in self.pixels.iter().zip(&self.colours) {
            stored[*at as usize] = match levels.map(coarse) {
                [0, 0, 0] => [1; 3],
                levels => levels,
            };
        }
        stored
    }

    /// Decodes the pictures of all mistakes in a stored answer, ordered by id. A file without
    /// mistakes gives an empty list.
    ///
    /// # Errors
    /// See [`ImageAnswer::decode`](super::ImageAnswer::decode).
    pub fn decode_all(bytes: &[u8], width: u32, height: u32) -> Result<Vec<Self>, PictureError> {
        let wrong = |layer: Sparse| {
            let levels = layer.samples.into_iter().map(|samples| samples.map(to_byte));
            let changed = layer.pixels.into_iter().zip(levels);
            let (pixels, colours) = changed.filter(|(_, levels)| *levels != [0; 3]).unzip();
            Self { id: layer.name, pixels, colours }
        };
        Ok(exr::decode_sparse(bytes, width, height, MISTAKES)?.into_iter().map(wrong).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_stored_in_steps_and_never_as_black() {
        let given = [[0, 0, 0], [1, 2, 3], [254, 255, 253], [130, 129, 127]];
        let wrong = Wrong::new("x", given.map(Some).into_iter().chain([None]));
        let stored = [[1; 3], [1; 3], [255; 3], [128; 3], [0; 3]];
        assert_eq!(wrong.stored(5), stored);
        assert_eq!((wrong.pixels.len(), wrong.mask(5)), (4, vec![true, true, true, true, false]));
    }
}
