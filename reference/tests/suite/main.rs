//! Tests of the reference as a whole: of its library from outside, and of its commands.
//!
//! They are one program, because each program of tests would compile the tracer's generic code
//! again. Name a module to run a part: `cargo test -p reference --test suite course::`.

mod adaptive;
mod called_for;
mod catalogue;
mod catalogue_scenes;
mod cli;
mod cli_files;
mod common;
mod cost;
mod cost_commands;
mod course;
mod crowded;
mod cutoff;
mod effects;
mod expect_commands;
mod explosion;
mod families;
mod formulas;
mod idle;
mod leaving;
mod manners;
mod misconceptions;
mod needless;
mod optics;
mod paper;
mod rules_version;
mod scaling;
mod search;
mod specialised;
mod stable_pictures;
mod surfaces;
mod together;
mod variations;
mod vary;
mod watertight;
mod work;
