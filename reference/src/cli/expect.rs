//! `reference expect`.

use std::path::{Path, PathBuf};

use cases::film;
use cases::stage::{self, Case, Stage};

use super::args::ExpectArgs;
use super::find::STAGES;
use super::progress::Bar;
use super::{Stop, Talk};
use crate::expect::{self, Expected};

/// What an argument names: a folder of stages, and what of it.
#[derive(Debug)]
struct Target {
    stages: PathBuf,
    only: Only,
}

#[derive(Debug)]
enum Only {
    All,
    Stage(String),
    Case(Box<Case>),
}

/// Carries out the command.
pub(super) fn run(args: &ExpectArgs, talk: Talk) -> Result<(), Stop> {
    let everything = [PathBuf::from(STAGES)];
    let named = if args.what.is_empty() { &everything[..] } else { &args.what };
    let mut tally = Tally::default();
    for target in named.iter().map(|name| target(name)).collect::<Result<Vec<_>, _>>()? {
        answer(&target, args.check, talk, &mut tally)?;
    }
    tally.verdict(args.check, talk)
}

fn target(named: &Path) -> Result<Target, Stop> {
    let below = Path::new(STAGES).join(named);
    let as_case = PathBuf::from(format!("{}.toml", below.display()));
    for path in [named, &below, &as_case] {
        if stage::is_case(path) {
            let case = stage::load_case(path)?;
            return Ok(Target { stages: parent(parent(path)).to_path_buf(), only: Only::Case(Box::new(case)) });
        }
        if path.join("stage.toml").is_file() {
            let id = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            return Ok(Target { stages: parent(path).to_path_buf(), only: Only::Stage(id) });
        }
    }
    if named.is_dir() {
        return Ok(Target { stages: named.to_path_buf(), only: Only::All });
    }
    Err(Stop::Usage(format!("`{}` is no case, no stage and no folder of stages", named.display())))
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

fn answer(target: &Target, is_check: bool, talk: Talk, tally: &mut Tally) -> Result<(), Stop> {
    let stages = match &target.only {
        Only::Case(case) => return one_case(&target.stages, case, is_check, talk, tally),
        _ => stage::load_all(&target.stages)?,
    };
    let wanted = |stage: &&Stage| match &target.only {
        Only::Stage(id) => stage.id == *id,
        _ => true,
    };
    let wanted: Vec<&Stage> = stages.iter().filter(wanted).collect();
    let bar = Bar::cases(wanted.iter().map(|stage| stage.cases.len() as u64).sum(), talk);
    for stage in wanted {
        for case in &stage.cases {
            bar.aside(|| one_case(&target.stages, case, is_check, talk, tally))?;
            bar.add(1);
        }
        match expect::of_checks(&target.stages, stage) {
            Ok(file) => file.into_iter().try_for_each(|file| settle(&file, is_check, talk, tally))?,
            Err(wrong) => tally.wrong.extend(wrong),
        }
    }
    let mistakes = expect::mistakes(&target.stages).map_err(|why| Stop::Machine(why.to_string()))?;
    settle(&mistakes, is_check, talk, tally)
}

fn one_case(stages: &Path, case: &Case, is_check: bool, talk: Talk, tally: &mut Tally) -> Result<(), Stop> {
    let files = expect::of_case(stages, case).map_err(|why| Stop::Machine(format!("{}: {why}", case.id)))?;
    files.iter().try_for_each(|file| settle(file, is_check, talk, tally))
}

/// Compares or writes one file.
fn settle(file: &Expected, is_check: bool, talk: Talk, tally: &mut Tally) -> Result<(), Stop> {
    let path = file.path.display();
    if file.is_stored() {
        tally.n_same += 1;
        if talk >= Talk::Verbose {
            anstream::eprintln!("as stored: {path}");
        }
        return Ok(());
    }
    if is_check {
        let how = if file.path.exists() { "differs from what the rules give" } else { "is missing" };
        tally.wrong.push(format!("{path} {how}"));
        return Ok(());
    }
    film::replace(&file.path, &file.bytes).map_err(|why| Stop::Machine(format!("cannot write {path}: {why}")))?;
    tally.n_written += 1;
    if talk >= Talk::Normal {
        anstream::eprintln!("wrote {path} ({} bytes)", file.bytes.len());
    }
    Ok(())
}

#[derive(Debug, Default)]
struct Tally {
    n_same: usize,
    n_written: usize,
    wrong: Vec<String>,
}

impl Tally {
    fn verdict(self, is_check: bool, talk: Talk) -> Result<(), Stop> {
        let Self { n_same, n_written, wrong } = self;
        if !wrong.is_empty() {
            let way_out = if is_check {
                "`reference expect` writes them anew; look at what changed"
            } else {
                "nothing was written for their stage's checks"
            };
            return Err(Stop::NotPassed(format!("{}\n{} did not pass; {way_out}", wrong.join("\n"), wrong.len())));
        }
        if talk >= Talk::Normal {
            anstream::eprintln!("{n_same} files as stored, {n_written} written");
        }
        Ok(())
    }
}
