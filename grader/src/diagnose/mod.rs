//! Names the known mistakes that explain the errors of a submission. Pure functions: they turn the
//! results and the expected effects of the mistakes into a ranked list.

mod evidence;
mod picture;
mod rank;
mod unit;

pub use evidence::{Correctness, Evidence};
pub use picture::picture;
pub use rank::{Named, rank};
pub use unit::unit;
