//! `reference expect`.

use std::path::{Path, PathBuf};

use cases::answer::Limits;
use cases::course;
use cases::film;
use cases::stage::{self, Case};
use pages::say;
use rayon::prelude::*;

use super::args::{CourseArg, ExpectArgs};
use super::find::{self, STAGES};
use super::progress::Bar;
use super::{Stop, Talk};
use crate::expect::{self, CaseAnswer, Expected, Set};
use crate::rules::Rules;

/// What an argument names: a folder of stages, and the ids of what of it; `None` for all.
#[derive(Debug)]
struct Target {
    stages: PathBuf,
    only: Option<String>,
}

/// Carries out the command.
pub(super) fn run(args: &ExpectArgs, talk: Talk) -> Result<(), Stop> {
    let everything = [PathBuf::from(STAGES)];
    let named = if args.what.is_empty() { &everything[..] } else { &args.what };
    let mut tally = Tally::default();
    for target in named.iter().map(|name| target(name)).collect::<Result<Vec<_>, _>>()? {
        answer(&target, &args.course, args.check, talk, &mut tally)?;
    }
    tally.verdict(args.check, talk)
}

fn target(named: &Path) -> Result<Target, Stop> {
    let below = Path::new(STAGES).join(named);
    let as_case = PathBuf::from(format!("{}.toml", below.display()));
    for path in [named, &below, &as_case] {
        let stem = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if stage::is_case(path) {
            let stage = parent(path);
            let id = format!("{}/{stem}", stage.file_name().unwrap_or_default().to_string_lossy());
            return Ok(Target { stages: parent(stage).to_path_buf(), only: Some(id) });
        }
        if path.join("stage.toml").is_file() {
            return Ok(Target { stages: parent(path).to_path_buf(), only: Some(stem) });
        }
    }
    if named.is_dir() {
        return Ok(Target { stages: named.to_path_buf(), only: None });
    }
    Err(Stop::Usage(format!("`{}` is no case, no stage and no folder of stages", named.display())))
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// All cases at once, since each has to do with the pictures of the others; files in the order of the stages.
fn answer(target: &Target, course: &CourseArg, is_check: bool, talk: Talk, tally: &mut Tally) -> Result<(), Stop> {
    let course = match find::given(course)? {
        Some(course) => course,
        None => course::course_of(&target.stages)?,
    };
    let set = Set::new(stage::load_all(&target.stages)?, Rules::of(&course));
    let is_wanted = |id: &str| target.only.as_deref().is_none_or(|only| only == id);
    let stages = || set.stages.iter().enumerate();
    let wanted: Vec<(usize, &Case)> = stages()
        .flat_map(|(n, stage)| stage.cases.iter().map(move |case| (n, stage, case)))
        .filter(|(_, stage, case)| is_wanted(&stage.id) || is_wanted(&case.id))
        .map(|(n, _, case)| (n, case))
        .collect();
    let bar = Bar::cases(wanted.len() as u64, talk);
    let answers = wanted.par_iter().map(|(n, case)| {
        let answer = expect::of_case(&target.stages, &set, *n, case);
        bar.add(1);
        answer.map_err(|why| Stop::Machine(format!("{}: {why}", case.id)))
    });
    let answers: Vec<CaseAnswer> = answers.collect::<Result<_, _>>()?;
    drop(bar);
    for answer in &answers {
        answer.files.iter().try_for_each(|file| settle(file, is_check, talk, tally))?;
        if talk >= Talk::Verbose {
            say::err(&figures(answer));
        }
    }
    for (_, stage) in stages().filter(|(_, stage)| is_wanted(&stage.id)) {
        match expect::of_checks(&target.stages, stage, &set.rules) {
            Ok(file) => file.into_iter().try_for_each(|file| settle(&file, is_check, talk, tally))?,
            Err(wrong) => tally.wrong.extend(wrong),
        }
    }
    let mistakes = expect::mistakes(&target.stages, &set.rules).map_err(|why| Stop::Machine(why.to_string()))?;
    settle(&mistakes, is_check, talk, tally)
}

/// What a case's answer comes to, for those who write cases.
fn figures(case: &CaseAnswer) -> String {
    let CaseAnswer { id, answer, wrong, files } = case;
    let Limits { cluster, count, legal_cluster, legal_count, unearned, .. } = answer.limits;
    let (contested, earned_from) = (100.0 * answer.contested_share(), 100.0 * unearned);
    let (n_mistakes, size) = (wrong.len(), files[0].bytes.len());
    format!(
        "{id}: {contested:.2} % contested; clusters up to {cluster} ({legal_cluster} legal), {count} pixels out ({legal_count} legal); \
         points from {earned_from:.1} %; {n_mistakes} mistakes show; {size} bytes"
    )
}

/// Compares or writes one file.
fn settle(file: &Expected, is_check: bool, talk: Talk, tally: &mut Tally) -> Result<(), Stop> {
    let path = file.path.display();
    if file.is_stored() {
        tally.n_same += 1;
        if talk >= Talk::Verbose {
            say::err(&format!("as stored: {path}"));
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
        say::err(&format!("wrote {path} ({} bytes)", file.bytes.len()));
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
            say::err(&format!("{n_same} files as stored, {n_written} written"));
        }
        Ok(())
    }
}
