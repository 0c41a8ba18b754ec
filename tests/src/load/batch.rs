//! Batches of `grader`, whose cost is measured.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use grader::record::Record;

use super::copies::{copy, edited_solution};
use super::usage;
use crate::workspace;

/// The processor time of a batch for each submission.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    /// All processes together.
    pub all: Duration,
    /// The grader itself, without the programs that it starts.
    pub grader: Duration,
    /// The programs of students, in both runs of each case.
    pub programs: Duration,
}

impl Cost {
    /// Returns what is neither the grader nor a student's program: compilers, linkers, and the
    /// processes that start programs.
    pub fn compilers(&self) -> Duration {
        self.all.saturating_sub(self.grader + self.programs)
    }
}

/// Grades `n` edited copies of the solution with the binary `grader`.
///
/// # Errors
/// Fails if the batch does, or if a copy does not earn all points.
pub fn of_solutions(grader: &Path, n: usize) -> Result<Cost, String> {
    let place = tempfile::tempdir().map_err(|why| why.to_string())?;
    for at in 0..n {
        let folder = place.path().join(format!("in/copy{at}"));
        edited_solution(at, &folder).map_err(|why| why.to_string())?;
    }
    let stages = workspace().join("cases/stages");
    let before = usage::of_machine()?;
    let (grader, _) = watch(start(grader, place.path(), &stages)?)?;
    let all = usage::of_machine()? - before;
    let programs = (0..n).map(|copy| programs(place.path(), copy)).sum::<Result<Duration, _>>()?;
    let each = |time: Duration| time / n as u32;
    Ok(Cost { all: each(all), grader: each(grader), programs: each(programs) })
}

/// Returns the peak memory of the grader for a class of `n` small scripts on the exam of flat
/// colours.
///
/// # Errors
/// Fails if the batch does.
pub fn memory(grader: &Path, n: usize) -> Result<u64, String> {
    let place = tempfile::tempdir().map_err(|why| why.to_string())?;
    for at in 0..n {
        let folder = place.path().join(format!("in/copy{at}"));
        copy(&workspace().join("tests/runtimes/python"), &folder).map_err(|why| why.to_string())?;
    }
    let (_, peak) = watch(start(grader, place.path(), &workspace().join("tests/exam"))?)?;
    Ok(peak)
}

fn start(grader: &Path, place: &Path, stages: &Path) -> Result<Child, String> {
    let mut command = Command::new(grader);
    command.args(["batch", "--quiet"]).arg(place.join("in"));
    command.arg("-o").arg(place.join("out")).arg("--cases").arg(stages);
    command.arg("--key").arg(place.join("key")).stdin(Stdio::null()).stdout(Stdio::null());
    command.spawn().map_err(|why| format!("{}: {why}", grader.display()))
}

/// Waits for the end of the grader. Returns its processor time, and its peak memory in bytes.
fn watch(mut child: Child) -> Result<(Duration, u64), String> {
    let (mut time, mut peak) = (Duration::ZERO, 0);
    loop {
        time = usage::of_process(child.id()).unwrap_or(time);
        peak = usage::peak(child.id()).unwrap_or(peak);
        match child.try_wait().map_err(|why| why.to_string())? {
            None => std::thread::sleep(Duration::from_millis(20)),
            Some(status) if status.success() => return Ok((time, peak)),
            Some(status) => return Err(format!("the batch ended with {status}")),
        }
    }
}

/// Returns the processor time of the programs of a submission. A record holds that of the first run
/// of each picture; the second run takes as long.
fn programs(place: &Path, copy: usize) -> Result<Duration, String> {
    let path = place.join(format!("out/records/copy{copy}.json"));
    let text = fs::read(&path).map_err(|why| format!("{}: {why}", path.display()))?;
    let record: Record = serde_json::from_slice(&text).map_err(|why| why.to_string())?;
    if record.score.earned != record.score.possible {
        return Err(format!("copy {copy} earned {:?}", record.score));
    }
    let mut seconds = 0.0;
    for stage in &record.stages {
        let image =
            |check: &&grader::record::CheckRecord| check.kind == grader::record::CheckKind::Image;
        let pictures: f64 = stage.checks.iter().filter(image).filter_map(|one| one.cpu_s).sum();
        // All unit checks of a stage share one process.
        let units = stage.checks.iter().find(|check| !image(check)).and_then(|one| one.cpu_s);
        seconds += 2.0 * pictures + units.unwrap_or(0.0);
    }
    Ok(Duration::from_secs_f64(seconds))
}
