//! Questions that are hard for floats, an oracle that answers them exactly, and the reference
//! against it.
//!
//! | module | holds |
//! |---|---|
//! | [`question`], [`mod@evaluate`] | a question with its numbers; what the reference's functions say to it |
//! | [`exact`], [`oracle`] | arithmetic without rounding; the right answer |
//! | [`draws`], [`families`] | kinds of hard questions, drawn at random but the same everywhere |
//! | [`mod@survey`] | many of them, and what came of it |

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
pub use survey::{Tally, survey};
