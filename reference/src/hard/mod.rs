//! Questions that are hard for floats, and an exact oracle that the reference's answers are
//! compared with.
//!
//! | module | holds |
//! |---|---|
//! | [`question`], [`mod@evaluate`] | a question with its numbers; its answer by the reference's functions |
//! | [`exact`], [`oracle`] | arithmetic without rounding; the correct answer |
//! | [`draws`], [`families`] | kinds of hard questions, drawn at random, but the same on every machine |
//! | [`mod@survey`] | many questions of a family, and the tally of the answers |

pub mod draws;
pub mod evaluate;
pub mod exact;
pub mod families;
pub mod oracle;
mod oracle_round;
pub mod question;
pub mod survey;

pub use evaluate::evaluate;
pub use families::{FAMILIES, Family};
pub use question::Question;
pub use survey::{SurveyCounts, survey};
