//! Names the known mistakes that explain the errors of a submission, part by part: each mistake is
//! weighed over the pixels, cases and checks where it can show. Pure functions: they turn results
//! and the stored effects of the mistakes into diagnoses.
//!
//! | file | holds |
//! |---|---|
//! | `colour.rs` | colours in whole levels, and their distance |
//! | `sheet.rs` | the answer to a case, and the layers of the mistakes: what each changes there |
//! | `counts.rs` | the counts for and against a mistake in one place, and their weight |
//! | `marks.rs` | what the mistakes named so far do to a picture |
//! | `shot.rs` | the picture of a program beside its sheet |
//! | `speckle.rs` | the mistake whose pixels depend on rounding |
//! | `reply.rs` | the answer of a program to a unit check |
//! | `place.rs` | a picture or a reply: the places where a mistake can show |
//! | `ring.rs` | the surroundings of what a mistake explains |
//! | `regions.rs` | connected regions of pixels |
//! | `score.rs` | the value of a mistake over all places |
//! | `choose.rs` | the mistakes that explain most, one after the other |
//! | `second_look.rs` | each choice, weighed beside all others |
//! | `film/` | mistakes that change a whole picture after its light is computed |
//! | `result.rs` | the diagnoses, and what remains unexplained |
//! | `run.rs` | all steps in order |

mod choose;
mod colour;
mod counts;
mod film;
mod marks;
mod place;
mod regions;
mod reply;
mod result;
mod ring;
mod run;
mod score;
mod second_look;
mod sheet;
mod shot;
mod speckle;

pub use reply::Reply;
pub use run::{Explanation, diagnose};
pub use sheet::Sheet;
