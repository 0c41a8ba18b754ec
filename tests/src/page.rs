//! The page `docs/judging.md`: how this grader and others do on the same programs.

use crate::bars::{Naming, Tally};
use crate::lab::Trial;
use crate::peers::Tool;
use crate::rules::RULES;

/// A judge in the table.
struct Judge {
    name: String,
    says: String,
    tally: Tally,
}

/// The page in Markdown.
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
    let (ours, naming) = (Tally::of_this_grader(trials), Naming::of(trials));
    [head(trials, &seen, &ours, &naming), table(&judges), lists(&ours, &naming, &judges)].concat()
}

fn pictures_lost(trial: &Trial) -> Option<String> {
    let is_picture = |id: &str| trial.shown.iter().any(|shown| shown.case == id);
    trial.lost().find(|check| is_picture(&check.id)).map(|check| check.id.clone())
}

/// The tally of a judge by the first case that it fails.
fn by_first_case(trials: &[&Trial], first: impl Fn(&Trial) -> Option<String>) -> Tally {
    let stage =
        |trial: &Trial| first(trial).and_then(|case| case.split('/').next().map(str::to_owned));
    Tally::of(trials.iter().copied(), stage, |trial| first(trial).unwrap_or_default())
}

fn head(trials: &[Trial], seen: &[&Trial], ours: &Tally, naming: &Naming) -> String {
    let n_seen = seen.iter().filter(|trial| trial.stage().is_some()).count();
    let n_cases = trials.first().map_or(0, |trial| trial.shown.len());
    format!(
        "\
# How well the judge judges

Made by `cargo run --release -p tests --bin judge -- --out docs/judging.md`; do not edit.

[tests/mutants](../tests/mutants/README.md) holds {n_wrong} programs with a single bug each and \
{n_right} right ones written differently. All are built and
graded on the public stages: {n_cases} image cases and the unit checks.

| this grader, pictures and unit checks | | bar |
|---|---|---|
| right programs that lose points | {n_false} of {n_right} | 0 |
| bugs that lose none | {n_missed} of {n_wrong} | 0 |
| bugs that lose their first points in their own stage | {n_placed} of {n_caught}, {share} | 95 % |
| bugs that a known mistake describes and that are called by its name first | {n_named} of \
{n_known}, {named} | 95 % |
| right programs of which a mistake is named | {n_slandered} of {n_right} | 0 |

## Beside other judges

Other judges compare pictures only, so here this grader does too, on the {n_seen} bugs that \
change some byte of a picture outside contested pixels. A
program fails where any of its {n_cases} pictures fails; a program without a picture fails. The \
tools are the real ones, at their defaults (perceptualdiff is left out: no package registry has it).

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
        n_slandered = naming.slandered.len(),
    )
}

fn table(judges: &[Judge]) -> String {
    let mut text = "\
| judge | right programs failed | bugs passed | bugs caught in the right stage first |
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
    text += "\nA picture passes where\n\n";
    for Judge { name, says, .. } in judges {
        text += &format!("- {name}: {says}\n");
    }
    text
}

fn lists(ours: &Tally, naming: &Naming, judges: &[Judge]) -> String {
    let mut text = "\n## What went wrong\n\n### This grader\n\n".to_owned();
    text += &list("Right, but lost points", &ours.false_fails);
    text += &list("Wrong, but lost none", &ours.misses);
    text += &list("Lost first points in another stage", &ours.misplaced);
    text += &list("Called by another name", &naming.misnamed);
    text += &list("Right, but a mistake is named", &naming.slandered);
    text += &list("Described by no known mistake, but likened to one", &naming.likened);
    for Judge { name, tally, .. } in &judges[1..] {
        text += &format!("### {name}\n\n");
        text += &list("Right, but failed", &tally.false_fails);
        text += &list("Wrong, but passed", &tally.misses);
    }
    text.trim_end().to_owned() + "\n"
}

fn list(what: &str, names: &[String]) -> String {
    match names {
        [] => format!("{what}: none.\n\n"),
        _ => {
            format!("{what}: {}.\n\n", names.join("; ").replace("wrong/", "").replace("right/", ""))
        }
    }
}

fn percent(n: usize, of: usize) -> String {
    format!("{:.1} %", n as f64 * 100.0 / of.max(1) as f64)
}
