//! Numbers: single and double precision from one source, vectors, and arithmetic in two words of
//! f64.
//!
//! | module | holds |
//! |---|---|
//! | [`real`] | [`real::Real`], which f32 and f64 implement |
//! | [`two`] | numbers of two words, for decisions that one word leaves open |
//! | [`vec3`] | vectors of three components |
//! | [`roots`] | the one solver of quadratics [rule 14] |
//! | [`bounds`] | boxes that are aligned with the axes |
//! | [`stream`] | pseudorandom numbers that are the same on every machine |

pub mod bounds;
pub mod real;
pub mod roots;
pub mod stream;
pub mod two;
pub mod vec3;
