//! The results of a judge over all variants, and the bars that this grader must reach.

use std::collections::BTreeMap;

use crate::lab::Trial;
use crate::variants::Nature;

/// The percentage of bugs that must lose their first points in their own stage.
pub const RIGHT_STAGE: usize = 95;

/// The percentage of bugs with a known misconception that must be named as it first.
pub const RIGHT_NAME: usize = 95;

/// The results of a judge, with the names of the variants that it judged wrongly.
#[derive(Clone, Debug, Default)]
pub struct VerdictCounts {
    /// The number of correct variants.
    pub n_right: usize,
    /// The number of variants with a bug that the judge could see.
    pub n_wrong: usize,
    /// The correct variants that failed, and where.
    pub false_fails: Vec<String>,
    /// The bugs that passed.
    pub misses: Vec<String>,
    /// The bugs that failed first in another stage than their own, and where.
    pub misplaced: Vec<String>,
}

impl VerdictCounts {
    /// Returns the results of a judge on `trials`. `first_stage` gives the first stage in which the
    /// judge fails a trial, `place` says where it fails.
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
                        Some(_) => {
                            tally.misplaced.push(format!("{name}: {}, not {stage}", place(trial)))
                        }
                    }
                }
            }
        }
        tally
    }

    /// Returns the results of this grader.
    pub fn of_this_grader(trials: &[Trial]) -> Self {
        Self::of(trials, |trial| trial.first_stage().map(str::to_owned), lost)
    }

    /// Returns the number of bugs that failed.
    pub fn n_caught(&self) -> usize {
        self.n_wrong - self.misses.len()
    }

    /// Returns the number of bugs that failed first in their own stage.
    pub fn n_in_right_stage(&self) -> usize {
        self.n_caught() - self.misplaced.len()
    }

    /// Returns the faults that keep this grader from its bars.
    fn faults(&self) -> Vec<String> {
        let mut faults = say("a correct program lost points", &self.false_fails);
        faults.extend(say("a bug lost no points", &self.misses));
        if self.n_in_right_stage() * 100 < self.n_caught() * RIGHT_STAGE {
            faults.extend(say("a bug first lost points in another stage", &self.misplaced));
        }
        faults
    }
}

fn say(what: &str, names: &[String]) -> Vec<String> {
    names.iter().map(|name| format!("{what}: {name}")).collect()
}

/// The mistakes that this grader named.
#[derive(Clone, Debug, Default)]
pub struct Naming {
    /// The number of caught bugs with a known misconception.
    pub n_known: usize,
    /// The bugs among them that were named as another misconception first, or as none.
    pub misnamed: Vec<String>,
    /// The correct variants with a named misconception.
    pub falsely_named: Vec<String>,
    /// The bugs without a known misconception, with the misconception that was named first
    /// nevertheless.
    pub named_without_cause: Vec<String>,
}

impl Naming {
    /// Returns the names that were given in `trials`.
    pub fn of(trials: &[Trial]) -> Self {
        let mut naming = Self::default();
        for trial in trials {
            let name = &trial.variant.name;
            let named = trial.named_first();
            match &trial.variant.nature {
                Nature::Right if named.is_empty() => {}
                Nature::Right => {
                    naming.falsely_named.push(format!("{name}: {}", named.join(" or ")))
                }
                Nature::Wrong { diagnosis: Some(right), .. } if trial.first_stage().is_some() => {
                    naming.n_known += 1;
                    if !named.contains(&right.as_str()) {
                        let said = if named.is_empty() {
                            "nothing".to_owned()
                        } else {
                            named.join(" or ")
                        };
                        naming.misnamed.push(format!("{name}: {said}, not {right}"));
                    }
                }
                Nature::Wrong { .. } if named.is_empty() => {}
                Nature::Wrong { .. } => {
                    naming.named_without_cause.push(format!("{name}: {}", named.join(" or ")))
                }
            }
        }
        naming
    }

    /// Returns the number of bugs that were named as their misconception first.
    pub fn n_named(&self) -> usize {
        self.n_known - self.misnamed.len()
    }

    /// Returns the faults that keep this grader from its bar for names; empty if the bar is
    /// reached.
    pub fn faults(&self) -> Vec<String> {
        let is_enough = self.n_named() * 100 >= self.n_known * RIGHT_NAME;
        if is_enough { vec![] } else { say("a bug was named as another mistake", &self.misnamed) }
    }
}

/// Returns the faults that keep this grader from its bars for points, and the correct programs with
/// a named mistake.
pub fn faults(trials: &[Trial]) -> Vec<String> {
    let slander =
        say("a mistake was named for a correct program", &Naming::of(trials).falsely_named);
    [VerdictCounts::of_this_grader(trials).faults(), slander].concat()
}

/// Lists the checks that cost points by stage, at most three names for each.
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
