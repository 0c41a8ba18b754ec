//! Names the known mistakes that explain what is wrong. Pure functions: from what came back and
//! what mistakes would give, to a ranked list.

mod evidence;
mod picture;
mod rank;
mod unit;

pub use evidence::{Came, Evidence};
pub use picture::picture;
pub use rank::{Named, rank};
pub use unit::unit;
