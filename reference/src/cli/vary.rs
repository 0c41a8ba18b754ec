//! The command `reference vary`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use cases::course::course_of;
use cases::{files, stage};
use pages::say;

use super::args::VaryArgs;
use super::interrupt::Interrupt;
use super::output::Talk;
use super::progress::Bar;
use super::stop::Stop;
use super::{expect, survey};
use crate::expect::{Expected, Set};
use crate::vary::folder::{self, Draft, Originals, WriteSetError};

/// Runs the command.
pub(super) fn run(args: &VaryArgs, talk: Talk) -> Result<(), Stop> {
    let out = match (args.seed, args.check) {
        (Some(seed), false) => Some((
            seed,
            args.out.clone().unwrap_or_else(|| PathBuf::from(format!("varied-{seed}"))),
        )),
        _ => None,
    };
    if let Some((_, out)) = &out {
        free(out)?;
    }
    let course = course_of(&args.stages)?;
    let set = Set::new(stage::load_all(&args.stages, &course)?, &course);
    let originals = originals(args, &set, talk)?;
    match out {
        Some((seed, out)) => write(args, &set, &originals, seed, &out, talk),
        None => survey::run(&originals.varying, &set, args, talk),
    }
}

/// Returns the cases to vary, and warns of the cases that cannot be varied.
fn originals(args: &VaryArgs, set: &Set, talk: Talk) -> Result<Originals, Stop> {
    let n_varying = set
        .stages
        .iter()
        .flat_map(|stage| &stage.cases)
        .filter(|case| case.bounds.is_some())
        .count();
    if n_varying == 0 {
        let folder = args.stages.display();
        return Err(Stop::Usage(format!(
            "no case in {folder} has a `[vary]`, so that nothing would change\n\
                help: docs/scene-format.md describes it"
        )));
    }
    let bar = Bar::cases(n_varying as u64, talk);
    let originals = folder::originals(&args.stages, set, || bar.add(1))
        .map_err(|why| Stop::Usage(say::paragraphs(&why)))?;
    drop(bar);
    if talk > Talk::Quiet {
        for id in &originals.constant {
            say::err(&format!("warning: {id} has no `[vary]`, so that it is copied unchanged"));
        }
    }
    Ok(originals)
}

/// Draws the set, makes its answers, and moves both to their place at once.
fn write(
    args: &VaryArgs,
    set: &Set,
    originals: &Originals,
    seed: u64,
    out: &Path,
    talk: Talk,
) -> Result<(), Stop> {
    let Originals { varying, constant } = originals;
    let bar = Bar::cases(varying.len() as u64, talk);
    let varied = folder::draw(varying, set, seed, || bar.add(1))
        .map_err(|why| Stop::NotPassed(say::paragraphs(&why)))?;
    drop(bar);
    // Nothing has been written so far, so a signal could end the program at once. From now on the
    // first signal ends the work instead.
    let interrupt = &Interrupt::catch()?;
    let draft = Draft::write(&args.stages, set, &varied, constant, out)?;
    let stages = draft.stages();
    let hidden = Set::new(stage::load_all(&stages, &set.course)?, &set.course);
    let answers = expect::answers(&stages, &hidden, |_| true, interrupt, talk).map_err(Stop::of)?;
    files::write_all(answers.files().map(Expected::as_output))?;
    draft.publish(out)?;
    if talk >= Talk::Normal {
        let n_cases = varying.len() + constant.len();
        say::err(&format!("wrote {n_cases} cases with their answers to {}", out.display()));
    }
    Ok(())
}

impl From<WriteSetError> for Stop {
    fn from(why: WriteSetError) -> Self {
        match why {
            WriteSetError::Write(why) => why.into(),
            why => Self::Usage(say::chain(&why)),
        }
    }
}

/// Checks that `out` does not exist or is an empty folder. A mixture of two sets would be graded.
fn free(out: &Path) -> Result<(), Stop> {
    let taken = match fs::read_dir(out) {
        Ok(mut entries) => entries.next().is_some(),
        Err(why) => why.kind() != io::ErrorKind::NotFound,
    };
    if taken {
        return Err(Stop::Usage(format!(
            "`{}` is there already: remove it, or name another folder with --out DIR",
            out.display()
        )));
    }
    Ok(())
}
