//! Puts the cases to a program: each picture in a process and folder of its own, the unit checks of
//! a stage in one process where it holds out.

mod allowance;
mod attempt;
mod explain;
mod failure;
mod functions;
mod pictures;
mod probes;
pub mod replies;

pub use allowance::{Allowance, Candidate, N_TIMEOUTS, reduced};
pub use explain::explain;
pub use failure::{Failure, Start, order};
pub use pictures::{NoPicture, Shot, read, shoot};
pub use probes::{Ended, LeftOut, Probed, probe};
pub use replies::Got;

#[cfg(test)]
mod tests;
