//! The kernel that traces rays, and the pictures and answers that it makes.
//!
//! | module | contents |
//! |---|---|
//! | [`kernel`] | the recursion over rays |
//! | [`render`] | pictures, tile by tile |
//! | [`adaptive`] | more rays for the pixels that differ from a neighbour |
//! | [`answers`] | answers to the questions of unit checks |
//! | [`cutoff`] | bounds on the light of rays that are not cast |
//! | [`forecast`] | the expected number of rays of a picture |
//! | `options` | what to simulate, and how finely |
//! | [`simulated`] | the set of simulated effects, as a value or as a type |
//! | `tiles` | the tiles of a picture, and the rays of a pixel |

pub mod adaptive;
pub mod answers;
pub mod cutoff;
pub mod forecast;
pub mod kernel;
mod options;
pub mod render;
pub mod simulated;
mod tiles;
