//! How a judge did over all variants, and the bars that this grader must take.

use std::collections::BTreeMap;

use crate::lab::Trial;
use crate::variants::Nature;

/// Percent of the bugs that must lose their first points in the stage where they are.
pub const RIGHT_STAGE: usize = 95;

/// Percent of the bugs that a known misconception describes which must be called by its name first.
pub const RIGHT_NAME: usize = 95;

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
    /// Of a judge for whom a trial fails first in the stage that `first_stage` gives, among the
    /// `trials` that it could tell apart.
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

    /// What keeps this grader from its bars.
    fn faults(&self) -> Vec<String> {
        let mut faults = say("right, but it lost points", &self.false_fails);
        faults.extend(say("wrong, but it lost none", &self.misses));
        if self.n_in_right_stage() * 100 < self.n_caught() * RIGHT_STAGE {
            faults.extend(say("it lost its first points in another stage", &self.misplaced));
        }
        faults
    }
}

fn say(what: &str, names: &[String]) -> Vec<String> {
    names.iter().map(|name| format!("{what}: {name}")).collect()
}

/// How this grader named bugs.
#[derive(Clone, Debug, Default)]
pub struct Naming {
    /// Caught bugs that a known misconception describes.
    pub n_known: usize,
    /// Those of them that were called by another name first, or by none.
    pub misnamed: Vec<String>,
    /// Right variants of which a misconception was named.
    pub slandered: Vec<String>,
    /// Bugs that no misconception describes, and what was named first all the same.
    pub likened: Vec<String>,
}

impl Naming {
    /// That in `trials`.
    pub fn of(trials: &[Trial]) -> Self {
        let mut naming = Self::default();
        for trial in trials {
            let name = &trial.variant.name;
            let named = trial.named_first();
            match &trial.variant.nature {
                Nature::Right if named.is_empty() => {}
                Nature::Right => naming.slandered.push(format!("{name}: {}", named.join(" or "))),
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
                    naming.likened.push(format!("{name}: {}", named.join(" or ")))
                }
            }
        }
        naming
    }

    /// Bugs that were called by their names first.
    pub fn n_named(&self) -> usize {
        self.n_known - self.misnamed.len()
    }

    /// What keeps this grader from its bar for names.
    pub fn faults(&self) -> Vec<String> {
        let is_enough = self.n_named() * 100 >= self.n_known * RIGHT_NAME;
        if is_enough { vec![] } else { say("called by another name", &self.misnamed) }
    }
}

/// What keeps this grader from its bars for points, and right programs that it calls wrong.
pub fn faults(trials: &[Trial]) -> Vec<String> {
    let slander = say("right, but a mistake is named", &Naming::of(trials).slandered);
    [Tally::of_this_grader(trials).faults(), slander].concat()
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
