//! The benchmark beside other renderers: scenes, peers, measurements, and the page made of them.

pub mod bench;
pub mod child;
pub mod dice;
pub mod export;
pub mod pictures;
pub mod ply;
pub mod rays;
pub mod renderers;
pub mod scenes;
pub mod search;
pub mod series;
pub mod stone;
pub mod worker;
