//! The benchmark beside other renderers: scenes, peers, measurements, and the page with the
//! results.

pub mod bars;
pub mod bench;
pub mod child;
pub mod effects;
pub mod export;
pub mod page;
pub mod pictures;
pub mod ply;
pub mod rays;
pub mod renderers;
pub mod report;
pub mod scenes;
pub mod search;
pub mod series;
pub mod small;
pub mod stone;
pub mod worker;
