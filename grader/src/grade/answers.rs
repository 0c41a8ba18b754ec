//! The results of a plan while they are judged.

use std::collections::BTreeMap;

use cases::film::Image;
use cases::probe::Answer;

use crate::judge::Judgement;
use crate::record::{FindingKind, Verdict};

/// The result of a check.
pub(super) struct Done {
    /// The judgement on the check.
    pub(super) judgement: Judgement,
    /// The picture, if one of the right size could be read.
    pub(super) picture: Option<Image>,
    /// The answer to a unit check, if one could be read.
    pub(super) answer: Option<Answer>,
    pub(super) time_s: f64,
    /// CPU time; `None` where nothing was run.
    pub(super) cpu_s: Option<f64>,
    pub(super) peak_bytes: u64,
}

/// The results of a plan.
#[derive(Default)]
pub(super) struct Answers {
    /// Results by the id of the check.
    pub(super) done: BTreeMap<String, Done>,
    /// Remarks by the id of the stage.
    pub(super) remarks: BTreeMap<String, Vec<String>>,
    /// Pictures that earn more because of known mistakes.
    pub(super) credits: Vec<Credit>,
}

/// A wrong picture that earns more because of known mistakes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Credit {
    /// The id of the case.
    pub(super) id: String,
    /// The thousandths of its points that the picture earns with the credit.
    pub(super) share: u32,
    /// The thousandths that it earns without.
    pub(super) before: u32,
    /// Ids of the mistakes.
    pub(super) mistakes: Vec<String>,
}

/// The meaning of a judgement for a diagnosis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Right,
    Wrong,
    /// The result could not be judged, or only a person can judge it. Code that is still to be
    /// written belongs here: it is no mistake.
    Undecided,
}

impl Done {
    pub(super) fn unmeasured(judgement: Judgement, picture: Option<Image>) -> Self {
        Self { judgement, picture, answer: None, time_s: 0.0, cpu_s: None, peak_bytes: 0 }
    }

    pub(super) fn state(&self) -> State {
        let kind = self.judgement.finding.as_ref().map(|finding| finding.kind);
        match (self.judgement.verdict, kind) {
            (Verdict::Pass, None | Some(FindingKind::Remark)) => State::Right,
            (Verdict::Partial | Verdict::Fail, Some(FindingKind::Wrong)) => State::Wrong,
            _ => State::Undecided,
        }
    }

    /// Returns whether the answer is wrong, so that a mistake may explain it.
    pub(super) fn is_wrong(&self) -> bool {
        self.state() == State::Wrong
    }
}
