//! The film mistakes that are found.

use super::moves::Move;

/// A mistake that a program makes in all of its pictures after the light is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmMistake {
    /// The kind of the mistake.
    pub kind: Kind,
    /// The cases that it explains, each with its number of explained pixels.
    pub cases: Vec<(String, usize)>,
    /// The share of the out pixels of all cases that it explains, 0 to 1.
    pub share: f64,
}

/// The kinds of film mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Pixels or channels stand in other places.
    Moved(Move),
    /// The last rows are missing; the number of rows in most cases.
    RowsMissing(usize),
    /// Light above full becomes dark.
    Wrapped,
    /// All levels pass through a curve; what it makes of level 128 in each channel.
    Curve([i16; 3]),
}
