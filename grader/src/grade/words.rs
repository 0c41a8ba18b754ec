//! Messages for words on the command line that select nothing.

use std::collections::BTreeSet;

use cases::problem::did_you_mean;
use pages::lines::some;

/// The number of names that are listed; more would hide the message.
const MOST_LISTED: usize = 12;

/// Returns a message that no stage begins with `word`, with the most likely intended stage and the
/// list of stages.
pub(super) fn no_stage(word: &str, ids: &[&str]) -> String {
    // `shadows` means `02_shadows`, although the id begins with a number.
    let titles = ids.iter().filter_map(|id| Some((id.split_once('_')?.1, *id)));
    let names: Vec<(&str, &str)> = ids.iter().map(|id| (*id, *id)).chain(titles).collect();
    let meant = did_you_mean(word, names.iter().map(|(name, _)| *name));
    let meant =
        meant.and_then(|meant| names.iter().find(|(name, _)| *name == meant)).map(|(_, id)| *id);
    let list = some(ids.iter().copied(), MOST_LISTED);
    format!("there is no stage `{word}`{}\nThe stages are {list}.", suggestion(meant))
}

/// Returns a message that no id of a check begins with `word`, with the most likely intended check
/// and the list of checks.
pub(super) fn no_check(word: &str, ids: &[&str]) -> String {
    // From `01_ray_casting/sphere/tangent`: all of it, `sphere/tangent` and `sphere`.
    let behind = |id: &&str| id.split_once('/').map(|(_, behind)| behind.to_owned());
    let names: Vec<String> = ids.iter().filter_map(behind).collect();
    let heads = names.iter().map(|name| name.split('/').next().unwrap_or_default());
    let heads: Vec<&str> = {
        let mut seen = BTreeSet::new();
        heads.filter(|head| seen.insert(*head)).collect()
    };
    let known =
        heads.iter().copied().chain(names.iter().map(String::as_str)).chain(ids.iter().copied());
    let meant = did_you_mean(word, known);
    let list = some(heads.iter().copied(), MOST_LISTED);
    format!(
        "there is no case or check `{word}`{}\n\
            There are {list}. An id looks like `02_shadows/two_lamps`; its beginning, or that of \
            its part after the stage, is enough.",
        suggestion(meant)
    )
}

fn suggestion(meant: Option<&str>) -> String {
    meant.map_or(String::new(), |meant| format!("; did you mean `{meant}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const STAGES: [&str; 3] = ["01_ray_casting", "02_shadows", "03_reflection"];
    const IDS: [&str; 5] = [
        "01_ray_casting/boxes",
        "01_ray_casting/sphere/tangent",
        "01_ray_casting/sphere/inside",
        "02_shadows/two_lamps",
        "02_shadows/shadow/behind",
    ];

    #[test]
    fn a_stage_that_is_not_there_is_answered_with_those_that_are() {
        let table = [
            ("shadows", "there is no stage `shadows`; did you mean `02_shadows`?\n"),
            ("02_shadwos", "there is no stage `02_shadwos`; did you mean `02_shadows`?\n"),
            (
                "7",
                "there is no stage `7`\n\
                    The stages are `01_ray_casting`, `02_shadows` and `03_reflection`.",
            ),
        ];
        for (word, start) in table {
            let said = no_stage(word, &STAGES);
            assert!(said.starts_with(start), "{said}");
        }
    }

    #[test]
    fn a_check_that_is_not_there_is_answered_with_those_that_are() {
        let table = [
            ("spere", "; did you mean `sphere`?"),
            ("sphere/insde", "; did you mean `sphere/inside`?"),
            ("02_shadows/two_lampz", "; did you mean `02_shadows/two_lamps`?"),
            ("banana", "`banana`\nThere are `boxes`, `sphere`, `two_lamps` and `shadow`."),
        ];
        for (word, part) in table {
            let said = no_check(word, &IDS);
            assert!(said.contains(part), "{said}");
        }
        let many: Vec<String> = (0..40).map(|n| format!("01_x/case_{n}")).collect();
        let said = no_check("banana", &many.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(said.contains("`case_11` and 28 more"), "{said}");
    }
}
