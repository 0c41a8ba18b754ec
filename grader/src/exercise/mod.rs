//! Runs a program on the cases. Each picture gets its own process and folder; the unit checks of a
//! stage share one process, unless it dies.

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
pub use pictures::{NoPicture, Rendered, read, render_case};
pub use probes::{Ended, LeftOut, Probed, probe};
pub use replies::Got;

#[cfg(test)]
mod tests;
