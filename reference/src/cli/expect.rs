//! The command `reference expect`.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use cases::answer::Limits;
use cases::{course, files, stage};
use pages::say;

use super::args::ExpectArgs;
use super::course::files as course_files;
use super::find;
use super::interrupt::Interrupt;
use super::output::Talk;
use super::progress::Bar;
use super::stop::Stop;
use super::values::{CourseArg, STAGES};
use crate::expect::{self, Answers, CaseAnswer, ExpectError, Expected, Progress, Set};

/// The targets of a command: for each folder of stages the ids of the selected cases and stages,
/// none for all.
type Targets = BTreeMap<PathBuf, Vec<String>>;

const PART_OF_A_COURSE: &str = "\
--course sets up a whole folder of stages: the answers of the other cases would belong to another \
course
help: leave CASE and STAGE out, or change the course.toml of the folder";

/// Runs the command. Everything is computed before the first file is written.
pub(super) fn run(args: &ExpectArgs, talk: Talk) -> Result<(), Stop> {
    let interrupt = Interrupt::catch()?;
    let mut files = vec![];
    let mut wrong = vec![];
    for (stages, wanted) in targets(&args.what)? {
        let set = load(&stages, &args.course)?;
        if wanted.is_empty() {
            files.extend(course_files(&stages, &args.course, &set.course)?);
        } else if args.course.course.is_some() && !args.check {
            return Err(Stop::Usage(PART_OF_A_COURSE.to_owned()));
        }
        let is_in_set = |id: &str| {
            set.stages
                .iter()
                .any(|stage| stage.id == id || stage.cases.iter().any(|it| it.id == id))
        };
        if let Some(id) = wanted.iter().find(|id| !is_in_set(id)) {
            return Err(Stop::Usage(format!(
                "{} has no case and no stage `{id}`",
                stages.display()
            )));
        }
        let is_wanted = |id: &str| wanted.is_empty() || wanted.iter().any(|one| one == id);
        match answers(&stages, &set, is_wanted, &interrupt, talk) {
            Ok(answers) => files.extend(answers.files().cloned()),
            Err(ExpectError::Checks(errors)) => wrong.extend(errors),
            Err(why) => return Err(Stop::of(why)),
        }
    }
    if !wrong.is_empty() {
        let n = wrong.len();
        return Err(Stop::NotPassed(format!(
            "{}\n{n} did not pass; nothing was written",
            say::paragraphs(&wrong)
        )));
    }
    if args.check { compare(&files, talk) } else { write(&files, talk) }
}

/// Returns the targets that the arguments name.
fn targets(named: &[PathBuf]) -> Result<Targets, Stop> {
    let everything = [PathBuf::from(STAGES)];
    let mut targets = Targets::new();
    for name in if named.is_empty() { &everything[..] } else { named } {
        let (stages, id) = target(name)?;
        match (targets.get_mut(&stages), id) {
            (Some(wanted), Some(id)) if !wanted.is_empty() => wanted.push(id),
            (Some(_), Some(_)) => {}
            (_, id) => drop(targets.insert(stages, id.into_iter().collect())),
        }
    }
    Ok(targets)
}

/// Returns the folder of stages that contains `named`, and the id of the case or stage. The id is
/// `None` if `named` is the folder itself.
fn target(named: &Path) -> Result<(PathBuf, Option<String>), Stop> {
    let below = Path::new(STAGES).join(named);
    let as_case = PathBuf::from(format!("{}.toml", below.display()));
    // The path `.` has no file name.
    let whole = named.file_name().is_none().then(|| named.canonicalize().ok()).flatten();
    for path in [whole.as_deref().unwrap_or(named), &below, &as_case] {
        let text = |name: Option<&OsStr>| name.unwrap_or_default().to_string_lossy().into_owned();
        if stage::is_case(path) {
            let stage = parent(path);
            let id = format!("{}/{}", text(stage.file_name()), text(path.file_stem()));
            return Ok((parent(stage).to_path_buf(), Some(id)));
        }
        if path.join("stage.toml").is_file() {
            return Ok((parent(path).to_path_buf(), Some(text(path.file_name()))));
        }
    }
    if named.is_dir() {
        return Ok((named.to_path_buf(), None));
    }
    let named = named.display().to_string();
    let hint = find::hint(&named);
    Err(Stop::Usage(format!("`{named}` is no case, no stage and no folder of stages{hint}")))
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

fn load(stages: &Path, course: &CourseArg) -> Result<Set, Stop> {
    let course = match find::given(course)? {
        Some(course) => course,
        None => course::course_of(stages)?,
    };
    Ok(Set::new(stage::load_all(stages, &course)?, &course))
}

/// Returns the answers to the parts of a set that `is_wanted` selects, and shows a bar meanwhile.
pub(super) fn answers(
    stages: &Path,
    set: &Set,
    is_wanted: impl Fn(&str) -> bool + Sync,
    interrupt: &Interrupt,
    talk: Talk,
) -> Result<Answers, ExpectError> {
    let bar = Bar::steps(expect::n_steps(set, &is_wanted) as u64, talk);
    let answers = expect::of_set(stages, set, is_wanted, &Shown { bar, interrupt })?;
    if talk >= Talk::Verbose {
        answers.cases.iter().for_each(|case| say::err(&figures(case)));
    }
    Ok(answers)
}

/// Shows the progress of answers, and stops them at Ctrl-C.
struct Shown<'a> {
    bar: Bar,
    interrupt: &'a Interrupt,
}

impl Progress for Shown<'_> {
    fn step(&self) {
        self.bar.add(1);
    }

    fn is_stopped(&self) -> bool {
        self.interrupt.is_set()
    }
}

impl Stop {
    /// Returns how a command ends that could not make answers.
    pub(super) fn of(why: ExpectError) -> Self {
        match why {
            ExpectError::Checks(_) => Self::NotPassed(format!("{why}\nnothing was written")),
            ExpectError::Interrupted => Self::Interrupted(why.to_string()),
            ExpectError::Picture { .. } | ExpectError::List(_) => {
                Self::machine("nothing was written")(why)
            }
        }
    }
}

/// Returns a line on the answer to a case, for authors of cases.
fn figures(case: &CaseAnswer) -> String {
    let CaseAnswer { id, answer, wrong, files } = case;
    let Limits { cluster, count, legal_cluster, legal_count, unearned, .. } = answer.limits;
    let (contested, earned_from) = (100.0 * answer.contested_share(), 100.0 * unearned);
    let (n_mistakes, size) = (wrong.len(), files[0].bytes.len());
    format!(
        "{id}: {contested:.2} % contested; clusters up to {cluster} ({legal_cluster} legal), \
            {count} pixels out \
         ({legal_count} legal); points from {earned_from:.1} %; {n_mistakes} mistakes show; \
         {size} bytes"
    )
}

/// Compares the files with the stored ones and writes nothing.
fn compare(files: &[Expected], talk: Talk) -> Result<(), Stop> {
    let wrong: Vec<String> = files
        .iter()
        .filter(|file| !file.is_stored())
        .map(|file| {
            let how =
                if file.path.exists() { "differs from what the rules give" } else { "is missing" };
            format!("{} {how}", file.path.display())
        })
        .collect();
    if !wrong.is_empty() {
        let (list, n) = (wrong.join("\n"), wrong.len());
        let way_out = "`reference expect` writes them; look at what changed";
        return Err(Stop::NotPassed(format!("{list}\n{n} did not pass; {way_out}")));
    }
    if talk >= Talk::Normal {
        say::err(&format!("{} files as stored, 0 written", files.len()));
    }
    Ok(())
}

/// Writes the files that differ from the stored ones, all of them or none.
fn write(files: &[Expected], talk: Talk) -> Result<(), Stop> {
    let changed: Vec<&Expected> = files.iter().filter(|file| !file.is_stored()).collect();
    let n_written = files::write_all(changed.iter().map(|file| file.as_output()))?;
    if talk >= Talk::Normal {
        for file in &changed {
            say::err(&format!("wrote {} ({} bytes)", file.path.display(), file.bytes.len()));
        }
        say::err(&format!("{} files as stored, {n_written} written", files.len() - n_written));
    }
    Ok(())
}
