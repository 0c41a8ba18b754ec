//! A session runs a process for each parser, which reads mutations for a given time.
//!
//! The process writes each input to a file before it reads it. If the process panics, overflows its
//! stack, exceeds its memory or does not return, that file is the input to blame, and is kept.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Resource, Rlimit, setrlimit};
use rustix::time::{ClockId, clock_gettime};
use serde::{Deserialize, Serialize};

use super::{Counts, Parser, Read, mutate};
use crate::dice::Dice;
use crate::workspace;

/// The address space of a process that reads. Every parser should stay far below it.
const MOST_MEMORY: u64 = 1 << 30;
/// The maximum CPU time for one input of at most 256 KiB.
const MOST_CPU: Duration = Duration::from_secs(5);
/// The delay after which a process counts as hung.
const GRACE: Duration = Duration::from_secs(60);
/// The names of the files in the folder of a process.
const INPUT: &str = "input";
const REPORT: &str = "report.json";
const ERRORS: &str = "errors";

/// The report of a process that reached its end.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Report {
    /// The number of mutations that were read.
    pub counts: Counts,
    /// The longest CPU time for one input, in seconds.
    pub slowest_s: f64,
    /// The largest resident size, in bytes.
    pub peak_bytes: u64,
}

/// Reads mutations in this process for `time`, and writes the report to `folder`.
///
/// # Panics
/// Panics if a parser panics, breaks a promise or takes too long.
pub fn read_for(parser: &Parser, time: Duration, seed: u64, folder: &Path) {
    let limit = Rlimit { current: Some(MOST_MEMORY), maximum: Some(MOST_MEMORY) };
    setrlimit(Resource::As, limit).expect("the memory of a process can be limited");
    let (start, seeds, mut dice) = (Instant::now(), (parser.seeds)(), Dice::new(seed));
    let (mut counts, mut slowest) = (Counts::default(), Duration::ZERO);
    for bytes in &seeds {
        assert_eq!(timed(parser, bytes, folder).0, Read::Accepted, "a seed is refused");
    }
    while start.elapsed() < time {
        let (read, cpu) = timed(parser, &mutate::mutated(parser, &seeds, &mut dice), folder);
        counts.add(read);
        slowest = slowest.max(cpu);
    }
    let report = Report { counts, slowest_s: slowest.as_secs_f64(), peak_bytes: peak_bytes() };
    let text = serde_json::to_string(&report).expect("a report is JSON");
    fs::write(folder.join(REPORT), text).expect("the report can be written");
}

/// Reads one input in this process, from a file that [`run`] kept.
///
/// # Errors
/// Returns an error if the file cannot be read.
pub fn read_one(parser: &Parser, input: &Path) -> Result<Read, String> {
    let bytes = fs::read(input).map_err(|why| format!("{}: {why}", input.display()))?;
    let folder = tempfile::tempdir().map_err(|why| why.to_string())?;
    Ok((parser.read)(&bytes, folder.path()))
}

fn timed(parser: &Parser, bytes: &[u8], folder: &Path) -> (Read, Duration) {
    fs::write(folder.join(INPUT), bytes).expect("the input can be written");
    let start = cpu();
    let read = (parser.read)(bytes, folder);
    let cpu = cpu() - start;
    assert!(cpu < MOST_CPU, "it took {} s of CPU time", cpu.as_secs_f64());
    (read, cpu)
}

fn cpu() -> Duration {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), now.tv_nsec as u32)
}

/// Returns the largest resident size of this process in bytes, as Linux reports it, or 0 on other
/// systems.
fn peak_bytes() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok())
        .map_or(0, |kib| kib << 10)
}

/// Runs a process of this program that reads mutations for `time`.
///
/// # Errors
/// Returns a paragraph with the input at which a parser failed, and the command that tries it
/// again.
pub fn run(parser: &Parser, time: Duration, seed: u64) -> Result<Report, String> {
    let folder = tempfile::tempdir().map_err(|why| why.to_string())?;
    let errors = folder.path().join(ERRORS);
    let mut command = Command::new(std::env::current_exe().map_err(|why| why.to_string())?);
    command.args([
        "--only",
        parser.name,
        "--seconds",
        &time.as_secs_f64().to_string(),
        "--seed",
        &seed.to_string(),
    ]);
    command.arg("--into").arg(folder.path()).stdin(Stdio::null()).stdout(Stdio::null());
    command.stderr(File::create(&errors).map_err(|why| why.to_string())?);
    let status = wait(command, time + GRACE)?;
    if status.is_some_and(|status| status.success()) {
        let text = fs::read_to_string(folder.path().join(REPORT)).map_err(|why| why.to_string())?;
        return serde_json::from_str(&text).map_err(|why| why.to_string());
    }
    let how = status.map_or_else(|| "it did not return".to_owned(), |status| status.to_string());
    let said = fs::read_to_string(&errors).unwrap_or_default();
    let kept = keep(parser, &folder.path().join(INPUT))?;
    let (name, kept) = (parser.name, kept.display());
    Err(format!(
        "{name}: {how}\n{}\nthe input is {kept}; try it again with `cargo run --release -p tests \
            --bin fuzz -- --only {name} --input {kept}`",
        said.trim_end()
    ))
}

/// Waits for the process. Returns `None` if it had to be killed.
fn wait(mut command: Command, most: Duration) -> Result<Option<ExitStatus>, String> {
    let start = Instant::now();
    let mut child = command.spawn().map_err(|why| why.to_string())?;
    loop {
        if let Some(status) = child.try_wait().map_err(|why| why.to_string())? {
            return Ok(Some(status));
        }
        if start.elapsed() > most {
            child.kill().and_then(|()| child.wait()).map_err(|why| why.to_string())?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Copies an input to a new file below `target/fuzz`, and returns its path.
fn keep(parser: &Parser, input: &Path) -> Result<PathBuf, String> {
    let folder = workspace().join("target/fuzz");
    let kept =
        (0..).map(|n| folder.join(format!("{}-{n}", parser.name))).find(|path| !path.exists());
    let kept = kept.ok_or("there is no name left")?;
    fs::create_dir_all(&folder)
        .and_then(|()| fs::copy(input, &kept))
        .map_err(|why| why.to_string())?;
    Ok(kept)
}
