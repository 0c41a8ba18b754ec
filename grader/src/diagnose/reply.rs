//! A program's answer to a unit check, and the mistakes that give the same answer.

use std::collections::BTreeMap;

use cases::answer::CheckAnswer;
use cases::probe::Answer;
use layers::counts::{CHECK, Counts};

use crate::judge;

/// The evidence of one unit check.
#[derive(Clone, Debug)]
pub struct Reply {
    /// The id of the check.
    pub(super) id: String,
    /// The answer that the program gave.
    actual: Answer,
    is_right: bool,
    /// The mistakes that make the answer wrong, each with whether the program gave that answer.
    given: BTreeMap<String, bool>,
    is_explained: bool,
    is_touched: bool,
}

impl Reply {
    /// Returns the evidence of the answer `actual` to the check `id`.
    pub fn new(id: &str, is_right: bool, actual: &Answer, right: &CheckAnswer) -> Self {
        let is_like = |wrong: &Answer| !is_right && judge::equal(wrong, actual, right.allowed);
        Self {
            id: id.to_owned(),
            actual: actual.clone(),
            is_right,
            given: right.wrong.iter().map(|(id, wrong)| (id.clone(), is_like(wrong))).collect(),
            is_explained: false,
            is_touched: false,
        }
    }

    /// Drops all evidence if the program gives the same answer to every check: it then says nothing
    /// about a mistake. What is wrong stays wrong.
    pub(super) fn mute(replies: &mut [Self]) {
        let is_mute =
            replies.len() > 1 && replies.windows(2).all(|pair| pair[0].actual == pair[1].actual);
        if is_mute {
            replies.iter_mut().for_each(|reply| reply.given.clear());
        }
    }

    /// Returns the ids of the mistakes that make the answer wrong.
    pub(super) fn mistakes(&self) -> impl Iterator<Item = &str> {
        self.given.keys().map(String::as_str)
    }

    /// Returns the counts for and against a mistake beside the named ones. All are 0 if the mistake
    /// leaves the answer right.
    pub(super) fn count(&self, id: &str) -> Counts {
        let none = Counts::default();
        match self.given.get(id) {
            None => none,
            Some(_) if self.is_right => Counts { right: CHECK, ..none },
            Some(true) if self.is_explained => none,
            Some(true) => Counts { hits: CHECK, ..none },
            Some(false) if self.is_explained => Counts { other: CHECK, ..none },
            Some(false) if self.is_touched => Counts { mixed: CHECK, ..none },
            Some(false) => Counts { open: CHECK, ..none },
        }
    }

    /// Forgets all named mistakes.
    pub(super) fn clear(&mut self) {
        (self.is_explained, self.is_touched) = (false, false);
    }

    /// Marks a mistake as named.
    pub(super) fn mark(&mut self, id: &str, is_explained: bool) {
        self.is_explained |= is_explained;
        self.is_touched |= self.given.contains_key(id);
    }

    /// Returns whether the answer is wrong and no named mistake explains it.
    pub(super) fn is_open(&self) -> bool {
        !self.is_right && !self.is_explained
    }
}

#[cfg(test)]
pub(super) mod tests {
    use cases::answer::Digest;

    use super::*;

    /// Returns the reply `actual` to a check for which 1 is right, with the wrong values of
    /// mistakes.
    pub(crate) fn reply(id: &str, actual: f64, wrong: &[(&str, f64)]) -> Reply {
        let wrong = wrong.iter().map(|(id, value)| ((*id).to_owned(), Answer::Value(*value)));
        let right = CheckAnswer {
            id: id.to_owned(),
            made_from: Digest::default(),
            answer: Answer::Value(1.0),
            allowed: 1e-6,
            also: vec![],
            wrong: wrong.collect(),
        };
        Reply::new(id, actual == 1.0, &Answer::Value(actual), &right)
    }

    #[test]
    fn an_answer_speaks_for_the_mistakes_that_give_it() {
        let wrong = [("twice", 2.0), ("none", f64::NAN), ("also", 2.0)];
        let none = Counts::default();
        for (actual, id, expected) in [
            (2.0 + 9e-7, "twice", Counts { hits: CHECK, ..none }),
            (2.1, "twice", Counts { open: CHECK, ..none }),
            (f64::NAN, "none", Counts { hits: CHECK, ..none }),
            (1.0, "none", Counts { right: CHECK, ..none }),
            (2.0, "unknown", none),
        ] {
            assert_eq!(reply("x", actual, &wrong).count(id), expected, "{actual} {id}");
        }
    }

    #[test]
    fn one_answer_to_every_check_is_no_evidence() {
        let two = || reply("x", 2.0, &[("twice", 2.0)]);
        let mut same = [two(), two()];
        Reply::mute(&mut same);
        assert_eq!((same[0].count("twice").all(), same[0].is_open()), (0, true));
        let mut several = [two(), reply("y", 3.0, &[])];
        Reply::mute(&mut several);
        assert_eq!(several[0].count("twice").hits, CHECK);
    }

    #[test]
    fn a_named_mistake_weakens_the_evidence_about_others() {
        let mut reply = reply("x", 2.0, &[("twice", 2.0), ("also", 2.0), ("thrice", 3.0)]);
        assert!(reply.is_open());
        reply.mark("thrice", false);
        assert_eq!((reply.count("twice").hits, reply.count("thrice").mixed), (CHECK, CHECK));
        reply.mark("twice", true);
        assert!(!reply.is_open());
        assert_eq!((reply.count("also").all(), reply.count("thrice").other), (0, CHECK));
        reply.clear();
        assert_eq!(reply.count("thrice").open, CHECK);
    }
}
