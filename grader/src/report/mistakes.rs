//! A diagnosis in words: the likely mistake, the place to look at, the broken rule, and the number
//! of failures that it explains.

use cases::answer::Mistake;

use crate::plain::shown;
use crate::record::{CheckKind, Diagnosis, Record, Verdict};

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

/// Returns the place to look at, such as `reflection.rs, function reflect`.
pub fn place(mistake: &Mistake) -> String {
    shown(&mistake.look_at.replacen(' ', ", function ", 1))
}

/// Returns the number of failures that a diagnosis explains, such as
/// `5 of 6 failed pictures and 1 of 1 failed unit check`.
pub fn extent(record: &Record, diagnosis: &Diagnosis) -> String {
    let failed = |check: &&crate::record::CheckRecord| {
        matches!(check.verdict, Verdict::Partial | Verdict::Fail)
    };
    let of_kind = |kind: CheckKind, name: &str| {
        let failed = record
            .stages
            .iter()
            .flat_map(|stage| &stage.checks)
            .filter(failed)
            .filter(|one| one.kind == kind);
        let (n_explained, n) = failed.fold((0, 0), |(explained, n), one| {
            (explained + usize::from(diagnosis.explains.contains(&one.id)), n + 1)
        });
        let s = if n == 1 { "" } else { "s" };
        (n_explained > 0).then(|| format!("{n_explained} of {n} failed {name}{s}"))
    };
    let parts = [of_kind(CheckKind::Image, "picture"), of_kind(CheckKind::Unit, "unit check")];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" and ")
}

/// Returns the sentence on the mistake `id` among the diagnoses of the record. `None` if no
/// diagnosis has it.
pub fn says<'a>(record: &'a Record, id: &str) -> Option<&'a str> {
    let mistakes = record.diagnoses.iter().flat_map(|diagnosis| &diagnosis.mistakes);
    mistakes.into_iter().find(|mistake| mistake.id == id).map(|mistake| mistake.says.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let explains = vec!["01_ray_casting/sphere/inside".to_owned()];
        assert_eq!(
            extent(&record, &Diagnosis { explains, ..diagnosis }),
            "1 of 1 failed unit check"
        );
    }
}
