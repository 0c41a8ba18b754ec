//! The reference tracer: pictures, ray trees and answers by the numbered rules of
//! `docs/shading-model.md`.
//!
//! | module | holds |
//! |---|---|
//! | [`real`], [`vec3`] | single and double precision from one source |
//! | [`two`] | two words a number, for what one cannot decide |
//! | [`rules`], [`misconceptions`] | the rules as a value, and the ways in which they are got wrong |
//! | [`ray`], [`roots`] | where a ray's interval begins and ends; the one solver of quadratics |
//! | [`packet`] | rays from one point, searched for together |
//! | [`shapes`], [`mesh`] | where a ray meets a shape; no materials |
//! | [`frame`], [`bounds`], [`bvh`], [`object`], [`world`], [`search`] | the nearest hit |
//! | [`camera`], [`lights`], [`shade`], [`optics`], [`snell`] | formulas; they cast no ray |
//! | [`trace`], [`render`], [`simulated`], [`watch`], [`work`] | the kernel, pictures, and who looks on |
//! | [`cutoff`] | how far a ray that is not cast can matter |
//! | [`variations`] | other ways of computing the same pictures |
//! | [`cost`] | what accuracy costs in time |
//! | [`vary`] | other cases of the same kind, for hidden sets |
//! | [`hard`] | questions that are hard for floats, and an oracle that answers them exactly |

pub mod answers;
pub mod bounds;
pub mod bvh;
pub mod camera;
pub mod cli;
pub mod cost;
pub mod cutoff;
pub mod expect;
pub mod frame;
pub mod hard;
pub mod lights;
pub mod mesh;
pub mod misconceptions;
pub mod object;
pub mod optics;
pub mod packet;
pub mod ray;
pub mod real;
pub mod render;
pub mod roots;
pub mod rules;
pub mod search;
pub mod shade;
pub mod shapes;
pub mod simulated;
pub mod snell;
mod stream;
#[cfg(test)]
mod testing;
pub mod trace;
mod triangles;
pub mod two;
pub mod variations;
pub mod vary;
pub mod vec3;
pub mod watch;
pub mod work;
pub mod world;
