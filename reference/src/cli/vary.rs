//! `reference vary`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use cases::course::course_of;
use cases::stage;

use super::args::VaryArgs;
use super::progress::Bar;
use super::{Stop, Talk, survey};
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
    let rules = Rules::of(&course_of(&args.stages)?);
    let stages = stage::load_all(&args.stages)?;
    let n_cases: usize = stages.iter().map(|stage| stage.cases.len()).sum();
    let bar = Bar::cases(n_cases as u64, talk);
    let originals = folder::originals(&args.stages, &stages, &rules, || bar.add(1)).map_err(Stop::Usage)?;
    drop(bar);
    let Some((seed, out)) = out else {
        return survey::run(&originals, args.seed.unwrap_or(1), args.seeds, talk);
    };
    let bar = Bar::cases(n_cases as u64, talk);
    let set = folder::set(&originals, seed, || bar.add(1)).map_err(Stop::NotPassed)?;
    drop(bar);
    folder::write(&args.stages, &stages, &set, &out).map_err(Stop::Machine)?;
    if talk >= Talk::Normal {
        let out = out.display();
        anstream::eprintln!("wrote {n_cases} cases to {out}; next: `reference expect {out}`");
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
