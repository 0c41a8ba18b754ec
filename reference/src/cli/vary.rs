//! `reference vary`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use cases::course::course_of;
use cases::stage;
use pages::say;

use super::args::VaryArgs;
use super::progress::Bar;
use super::{Stop, Talk, survey};
use crate::expect::Set;
use crate::rules::Rules;
use crate::vary::folder;

/// Carries out the command.
pub(super) fn run(args: &VaryArgs, talk: Talk) -> Result<(), Stop> {
    let out = match (args.seed, args.check) {
        (Some(seed), false) => {
            Some((seed, args.out.clone().unwrap_or_else(|| PathBuf::from(format!("varied-{seed}")))))
        }
        _ => None,
    };
    if let Some((_, out)) = &out {
        free(out)?;
    }
    let set = Set::new(stage::load_all(&args.stages)?, Rules::of(&course_of(&args.stages)?));
    let n_cases: usize = set.stages.iter().map(|stage| stage.cases.len()).sum();
    let bar = Bar::cases(n_cases as u64, talk);
    let originals = folder::originals(&args.stages, &set, || bar.add(1)).map_err(Stop::Usage)?;
    drop(bar);
    let Some((seed, out)) = out else {
        return survey::run(&originals, &set, args, talk);
    };
    let bar = Bar::cases(n_cases as u64, talk);
    let varied = folder::draw(&originals, &set, seed, || bar.add(1)).map_err(Stop::NotPassed)?;
    drop(bar);
    folder::write(&args.stages, &set.stages, &varied, &out).map_err(Stop::Machine)?;
    if talk >= Talk::Normal {
        let out = out.display();
        say::err(&format!("wrote {n_cases} cases to {out}; next: `reference expect {out}`"));
    }
    Ok(())
}

/// Where a set goes must not hold anything yet: a mixture of two sets would be graded.
fn free(out: &Path) -> Result<(), Stop> {
    let taken = match fs::read_dir(out) {
        Ok(mut entries) => entries.next().is_some(),
        Err(why) => why.kind() != io::ErrorKind::NotFound,
    };
    if taken {
        return Err(Stop::Usage(format!(
            "`{}` is there already: remove it, or say where else with --out DIR",
            out.display()
        )));
    }
    Ok(())
}
