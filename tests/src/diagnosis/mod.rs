//! Judges the diagnosis: programs with several known mistakes at once, and right programs whose
//! pictures are spoilt.
//!
//! | file | holds |
//! |---|---|
//! | `desk.rs` | the public exam, which renders, judges and diagnoses in one process |
//! | `combinations.rs` | combinations of mistakes, and the names that they get |
//! | `nuisances.rs` | changes of whole pictures that are no mistakes of a tracer |

mod combinations;
mod desk;
mod nuisances;

pub use combinations::{Names, combinations, parts};
pub use desk::{Desk, in_bytes, names};
pub use nuisances::{NUISANCES, Nuisance};
