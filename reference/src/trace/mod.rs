//! The kernel that traces rays, and the pictures and answers that it makes.
//!
//! | module | contents |
//! |---|---|
//! | [`kernel`] | the recursion over rays |
//! | [`render`] | pictures, tile by tile |
//! | [`answers`] | answers to the questions of unit checks |
//! | [`cutoff`] | bounds on the light of rays that are not cast |
//! | [`simulated`] | the set of simulated effects, as a value or as a type |

pub mod answers;
pub mod cutoff;
pub mod kernel;
pub mod render;
pub mod simulated;
