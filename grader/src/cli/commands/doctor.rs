//! `grader doctor`.

use std::path::Path;

use pages::say;

use crate::build::{Toolchain, Workshop};
use crate::cli::arguments::{Doctor, stages};
use crate::cli::exit::{self, Done, Outcome};
use crate::exam::Exam;
use crate::exercise::Allowance;
use crate::sandbox::{Available, Folder, Layers, available, memory_left};

/// A line of the report: the subject, and what is there, or what is missing and how to get it.
type Line = (&'static str, Result<String, String>);

pub(crate) fn run(arguments: &Doctor) -> Outcome {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let folder = stages(arguments.cases.as_deref()).map_err(|why| say::chain(&why));
    let here = Workshop::open(folder.as_deref().unwrap_or(Path::new("")));
    let root = here.as_ref().map_or(Path::new("."), |workshop| workshop.root.as_path()).to_owned();
    let lines: Vec<Line> = vec![
        (
            "compiler",
            Toolchain::find(&root)
                .map(|toolchain| toolchain.name().to_owned())
                .map_err(|why| say::chain(&why)),
        ),
        ("linker", linker()),
        (
            "workspace",
            here.as_ref()
                .map(|workshop| workshop.root.display().to_string())
                .map_err(ToString::to_string),
        ),
        (
            "store",
            here.as_ref()
                .map_err(ToString::to_string)
                .and_then(|workshop| store(&workshop.store())),
        ),
        ("cases", folder.and_then(|folder| exam(&folder))),
        ("temporary files", temporary_files()),
        ("limits", limits()),
        ("memory", memory()),
        ("cores", Ok(cores.to_string())),
        ("protection", Ok(protection())),
    ];
    let shown = |(name, found): &Line| match found {
        Ok(what) => format!("ok       {name}: {what}\n"),
        Err(why) => format!("missing  {name}: {why}\n"),
    };
    exit::print(&lines.iter().map(shown).collect::<String>())?;
    Ok(if lines.iter().all(|(_, found)| found.is_ok()) { Done::Passed } else { Done::Ours })
}

/// Returns the path of `cc`, which rustc calls to link.
fn linker() -> Result<String, String> {
    let folders = ["/usr/bin", "/bin"];
    let found = folders.iter().map(|folder| Path::new(folder).join("cc")).find(|cc| cc.is_file());
    let help = "there is no cc in /usr/bin: install gcc or clang (Debian, Ubuntu: apt install \
        gcc; macOS: xcode-select --install)";
    found.map(|cc| cc.display().to_string()).ok_or_else(|| help.to_owned())
}

/// Checks that programs can be given folders to work in.
fn temporary_files() -> Result<String, String> {
    Folder::new()
        .map(|_| std::env::temp_dir().display().to_string())
        .map_err(|why| say::chain(&why))
}

/// Checks that this process can give programs their limits. A limit that is lower but enough is
/// named.
fn limits() -> Result<String, String> {
    let lowered = Allowance::default().picture.lowered();
    let texts = |is_enough: bool| -> Vec<String> {
        lowered
            .iter()
            .filter(|granted| granted.is_enough == is_enough)
            .map(ToString::to_string)
            .collect()
    };
    match (texts(false), texts(true)) {
        (missing, _) if !missing.is_empty() => {
            Err(format!("programs get {}: raise it", missing.join(", ")))
        }
        (_, lower) if !lower.is_empty() => {
            Ok(format!("programs get {}, which is enough", lower.join(", ")))
        }
        _ => Ok("this process lowers none of the limits of programs".to_owned()),
    }
}

/// Checks that one program fits into the memory that is left.
fn memory() -> Result<String, String> {
    let (needed, mib) = (Allowance::MEMORY, |bytes: u64| bytes >> 20);
    match memory_left() {
        Some(left) if left < needed => Err(format!(
            "{} MiB are left, but a program may use {} MiB: see --memory-limit",
            mib(left),
            mib(needed)
        )),
        Some(left) => {
            Ok(format!("{} MiB are left, and a program may use {} MiB", mib(left), mib(needed)))
        }
        None => Ok("this system does not say how much is left".to_owned()),
    }
}

/// Returns the layers of protection, and which ones are missing. `grade` works with any of them.
fn protection() -> String {
    let Available { layers, missing } = available();
    if *layers == Layers::ALL {
        return format!("{layers} (full)");
    }
    let each: Vec<String> = missing.iter().map(|(name, why)| format!("no {name}: {why}")).collect();
    format!("{layers} (basic, which `batch` takes only with --sandbox basic; {})", each.join("; "))
}

/// Checks that compiled crates and submissions can be stored.
fn store(folder: &Path) -> Result<String, String> {
    let name = format!(".doctor-{}", std::process::id());
    let probe = folder.join(name);
    crate::files::write(&probe, b"")
        .and_then(|()| std::fs::remove_file(&probe))
        .map(|()| folder.display().to_string())
        .map_err(|why| {
            format!("{} cannot be written ({why}): it holds compiled crates", folder.display())
        })
}

fn exam(folder: &Path) -> Result<String, String> {
    let exam = Exam::load(folder).map_err(|why| why.to_string())?;
    let n =
        |count: fn(&crate::exam::Questions) -> usize| exam.stages.iter().map(count).sum::<usize>();
    let (cases, checks) =
        (n(|questions| questions.stage.cases.len()), n(|questions| questions.stage.checks.len()));
    let text = format!(
        "{}: {} stages, {cases} cases, {checks} unit checks",
        folder.display(),
        exam.stages.len()
    );
    let ids = exam.stages.iter().flat_map(|questions| questions.stage.ids());
    exam.trust(ids).map(|()| text.clone()).map_err(|untrusted| format!("{text}\n{untrusted}"))
}
