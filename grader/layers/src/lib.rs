//! What a diagnosis does with pixels: pictures of a program beside the stored effects of known
//! mistakes, and mistakes that change whole pictures. Pure functions, which the grader's diagnosis
//! calls millions of times; as a crate of their own they are compiled for speed.
//!
//! | file | holds |
//! |---|---|
//! | `colour.rs` | colours in whole levels, and their distance |
//! | `sheet.rs` | the answer to a case, and the layers of the mistakes: what each changes there |
//! | `counts.rs` | the counts for and against a mistake in one place, and their weight |
//! | `marks.rs` | what the mistakes named so far do to a picture |
//! | `shot.rs` | the picture of a program beside its sheet |
//! | `speckle.rs` | the mistake whose pixels depend on rounding |
//! | `ring.rs` | the surroundings of what a mistake explains |
//! | `regions.rs` | connected regions of pixels |
//! | `film/` | mistakes that change a whole picture after its light is computed |

mod colour;
pub mod counts;
pub mod film;
mod marks;
pub mod regions;
pub mod ring;
mod sheet;
mod shot;
pub mod speckle;

pub use colour::{Colour, apart, colours};
pub use marks::Marks;
pub use sheet::{Layer, STRONG, Sheet};
pub use shot::Shot;
