//! Measures the speed of the reference beside other renderers.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use tests::performance::scenes;

/// Measures the speed of the reference beside other renderers
#[derive(Parser)]
struct Arguments {
    /// Write the scenes and their meshes into this folder, and measure nothing
    #[arg(long, value_name = "DIR")]
    scenes: PathBuf,
}

fn main() -> ExitCode {
    match scenes::write(&Arguments::parse().scenes) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}
