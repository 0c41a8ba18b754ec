//! Film mistakes: what a program does to its whole picture after the light is computed. They are
//! found first and undone, so that mistakes beside them become visible.
//!
//! | file | holds |
//! |---|---|
//! | `frame.rs` | a picture beside its sheet, with its out pixels |
//! | `rows.rs` | the last rows of all pictures are missing |
//! | `moves.rs` | pixels or channels stand in other places |
//! | `find_move.rs` | the move that puts most pixels right |
//! | `wrap.rs` | light above full becomes dark |
//! | `curve.rs` | all levels pass through a curve |
//! | `kind.rs` | the film mistakes that are found |
//! | `undo.rs` | all of these in order |

mod curve;
mod find_move;
mod frame;
mod kind;
mod moves;
mod rows;
mod undo;
mod wrap;

pub use frame::Frame;
pub use kind::{FilmMistake, Kind};
pub use moves::Move;
pub use undo::{Undone, undo};
