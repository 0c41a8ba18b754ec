//! Names the known mistakes that explain the errors of a submission, part by part: each mistake is
//! weighed over the pixels, cases and checks where it can show. Pure functions: they turn results
//! and the stored effects of the mistakes into diagnoses. The crate `layers` holds what they do
//! with pixels.
//!
//! | file | holds |
//! |---|---|
//! | `reply.rs` | the answer of a program to a unit check |
//! | `place.rs` | a picture or a reply: the places where a mistake can show |
//! | `score.rs` | the value of a mistake over all places |
//! | `choose.rs` | the mistakes that explain most, one after the other |
//! | `second_look.rs` | each choice, weighed beside all others |
//! | `film_names.rs` | the names and sentences of mistakes that change whole pictures |
//! | `result.rs` | the diagnoses, and what remains unexplained |
//! | `run.rs` | all steps in order |
//! | `confirm.rs` | the named mistakes, rendered together: which to drop, which are hidden |

mod choose;
mod confirm;
mod film_names;
mod place;
mod reply;
mod result;
mod run;
mod score;
mod second_look;

pub use confirm::{Render, confirm};
pub use layers::Sheet;
pub use reply::Reply;
pub use run::{Explanation, diagnose};
