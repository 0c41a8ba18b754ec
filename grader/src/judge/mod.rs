//! From what a program did to what it is worth: findings and verdicts. Runs nothing, reads no file.

mod ending;
mod judgement;
mod numbers;
mod picture;
mod unit;

pub use ending::{ending, todo};
pub use judgement::Judgement;
pub use picture::{Comparison, Difference, RowsCompared, compare, picture};
pub use unit::{alike, lines, unit};
