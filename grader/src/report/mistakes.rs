//! A diagnosis in words: the likely mistake, the place to look at, the broken rule, the number of
//! failures that it explains, and what remains unexplained.

use std::collections::BTreeMap;

use cases::answer::Mistake;
use pages::lines::count;

use super::words;
use crate::plain::shown;
use crate::record::{CheckKind, Confidence, Diagnosis, Explained, Record, Unexplained, Verdict};

/// The file with the rules, relative to the root of the workspace.
pub const RULES: &str = "docs/shading-model.md";
const TEXT: &str = include_str!("../../../docs/shading-model.md");

/// A rule as `docs/shading-model.md` has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// The title, such as `Rule 7: reflection`.
    pub title: &'static str,
    /// The formula and the explanation, in Markdown.
    pub text: &'static str,
}

/// Returns the rule of this number, or `None` for a number without a rule.
pub fn rule(number: u8) -> Option<Rule> {
    let title = TEXT
        .lines()
        .find(|line| line.starts_with(&format!("### Rule {number}:")))?
        .trim_start_matches("### ");
    let (_, behind) = TEXT.split_once(title)?;
    let end = behind.find("\n##").unwrap_or(behind.len());
    Some(Rule { title, text: behind[..end].trim_matches('\n') })
}

impl Rule {
    /// Returns the link to the rule, such as `docs/shading-model.md#rule-7-reflection`.
    pub fn link(self) -> String {
        let anchor = self.title.chars().filter(|letter| letter.is_alphanumeric() || *letter == ' ');
        format!("{RULES}#{}", anchor.collect::<String>().to_lowercase().replace(' ', "-"))
    }
}

/// Returns the words before a mistake that is named with this confidence.
pub fn lead(confidence: Confidence) -> &'static str {
    match confidence {
        Confidence::Surely => "Most likely",
        Confidence::Perhaps => "Perhaps",
    }
}

/// Returns the place to look at, such as `reflection.rs, function reflect`. Without a file it is
/// `the function reflect, or what does its work`. `None` if the template has no such place.
pub fn place(mistake: &Mistake) -> Option<String> {
    let text = match mistake.look_at.split_once(' ') {
        Some((file, function)) => format!("{file}, function {function}"),
        None if mistake.look_at.is_empty() => return None,
        None => format!("the function {}, or what does its work", mistake.look_at),
    };
    Some(shown(&text))
}

/// Returns the number of failures that a diagnosis explains, such as
/// `5 of 6 failed pictures and 1 of 1 failed unit check`. It is empty if it explains none of the
/// record's.
pub fn extent(record: &Record, diagnosis: &Diagnosis) -> String {
    failed(record, &|id| diagnosis.explains.iter().any(|one| one.id == id))
}

/// Returns the number of failures of the record with an id that `is_counted`, by kind.
fn failed(record: &Record, is_counted: &dyn Fn(&str) -> bool) -> String {
    let is_failed = |check: &&crate::record::CheckRecord| {
        matches!(check.verdict, Verdict::Partial | Verdict::Fail)
    };
    let of_kind = |kind: CheckKind, name: &str| {
        let failed = record
            .stages
            .iter()
            .flat_map(|stage| &stage.checks)
            .filter(is_failed)
            .filter(|one| one.kind == kind);
        let (n_counted, n) = failed
            .fold((0, 0), |(counted, n), one| (counted + usize::from(is_counted(&one.id)), n + 1));
        let s = if n == 1 { "" } else { "s" };
        (n_counted > 0).then(|| format!("{n_counted} of {n} failed {name}{s}"))
    };
    let parts = [of_kind(CheckKind::Image, "picture"), of_kind(CheckKind::Unit, "unit check")];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" and ")
}

/// Returns what a mistake explains of a case in words, such as
/// `1100 pixels, most of them in columns 60 to 69 and rows 0 to 119`. Empty for a unit check.
pub fn part(explained: &Explained) -> String {
    if explained.pixels == 0 {
        return String::new();
    }
    let pixels = if explained.pixels == 1 { "pixel" } else { "pixels" };
    let region = explained.region.map(|[left, top, right, bottom]| {
        format!(", the largest region in columns {left} to {right} and rows {top} to {bottom}")
    });
    format!("{} {pixels}{}", explained.pixels, region.unwrap_or_default())
}

/// Returns what no mistake explains in words: the number of failures, and the pixel to look at.
pub fn rest(record: &Record, rest: &Unexplained) -> String {
    let extent = failed(record, &|id| rest.checks.iter().any(|one| one == id));
    let worst = rest.worst.as_ref().map(|worst| {
        let [column, row] = worst.pixel;
        let s = if worst.cluster == 1 { "pixel" } else { "pixels" };
        format!(
            "Look at the pixel in column {column}, row {row} of {}, among {} wrong {s} side by \
             side.",
            shown(&worst.check),
            worst.cluster
        )
    });
    format!("No known mistake explains all of {extent}. {}", worst.unwrap_or_default())
        .trim_end()
        .to_owned()
}

/// Returns what known mistakes earn, a sentence for each set of mistakes, such as
/// ``2.1 points for what `no_ambient` explains in 3 pictures of other stages``.
pub fn credits(record: &Record) -> Vec<String> {
    let mut sums: BTreeMap<Vec<&str>, (u64, usize)> = BTreeMap::new();
    let checks = record.stages.iter().flat_map(|stage| &stage.checks);
    for credit in checks.filter_map(|check| check.credit.as_ref()) {
        let ids = credit.mistakes.iter().map(String::as_str).collect();
        let (points, n) = sums.entry(ids).or_default();
        *points = points.saturating_add(credit.points);
        *n += 1;
    }
    let sentence = |(ids, (points, n)): (Vec<&str>, (u64, usize))| {
        let names: Vec<String> = ids.iter().map(|id| format!("`{}`", shown(id))).collect();
        let verb = if ids.len() == 1 { "explains" } else { "explain" };
        let s = if points == 1000 { "" } else { "s" };
        format!(
            "{} point{s} for what {} {verb} in {} of other stages",
            words::points(points),
            names.join(" and "),
            count(n, "picture")
        )
    };
    sums.into_iter().map(sentence).collect()
}

/// Returns the sentence on the mistake `id` among the diagnoses of the record, with the words that
/// stand before it. `None` if no diagnosis has it.
pub fn says<'a>(record: &'a Record, id: &str) -> Option<(&'static str, &'a str)> {
    record.diagnoses.iter().find_map(|diagnosis| {
        let mistake = diagnosis.mistakes.iter().find(|mistake| mistake.id == id)?;
        Some((lead(diagnosis.confidence), mistake.says.as_str()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Credit;
    use crate::report::sample;

    #[test]
    fn every_rule_is_found_with_its_formula_and_nothing_of_the_next() {
        for number in 1..=21 {
            let Rule { title, text } = rule(number).unwrap();
            assert!(title.starts_with(&format!("Rule {number}: ")), "{title}");
            assert!(text.len() > 60 && !text.contains("\n#"), "{title}: {text}");
        }
        assert!(rule(7).unwrap().text.starts_with("    R = d − 2 (d·N) N"));
        assert_eq!(rule(7).unwrap().link(), "docs/shading-model.md#rule-7-reflection");
        assert_eq!(rule(15).unwrap().link(), "docs/shading-model.md#rule-15-plane-square-box");
        assert_eq!(rule(0), None);
    }

    #[test]
    fn the_extent_counts_what_failed_of_each_kind() {
        let mut record = sample::record("somebody");
        let diagnosis = record.diagnoses.remove(0);
        assert_eq!(
            extent(&record, &diagnosis),
            "1 of 3 failed pictures and 1 of 1 failed unit check"
        );
        let explains = diagnosis.explains[1..].to_vec();
        assert_eq!(
            extent(&record, &Diagnosis { explains, ..diagnosis }),
            "1 of 1 failed unit check"
        );
    }

    #[test]
    fn credits_are_summed_by_mistake() {
        let mut record = sample::record("somebody");
        let one = "0.25 points for what `one` explains in 1 picture of other stages";
        assert_eq!(credits(&record), [one]);
        let checks = &mut record.stages[0].checks;
        let both = ["one".to_owned(), "other".to_owned()];
        checks[0].credit = Some(Credit { points: 1000, mistakes: both.into() });
        checks[1].credit = checks[2].credit.clone();
        assert_eq!(
            credits(&record),
            [
                "0.5 points for what `one` explains in 2 pictures of other stages",
                "1 point for what `one` and `other` explain in 1 picture of other stages",
            ]
        );
    }

    #[test]
    fn a_place_is_named_as_its_author_knows_it() {
        let mut mistake = sample::record("somebody").diagnoses[0].mistakes[0].clone();
        for (look_at, expected) in [
            ("sphere.rs intersect_sphere", Some("sphere.rs, function intersect_sphere")),
            ("reflect", Some("the function reflect, or what does its work")),
            ("", None),
        ] {
            look_at.clone_into(&mut mistake.look_at);
            assert_eq!(place(&mistake).as_deref(), expected);
        }
    }

    #[test]
    fn what_is_explained_and_what_is_not_has_its_place() {
        let record = sample::record("somebody");
        let [picture, check] = record.diagnoses[0].explains.as_slice() else { panic!() };
        let region = "1100 pixels, the largest region in columns 60 to 69 and rows 0 to 119";
        assert_eq!((part(picture).as_str(), part(check).as_str()), (region, ""));
        let unexplained = record.unexplained.as_ref().unwrap();
        assert_eq!(
            rest(&record, unexplained),
            "No known mistake explains all of 1 of 3 failed pictures. Look at the pixel in column \
             7, row 0 of 01_ray_casting/not_a_number, among 120 wrong pixels side by side."
        );
        let checks = Unexplained { worst: None, ..unexplained.clone() };
        assert!(rest(&record, &checks).ends_with("failed pictures."));
    }
}
