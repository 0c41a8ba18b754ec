//! Measures the speed of the reference beside other renderers.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use tests::performance::{scenes, worker};

/// Measures the speed of the reference beside other renderers
#[derive(Parser)]
struct Arguments {
    /// Write the scenes and their meshes into this folder, and measure nothing
    #[arg(long, value_name = "DIR")]
    scenes: Option<PathBuf>,
    #[arg(long, hide = true, num_args = 1..)]
    worker: Option<Vec<String>>,
    /// Write the scene in the formats of others
    #[arg(long, hide = true)]
    export: Option<PathBuf>,
}

fn main() -> ExitCode {
    match act(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

fn act(arguments: &Arguments) -> Result<(), String> {
    if let Some(words) = &arguments.worker {
        println!("{}", worker::work(words)?);
        return Ok(());
    }
    if let Some(path) = &arguments.export {
        let scene = cases::scene::load(path).map_err(|why| why.to_string())?;
        for r in tests::performance::renderers::Renderer::ALL {
            for (name, bytes) in r.export(&scene)? {
                std::fs::write(path.with_extension("").join(name), bytes).map_err(|e| e.to_string())?;
            }
        }
    }
    arguments.scenes.as_deref().map_or(Ok(()), scenes::write)
}
