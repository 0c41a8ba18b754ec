//! Measures the speed of the reference beside other renderers, and writes `docs/performance.md`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use cases::files::{self, sources_digest};
use clap::{Parser, ValueEnum};
use tests::performance::bench::Bench;
use tests::performance::report::{Machine, Report};
use tests::performance::{bars, effects, page, pictures, scenes, search, small, worker};

/// Measures the speed of the reference beside other renderers, which it installs below
/// target/renderers
#[derive(Parser)]
struct Arguments {
    /// Write the scenes and their meshes into this folder, and measure nothing
    #[arg(long, value_name = "DIR")]
    scenes: Option<PathBuf>,
    /// The number of rounds in which all are measured, taking turns
    #[arg(
        long,
        value_name = "N",
        default_value_t = 3,
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    rounds: u16,
    /// Only these sections; may be given several times
    #[arg(long, value_enum, value_name = "SECTION")]
    only: Vec<Section>,
    /// Write the page here, and its picture beside it [default: the page goes to the output]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write everything that was measured here
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Our own side of a measurement, in a process of its own
    #[arg(long, hide = true, num_args = 1..)]
    worker: Option<Vec<String>>,
}

/// A section of the page.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Section {
    /// Whole scenes, beside POV-Ray, Tachyon and Mitsuba
    Pictures,
    /// Ray queries and tree building for meshes, and how their cost grows, beside Embree and crates
    Search,
    /// Whole commands, beside ODiff and dify
    Small,
    /// Effects that are not called for
    Effects,
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
    if let Some(folder) = &arguments.scenes {
        return scenes::write(folder);
    }
    if cfg!(debug_assertions) {
        return Err("times are meaningless without optimisation: `cargo run --release -p tests \
                --bin performance`"
            .to_owned());
    }
    let report = measure(arguments)?;
    if let Some(path) = &arguments.json {
        let text = serde_json::to_vec_pretty(&report).map_err(|why| why.to_string())?;
        put(path, &text)?;
    }
    write(&report, arguments.out.as_deref())?;
    let bars = bars::bars(&report);
    let missed: Vec<_> = bars.iter().filter(|bar| !bar.is_reached).collect();
    eprintln!("{} of {} bars are reached", bars.len() - missed.len(), bars.len());
    missed.iter().for_each(|bar| eprintln!("not reached: {}: {}", bar.requirement, bar.figure));
    Ok(())
}

/// Measures the requested sections, or all of them if none is named.
fn measure(arguments: &Arguments) -> Result<Report, String> {
    let machine = Machine::this();
    let bench = Bench::open(usize::from(arguments.rounds))?;
    let is_asked = |section| arguments.only.is_empty() || arguments.only.contains(&section);
    Ok(Report {
        schema: 1,
        machine,
        measured_on: sources_digest(tests::workspace()).map_err(|why| why.to_string())?,
        n_rounds: bench.n_rounds,
        pictures: is_asked(Section::Pictures).then(|| pictures::measure(&bench)).transpose()?,
        search: is_asked(Section::Search).then(|| search::measure(&bench)).transpose()?,
        small: is_asked(Section::Small).then(|| small::measure(&bench)).transpose()?,
        effects: is_asked(Section::Effects).then(|| effects::measure(&bench)).transpose()?,
    })
}

/// Writes the page, and beside it the picture that it shows.
fn write(report: &Report, out: Option<&Path>) -> Result<(), String> {
    let Some(out) = out else {
        print!("{}", page::page(report, "performance-growth.svg"));
        return Ok(());
    };
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let picture = format!("{stem}-growth.svg");
    if let Some(rows) = &report.search {
        put(&out.with_file_name(&picture), page::growth(rows).as_bytes())?;
    }
    put(out, page::page(report, &picture).as_bytes())
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    files::write(path, bytes).map_err(|why| why.to_string())
}
