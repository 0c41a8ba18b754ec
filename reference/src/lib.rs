//! The reference tracer: computes pictures, ray trees and answers by the numbered rules of
//! `docs/shading-model.md`.
//!
//! Each wing depends only on wings above it in this table. `tests/tests/imports` checks it.
//!
//! | wing | contents |
//! |---|---|
//! | [`numbers`] | single and double precision from one source, vectors, quadratics |
//! | [`lanes`] | tests of eight boxes or four triangles at once |
//! | [`rules`] | the rules as a value, the choices of a course, and known mistakes |
//! | [`rays`] | rays, frames and the camera |
//! | [`bvh`] | a tree over boxes, which knows nothing of the primitives in them |
//! | [`shapes`] | intersections of rays with shapes; no materials |
//! | [`watch`] | counters and recorders that are called during tracing |
//! | [`light`] | formulas of light, which cast no ray |
//! | [`world`] | objects and meshes, and searches for hits |
//! | [`trace`] | the kernel, pictures and answers |
//! | [`hard`] | questions that are hard for floats, and an oracle with exact answers |
//! | [`expect`] | expected pictures with their envelopes |
//! | [`cost`] | the time that accuracy costs |
//! | [`vary`] | varied cases, for hidden sets |
//! | [`cli`] | the command line |

pub mod bvh;
pub mod cli;
pub mod cost;
pub mod expect;
pub mod hard;
pub mod lanes;
pub mod light;
pub mod numbers;
pub mod rays;
pub mod rules;
pub mod shapes;
#[cfg(test)]
mod testing;
pub mod trace;
pub mod vary;
pub mod watch;
pub mod world;
