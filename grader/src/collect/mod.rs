//! Joins the hand-ins of a class, as platforms export them, to the students of a roster.
//!
//! ```text
//! roster (CSV) ──────┐
//! policy (TOML) ─────┤
//! names of files ──> hand-ins with claims ──> students with hand-ins ──> roll with points
//! Gradescope's metadata ┘
//! ```
//!
//! Everything here is a function of text: no file is read, and no clock. What is not certain is
//! never guessed, but listed as a decision for a person.

pub mod class;
pub mod export;
pub mod gradescope;
pub mod hand_in;
pub mod lateness;
pub mod matching;
pub mod moment;
mod notes;
pub mod policy;
pub mod roll;
pub mod roster;
pub mod table;
#[cfg(test)]
mod tests;
