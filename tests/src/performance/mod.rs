//! The benchmark beside other renderers: scenes, peers, measurements, and the page made of them.

pub mod dice;
pub mod ply;
pub mod scenes;
pub mod stone;
