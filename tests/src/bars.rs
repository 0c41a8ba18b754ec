//! How a judge did over all variants, and the bars that this grader must take.

use std::collections::BTreeMap;

use crate::lab::Trial;

/// Percent of the bugs that must lose their first points in the stage where they are.
pub const RIGHT_STAGE: usize = 95;

/// How a judge did, name by name.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Right variants.
    pub n_right: usize,
    /// Variants with a bug that changes something the judge could see.
    pub n_wrong: usize,
    /// Right variants that failed, and where.
    pub false_fails: Vec<String>,
    /// Bugs that passed.
    pub misses: Vec<String>,
    /// Bugs that failed first in another stage than theirs, and where.
    pub misplaced: Vec<String>,
}

impl Tally {
    /// Of a judge for whom a trial fails first in the stage that `first_stage` gives, among the `trials` that it could tell apart.
    pub fn of<'a>(
        trials: impl IntoIterator<Item = &'a Trial>,
        first_stage: impl Fn(&Trial) -> Option<String>,
        place: impl Fn(&Trial) -> String,
    ) -> Self {
        let mut tally = Self::default();
        for trial in trials {
            let name = &trial.variant.name;
            match (trial.stage(), first_stage(trial)) {
                (None, None) => tally.n_right += 1,
                (None, Some(_)) => {
                    tally.n_right += 1;
                    tally.false_fails.push(format!("{name}: {}", place(trial)));
                }
                (Some(stage), first) => {
                    tally.n_wrong += 1;
                    match first {
                        None => tally.misses.push(name.clone()),
                        Some(first) if first == stage => {}
                        Some(_) => tally.misplaced.push(format!("{name}: {}, not {stage}", place(trial))),
                    }
                }
            }
        }
        tally
    }

    /// Of this grader.
    pub fn of_this_grader(trials: &[Trial]) -> Self {
        Self::of(trials, |trial| trial.first_stage().map(str::to_owned), lost)
    }

    /// Bugs that failed.
    pub fn n_caught(&self) -> usize {
        self.n_wrong - self.misses.len()
    }

    /// Bugs that failed first in their own stage.
    pub fn n_in_right_stage(&self) -> usize {
        self.n_caught() - self.misplaced.len()
    }

    /// Everything that keeps this grader from its bars.
    pub fn faults(&self) -> Vec<String> {
        let say = |what: &str, names: &[String]| names.iter().map(|name| format!("{what}: {name}")).collect::<Vec<_>>();
        let mut faults = say("right, but it lost points", &self.false_fails);
        faults.extend(say("wrong, but it lost none", &self.misses));
        if self.n_in_right_stage() * 100 < self.n_caught() * RIGHT_STAGE {
            faults.extend(say("it lost its first points in another stage", &self.misplaced));
        }
        faults
    }
}

/// The checks that cost points, by stage: the first few of each.
fn lost(trial: &Trial) -> String {
    let mut by_stage: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for check in trial.lost() {
        let (stage, rest) = check.id.split_once('/').unwrap_or((&check.id, ""));
        by_stage.entry(stage).or_default().push(rest);
    }
    let shown = by_stage.into_iter().map(|(stage, ids)| match ids.len() {
        0..=3 => format!("{stage} ({})", ids.join(", ")),
        n => format!("{stage} ({}, … {n} in all)", ids[..3].join(", ")),
    });
    shown.collect::<Vec<_>>().join(", ")
}
