//! Counts the instructions of a fixed set of scenes and compares them with the committed budget,
//! `tests/instructions.toml`.

use std::process::ExitCode;

use clap::Parser;
use tests::instructions::{self, Budget, Scene};

/// Counts the instructions that the reference takes for a fixed set of scenes, and compares them
/// with tests/instructions.toml
#[derive(Parser)]
struct Arguments {
    /// Replace the counts in the file
    #[arg(long)]
    bless: bool,
}

fn main() -> ExitCode {
    match check(&Arguments::parse()) {
        Ok(complaints) if complaints.is_empty() => ExitCode::SUCCESS,
        Ok(complaints) => {
            println!("{complaints}");
            ExitCode::FAILURE
        }
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

/// Returns the complaints about counts beyond the budget; empty if there are none.
fn check(arguments: &Arguments) -> Result<String, String> {
    let path = instructions::path();
    let unreadable = |why: std::io::Error| format!("{}: {why}", path.display());
    let budget = instructions::parse(&std::fs::read_to_string(&path).map_err(unreadable)?)?;
    let (toolchain, program) = (instructions::toolchain()?, instructions::build()?);
    let folder = tempfile::tempdir().map_err(|why| why.to_string())?;
    let mut counts = Vec::new();
    for scene in &budget.scene {
        let count = instructions::count(&program, scene, folder.path())?;
        println!("{:>15} {}", count, scene.title());
        counts.push(count);
    }
    if !arguments.bless {
        return Ok(instructions::complaints(&budget, &counts, &toolchain));
    }
    let scenes = budget.scene.into_iter().zip(counts);
    let scene = scenes.map(|(scene, instructions)| Scene { instructions, ..scene }).collect();
    let text = instructions::to_text(&Budget { toolchain, scene })?;
    cases::files::write(&path, text.as_bytes()).map_err(|why| why.to_string())?;
    println!("wrote {}", path.display());
    Ok(String::new())
}
