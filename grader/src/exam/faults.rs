//! Answers that cannot be trusted: which they are, why, and the command that renews them.

use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;

use cases::answer::AnswerError;

use crate::blame::{self, Blame};

/// The folder in which `reference expect` looks for stages by default.
const USUAL_FOLDER: &str = "cases/stages";
/// Largest number of cases that the command names. For more, it names their stage or folder.
const MOST_NAMED: usize = 3;

/// A question, or a list of them, without an answer that can be trusted.
#[derive(Debug)]
pub struct Fault {
    /// The question.
    pub subject: Subject,
    /// The reason why its answer cannot be trusted.
    pub why: AnswerError,
}

/// The case, check or list that an answer belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The image case of this id.
    Case(String),
    /// The unit check of this id.
    Check(String),
    /// All unit checks of the stage of this id.
    Checks(String),
    /// The list of known mistakes.
    Mistakes,
}

impl Subject {
    /// Returns the id of the stage; `None` for the list of mistakes, which belongs to all of them.
    fn stage(&self) -> Option<&str> {
        match self {
            Self::Case(id) | Self::Check(id) => id.split('/').next(),
            Self::Checks(stage) => Some(stage),
            Self::Mistakes => None,
        }
    }

    /// Returns whether judging one of `ids` needs the answer.
    fn concerns(&self, ids: &BTreeSet<&str>) -> bool {
        match self {
            Self::Case(id) | Self::Check(id) => ids.contains(id.as_str()),
            Self::Checks(stage) => ids.iter().any(|id| is_check_of(id, stage)),
            Self::Mistakes => true,
        }
    }
}

/// Returns whether `id` is that of a unit check of `stage`, which has two parts after the stage.
/// The id of an image case has one.
fn is_check_of(id: &str, stage: &str) -> bool {
    id.strip_prefix(stage).is_some_and(|behind| behind.matches('/').count() == 2)
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Case(id) | Self::Check(id) => f.write_str(id),
            Self::Checks(stage) => write!(f, "{stage}: all unit checks"),
            Self::Mistakes => f.write_str("the list of known mistakes"),
        }
    }
}

/// The answers that are needed and cannot be trusted, so that nothing can be judged.
#[derive(Debug)]
pub struct Untrusted<'a> {
    folder: &'a Path,
    /// At least one.
    faults: Vec<&'a Fault>,
}

impl<'a> Untrusted<'a> {
    /// Returns the `faults` of the stages in `folder` that concern one of `ids`, or `None` if there
    /// are none.
    pub(super) fn among(
        folder: &'a Path,
        faults: &'a [Fault],
        ids: impl IntoIterator<Item = &'a str>,
    ) -> Option<Self> {
        if faults.is_empty() {
            return None;
        }
        let ids: BTreeSet<&str> = ids.into_iter().collect();
        let faults: Vec<&Fault> =
            faults.iter().filter(|fault| fault.subject.concerns(&ids)).collect();
        (!faults.is_empty()).then_some(Self { folder, faults })
    }

    /// Returns the party to blame: the machine if it fails to read one of the answers.
    pub fn blame(&self) -> Blame {
        match self.faults.iter().any(|fault| blame::of(&fault.why) == Blame::Machine) {
            true => Blame::Machine,
            false => Blame::File,
        }
    }

    /// Returns the faults of one kind, one line per stage: the names of its cases and the number of
    /// its checks.
    fn lines(&self, kind: Kind) -> Vec<String> {
        let of_kind = || self.faults.iter().filter(|fault| Kind::of(&fault.why) == kind);
        let stages: BTreeSet<&str> = of_kind().filter_map(|fault| fault.subject.stage()).collect();
        let mut lines = vec![];
        for stage in stages {
            let subjects =
                || of_kind().map(|fault| &fault.subject).filter(|one| one.stage() == Some(stage));
            let mut parts: Vec<String> = subjects()
                .filter_map(|subject| match subject {
                    Subject::Case(id) => id.split_once('/').map(|(_, name)| name.to_owned()),
                    Subject::Checks(_) => Some("all unit checks".to_owned()),
                    Subject::Check(_) | Subject::Mistakes => None,
                })
                .collect();
            match subjects().filter(|subject| matches!(subject, Subject::Check(_))).count() {
                0 => {}
                1 => parts.push("1 unit check".to_owned()),
                n => parts.push(format!("{n} unit checks")),
            }
            lines.push(format!("{stage}: {}", parts.join(", ")));
        }
        lines.extend(
            of_kind()
                .filter(|fault| fault.subject.stage().is_none())
                .map(|fault| fault.subject.to_string()),
        );
        lines
    }
}

/// The kinds of fault, each with a heading of its own in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Missing,
    Stale,
    Broken,
}

impl Kind {
    fn of(why: &AnswerError) -> Self {
        match why {
            AnswerError::Missing => Self::Missing,
            AnswerError::Stale => Self::Stale,
            AnswerError::Unreadable(_) | AnswerError::Picture(_) | AnswerError::Json(_) => {
                Self::Broken
            }
        }
    }

    fn heading(self) -> &'static str {
        match self {
            Self::Missing => "there are no stored answers to",
            Self::Stale => {
                "the stored answers do not belong to the cases, the course or the rules as they \
                    are now"
            }
            Self::Broken => "the stored answers cannot be read",
        }
    }
}

impl fmt::Display for Untrusted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for kind in [Kind::Missing, Kind::Stale, Kind::Broken] {
            let lines = self.lines(kind);
            if !lines.is_empty() {
                writeln!(f, "error: {}: {}", kind.heading(), lines.join("; "))?;
            }
        }
        let subjects: Vec<&Subject> = self.faults.iter().map(|fault| &fault.subject).collect();
        write!(f, "help: `{}` renews them; nothing was graded", command(self.folder, &subjects))
    }
}

/// Returns the command that renews the answers to `subjects`: up to [`MOST_NAMED`] cases, a stage,
/// or all of `folder`.
pub(super) fn command(folder: &Path, subjects: &[&Subject]) -> String {
    let is_usual = folder == Path::new(USUAL_FOLDER);
    let path = |id: &str| match is_usual {
        true => id.to_owned(),
        false => folder.join(id).display().to_string(),
    };
    let ids: Option<Vec<&str>> = subjects
        .iter()
        .map(|subject| match subject {
            Subject::Case(id) => Some(id.as_str()),
            Subject::Check(_) | Subject::Checks(_) | Subject::Mistakes => None,
        })
        .collect();
    let stages: BTreeSet<Option<&str>> = subjects.iter().map(|subject| subject.stage()).collect();
    let words = match (ids, stages.first()) {
        (Some(ids), _) if ids.len() <= MOST_NAMED => {
            let ending = if is_usual { "" } else { ".toml" };
            ids.iter().map(|id| format!(" {}{ending}", path(id))).collect()
        }
        (_, Some(Some(stage))) if stages.len() == 1 => format!(" {}", path(stage)),
        _ if is_usual => String::new(),
        _ => format!(" {}", folder.display()),
    };
    format!("reference expect{words}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(folder: &str, subjects: &[Subject], expected: &str) {
        let subjects: Vec<&Subject> = subjects.iter().collect();
        assert_eq!(command(Path::new(folder), &subjects), expected);
    }

    #[test]
    fn the_command_is_as_narrow_as_the_faults() {
        let case = |id: &str| Subject::Case(id.to_owned());
        let unit = |id: &str| Subject::Check(id.to_owned());
        let two = [case("01_a/x"), case("02_b/y")];
        check("cases/stages", &two, "reference expect 01_a/x 02_b/y");
        check("hidden", &two, "reference expect hidden/01_a/x.toml hidden/02_b/y.toml");
        check("cases/stages", &[case("01_a/x"), unit("01_a/sphere/z")], "reference expect 01_a");
        check("hidden", &[Subject::Checks("01_a".to_owned())], "reference expect hidden/01_a");
        check("cases/stages", &[unit("01_a/sphere/z"), unit("02_b/sphere/z")], "reference expect");
        check("hidden", &[case("01_a/x"), Subject::Mistakes], "reference expect hidden");
        check("cases/stages", &[Subject::Mistakes], "reference expect");
        let many = ["01_a/1", "01_a/2", "01_a/3", "01_a/4"].map(case);
        check("cases/stages", &many, "reference expect 01_a");
    }

    #[test]
    fn the_message_names_every_case_and_counts_checks() {
        let fault = |subject, why| Fault { subject, why };
        let faults = [
            fault(Subject::Case("01_a/x".to_owned()), AnswerError::Stale),
            fault(Subject::Case("01_a/y".to_owned()), AnswerError::Stale),
            fault(Subject::Check("01_a/sphere/z".to_owned()), AnswerError::Stale),
            fault(Subject::Checks("02_b".to_owned()), AnswerError::Missing),
        ];
        let text =
            Untrusted { folder: Path::new("hidden"), faults: faults.iter().collect() }.to_string();
        let expected = "error: there are no stored answers to: 02_b: all unit checks\n\
            error: the stored answers do not belong to the cases, the course or the rules as they \
            are now: \
            01_a: x, y, 1 unit check\n\
            help: `reference expect hidden` renews them; nothing was graded";
        assert_eq!(text, expected);
    }

    #[test]
    fn only_what_is_selected_counts() {
        let ids = BTreeSet::from(["01_a/x", "01_a/sphere/z"]);
        let concerns = |subject: Subject| subject.concerns(&ids);
        assert!(
            concerns(Subject::Case("01_a/x".to_owned()))
                && !concerns(Subject::Case("01_a/y".to_owned()))
        );
        assert!(
            concerns(Subject::Checks("01_a".to_owned()))
                && !concerns(Subject::Checks("02_b".to_owned()))
        );
        assert!(concerns(Subject::Mistakes));
        assert!(!Subject::Checks("01_a".to_owned()).concerns(&BTreeSet::from(["01_a/x"])));
    }
}
