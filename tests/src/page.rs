//! Writes the page `docs/judging.md`: the results of this grader and of other judges on the same
//! programs.

use crate::bars::{Naming, RIGHT_STAGE, VerdictCounts};
use crate::lab::Trial;
use crate::peers::Tool;
use crate::rules::RULES;

/// A judge in the table.
struct Judge {
    name: String,
    says: String,
    tally: VerdictCounts,
}

/// Returns the page in Markdown.
pub fn page(trials: &[Trial], tools: &[Tool]) -> String {
    let seen: Vec<&Trial> =
        trials.iter().filter(|trial| trial.stage().is_none() || trial.is_seen()).collect();
    let mut judges = vec![Judge {
        name: "**this grader**, its pictures alone".to_owned(),
        says: "its cases' own limits (grading.md); unit checks left out".to_owned(),
        tally: by_first_case(&seen, pictures_lost),
    }];
    judges.extend(RULES.iter().enumerate().map(|(at, rule)| Judge {
        name: rule.name.to_owned(),
        says: rule.says.to_owned(),
        tally: by_first_case(&seen, |trial| {
            trial.shown.iter().find(|shown| !shown.passes[at]).map(|shown| shown.case.clone())
        }),
    }));
    judges.extend(tools.iter().map(|tool| Judge {
        name: tool.name.clone(),
        says: tool.says.clone(),
        tally: by_first_case(&seen, |trial| tool.fails.get(&trial.variant.name).cloned()),
    }));
    let (ours, naming) = (VerdictCounts::of_this_grader(trials), Naming::of(trials));
    [head(trials, &seen, &ours, &naming), table(&judges), lists(&ours, &naming, &judges)].concat()
}

fn pictures_lost(trial: &Trial) -> Option<String> {
    let is_picture = |id: &str| trial.shown.iter().any(|shown| shown.case == id);
    trial.lost().find(|check| is_picture(&check.id)).map(|check| check.id.clone())
}

/// Returns the tally of a judge from the first case that it fails in each trial.
fn by_first_case(trials: &[&Trial], first: impl Fn(&Trial) -> Option<String>) -> VerdictCounts {
    let stage =
        |trial: &Trial| first(trial).and_then(|case| case.split('/').next().map(str::to_owned));
    VerdictCounts::of(trials.iter().copied(), stage, |trial| first(trial).unwrap_or_default())
}

fn head(trials: &[Trial], seen: &[&Trial], ours: &VerdictCounts, naming: &Naming) -> String {
    let n_seen = seen.iter().filter(|trial| trial.stage().is_some()).count();
    let n_cases = trials.first().map_or(0, |trial| trial.shown.len());
    let is_reached = [
        ours.false_fails.is_empty(),
        ours.misses.is_empty(),
        ours.n_in_right_stage() * 100 >= ours.n_caught() * RIGHT_STAGE,
        naming.faults().is_empty(),
        naming.falsely_named.is_empty(),
    ];
    let n_bars = is_reached.len();
    let n_reached = is_reached.into_iter().filter(|is| *is).count();
    format!(
        "\
# How well the judge judges

Made by `cargo run --release -p tests --bin judge -- --out docs/judging.md`; do not edit.

{n_reached} of {n_bars} bars are reached.

| this grader, pictures and unit checks | | bar |
|---|---|---|
| correct programs that lose points | {n_false} of {n_right} | 0 |
| bugs that lose no points | {n_missed} of {n_wrong} | 0 |
| bugs that first lose points in their own stage | {n_placed} of {n_caught}, {share} | 95 % |
| bugs with a known mistake that are named as it first | {n_named} of {n_known}, {named} | 95 % |
| correct programs with a named mistake | {n_slandered} of {n_right} | 0 |

[tests/mutants](../tests/mutants/README.md) holds {n_wrong} programs with a single bug each and
{n_right} correct ones written differently. All are built and graded on the public stages:
{n_cases} image cases and the unit checks.

## Beside other judges

Other judges compare only pictures, so this grader does the same here, on the {n_seen} bugs
that change some byte of a picture outside contested pixels. A program fails if any of its
{n_cases} pictures fails or is missing. The tools are the real ones, at their defaults
(perceptualdiff is left out: no package registry has it).

",
        n_wrong = ours.n_wrong,
        n_right = ours.n_right,
        n_false = ours.false_fails.len(),
        n_missed = ours.misses.len(),
        n_placed = ours.n_in_right_stage(),
        n_caught = ours.n_caught(),
        share = percent(ours.n_in_right_stage(), ours.n_caught()),
        n_named = naming.n_named(),
        n_known = naming.n_known,
        named = percent(naming.n_named(), naming.n_known),
        n_slandered = naming.falsely_named.len(),
    )
}

fn table(judges: &[Judge]) -> String {
    let mut text = "\
| judge | correct programs failed | bugs passed | bugs caught first in their own stage |
|---|---:|---:|---:|
"
    .to_owned();
    for Judge { name, tally, .. } in judges {
        let (false_fails, misses) = (tally.false_fails.len(), tally.misses.len());
        text += &format!(
            "| {name} | {false_fails} ({}) | {misses} ({}) | {} |\n",
            percent(false_fails, tally.n_right),
            percent(misses, tally.n_wrong),
            percent(tally.n_in_right_stage(), tally.n_wrong),
        );
    }
    text += "\nConditions under which a picture passes:\n\n";
    for Judge { name, says, .. } in judges {
        text += &format!("- {name}: {says}\n");
    }
    text
}

fn lists(ours: &VerdictCounts, naming: &Naming, judges: &[Judge]) -> String {
    let mut text = "\n## What went wrong\n\n### This grader\n\n".to_owned();
    text += &list("Correct programs that lost points", &ours.false_fails);
    text += &list("Bugs that lost no points", &ours.misses);
    text += &list("Bugs that first lost points in another stage", &ours.misplaced);
    text += &list("Bugs named as another mistake", &naming.misnamed);
    text += &list("Correct programs with a named mistake", &naming.falsely_named);
    text +=
        &list("Bugs without a known mistake that were named as one", &naming.named_without_cause);
    for Judge { name, tally, .. } in &judges[1..] {
        text += &format!("### {name}\n\n");
        text += &list("Correct programs that failed", &tally.false_fails);
        text += &list("Bugs that passed", &tally.misses);
    }
    text.trim_end().to_owned() + "\n"
}

/// Returns a list with a bullet for each name.
fn list(what: &str, names: &[String]) -> String {
    if names.is_empty() {
        return format!("{what}: none.\n\n");
    }
    let bullet =
        |name: &String| format!("- {}\n", name.replace("wrong/", "").replace("right/", ""));
    format!("{what}:\n\n{}\n", names.iter().map(bullet).collect::<String>())
}

fn percent(n: usize, of: usize) -> String {
    format!("{:.1} %", n as f64 * 100.0 / of.max(1) as f64)
}
