//! `reference vary`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use cases::course;
use cases::film;
use cases::stage::{self, Case, Stage};
use rayon::prelude::*;
use toml_edit::DocumentMut;

use super::args::VaryArgs;
use super::progress::Bar;
use super::{Stop, Talk, survey};
use crate::vary::{self, Asset, Original, Varied};

/// Carries out the command.
pub(super) fn run(args: &VaryArgs, talk: Talk) -> Result<(), Stop> {
    let stages = stage::load_all(&args.stages)?;
    if let (Some(seed), false) = (args.seed, args.check) {
        let out = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("varied-{seed}")));
        free(&out)?;
        let originals = originals(&args.stages, &stages, talk)?;
        return write(&args.stages, &stages, &drawn(&originals, seed, talk)?, &out, talk);
    }
    let originals = originals(&args.stages, &stages, talk)?;
    survey::run(&originals, args.seed.unwrap_or(1), args.seeds, talk)
}

/// Where a set goes must not hold anything yet: a mixture of two sets would be graded.
fn free(out: &Path) -> Result<(), Stop> {
    let taken = match fs::read_dir(out) {
        Ok(mut entries) => entries.next().is_some(),
        Err(why) => why.kind() != io::ErrorKind::NotFound,
    };
    if taken {
        Err(Stop::Usage(format!("`{}` is there already: remove it, or say where else with --out DIR", out.display())))
    } else {
        Ok(())
    }
}

fn case_path(folder: &Path, id: &str) -> PathBuf {
    folder.join(format!("{id}.toml"))
}

/// All cases, ready to be varied.
fn originals(folder: &Path, stages: &[Stage], talk: Talk) -> Result<Vec<Original>, Stop> {
    let cases: Vec<_> = vary::with_predecessors(stages).collect();
    let bar = Bar::cases(cases.len() as u64, talk);
    let one = |(case, stage, before): &(&Case, &Stage, _)| {
        let path = case_path(folder, &case.id);
        let text = fs::read_to_string(&path).map_err(|why| format!("{}: {why}", path.display()))?;
        let original = Original::new(case, stage, *before, &path, &text);
        bar.add(1);
        original
    };
    all(cases.par_iter().map(one).collect()).map_err(Stop::Usage)
}

fn drawn(originals: &[Original], seed: u64, talk: Talk) -> Result<Vec<Varied>, Stop> {
    let bar = Bar::cases(originals.len() as u64, talk);
    let one = |original: &Original| {
        let varied = original.vary(seed);
        bar.add(1);
        varied
    };
    all(originals.par_iter().map(one).collect()).map_err(Stop::NotPassed)
}

/// All values, or all that went wrong.
fn all<T>(results: Vec<Result<T, String>>) -> Result<Vec<T>, String> {
    let (mut values, mut wrong) = (vec![], vec![]);
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(why) => wrong.push(why),
        }
    }
    if wrong.is_empty() { Ok(values) } else { Err(wrong.join("\n")) }
}

/// Writes the set beside `out`, what its course decides with it, and moves it there, whole.
fn write(folder: &Path, stages: &[Stage], set: &[Varied], out: &Path, talk: Talk) -> Result<(), Stop> {
    let machine = |why: io::Error| Stop::Machine(format!("cannot write {}: {why}", out.display()));
    let beside = match out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(beside).map_err(machine)?;
    let part = tempfile::Builder::new().prefix(".vary-").tempdir_in(beside).map_err(machine)?;
    let whole = part.path().join("stages");
    for stage in stages {
        copy_stage(&folder.join(&stage.id), &whole.join(&stage.id))?;
    }
    for varied in set {
        let path = case_path(&whole, &varied.case.id);
        put(&path, varied.text.as_bytes())?;
        take(&case_path(folder, &varied.case.id), &path, &varied.assets)?;
    }
    if let Some(path) = course::path_of(folder) {
        let bytes = fs::read(&path).map_err(|why| Stop::Usage(format!("{}: {why}", path.display())))?;
        put(&whole.join(course::FILE), &bytes)?;
    }
    fs::rename(&whole, out).map_err(machine)?;
    if talk >= Talk::Normal {
        let out = out.display();
        anstream::eprintln!("wrote {} cases to {out}; next: `reference expect {out}`", set.len());
    }
    Ok(())
}

/// The stage's own file and its unit checks; they stay as they are.
fn copy_stage(from: &Path, to: &Path) -> Result<(), Stop> {
    let read = |path: &Path| fs::read_to_string(path).map_err(|why| Stop::Usage(format!("{}: {why}", path.display())));
    put(&to.join("stage.toml"), read(&from.join("stage.toml"))?.as_bytes())?;
    let checks = fs::read_dir(from.join("checks")).into_iter().flatten().flatten().map(|entry| entry.path());
    for path in checks.filter(|path| path.extension().is_some_and(|end| end == "toml")) {
        let text = read(&path)?;
        let mut document: DocumentMut =
            text.parse().map_err(|why| Stop::Usage(format!("{}: {why}", path.display())))?;
        let target = to.join("checks").join(path.file_name().unwrap_or_default());
        put(&target, document_text(&mut document, &path, &target)?.as_bytes())?;
    }
    Ok(())
}

/// The text of a file of checks, whose meshes are taken along.
fn document_text(document: &mut DocumentMut, from: &Path, to: &Path) -> Result<String, Stop> {
    let assets = vary::take_along(document);
    take(from, to, &assets)?;
    Ok(document.to_string())
}

/// Copies the meshes that the file `from` names to where the file `to` names them.
fn take(from: &Path, to: &Path, assets: &[Asset]) -> Result<(), Stop> {
    assets.iter().try_for_each(|asset| {
        let source = from.with_file_name("").join(&asset.from);
        let bytes = fs::read(&source).map_err(|why| Stop::Usage(format!("{}: {why}", source.display())))?;
        put(&to.with_file_name("").join(&asset.to), &bytes)
    })
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), Stop> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)
        .and_then(|()| film::replace(path, bytes))
        .map_err(|why| Stop::Machine(format!("cannot write {}: {why}", path.display())))
}
