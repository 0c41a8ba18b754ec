//! `grader doctor`.

use std::path::Path;

use grader::build::{Toolchain, Workshop};
use grader::exam::Exam;
use grader::sandbox::LEVEL;

use crate::arguments::{Doctor, stages};
use crate::exit::{self, Done, Outcome};

/// A line: what is looked at, and what is there, or what is missing and how to get it.
type Line = (&'static str, Result<String, String>);

pub(crate) fn run(arguments: &Doctor) -> Outcome {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let folder = stages(arguments.cases.as_deref()).map_err(|why| why.to_string());
    let here = Workshop::open(folder.as_deref().unwrap_or(Path::new("")));
    let root = here.as_ref().map_or(Path::new("."), |workshop| workshop.root.as_path()).to_owned();
    let lines: Vec<Line> = vec![
        ("compiler", Toolchain::find(&root).map(|toolchain| toolchain.name().to_owned())),
        ("linker", linker()),
        ("workspace", here.as_ref().map(|workshop| workshop.root.display().to_string()).map_err(Clone::clone)),
        ("store", here.as_ref().map_err(Clone::clone).and_then(|workshop| store(&workshop.store()))),
        ("cases", folder.and_then(|folder| exam(&folder))),
        ("cores", Ok(cores.to_string())),
        ("protection", Ok(format!("{LEVEL} (no Landlock, no seccomp: grade untrusted work as a user of its own)"))),
    ];
    let shown = |(name, found): &Line| match found {
        Ok(what) => format!("ok       {name}: {what}\n"),
        Err(why) => format!("missing  {name}: {why}\n"),
    };
    exit::print(&lines.iter().map(shown).collect::<String>())?;
    Ok(if lines.iter().all(|(_, found)| found.is_ok()) { Done::Passed } else { Done::Ours })
}

/// rustc links by way of `cc`.
fn linker() -> Result<String, String> {
    let folders = ["/usr/bin", "/bin"];
    let found = folders.iter().map(|folder| Path::new(folder).join("cc")).find(|cc| cc.is_file());
    let help = "there is no cc in /usr/bin: install gcc or clang (Debian, Ubuntu: apt install gcc; macOS: xcode-select --install)";
    found.map(|cc| cc.display().to_string()).ok_or_else(|| help.to_owned())
}

/// Whether compiled crates and submissions can be stored.
fn store(folder: &Path) -> Result<String, String> {
    let name = format!(".doctor-{}", std::process::id());
    let probe = folder.join(name);
    grader::files::write(&probe, b"")
        .and_then(|()| std::fs::remove_file(&probe))
        .map(|()| folder.display().to_string())
        .map_err(|why| format!("{} cannot be written ({why}): it holds compiled crates", folder.display()))
}

fn exam(folder: &Path) -> Result<String, String> {
    let exam = Exam::load(folder)?;
    let n = |count: fn(&grader::exam::Questions) -> usize| exam.stages.iter().map(count).sum::<usize>();
    let n_missing = n(|questions| questions.images.values().filter(|answer| answer.is_err()).count())
        + n(|questions| questions.stage.checks.len() - questions.units.len().min(questions.stage.checks.len()));
    let (cases, checks) = (n(|questions| questions.stage.cases.len()), n(|questions| questions.stage.checks.len()));
    let text = format!("{}: {} stages, {cases} cases, {checks} unit checks", folder.display(), exam.stages.len());
    if n_missing == 0 { Ok(text) } else { Err(format!("{text}; {n_missing} answers: run `reference expect`")) }
}
