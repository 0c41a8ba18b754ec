//! Asks what is planned and judges what comes back, many programs at once, in an order that does not depend on them.

use std::collections::BTreeMap;
use std::path::Path;

use cases::film::Image;
use cases::probe::{Answer, Question};
use cases::stage::{Case, Check};
use rayon::prelude::*;

use super::Progress;
use super::plan::{Part, Plan};
use crate::exam::Questions;
use crate::exercise::{self, Candidate, Got, NoPicture, Probed, Shot};
use crate::judge::{self, Judgement};
use crate::record::{Finding, FindingKind};
use crate::sandbox::{Finished, Limits, Outcome};

/// What came of a check.
pub(super) struct Done {
    /// What it comes to.
    pub(super) judgement: Judgement,
    /// The picture, if one of the right size could be read.
    pub(super) picture: Option<Image>,
    /// The answer to a unit check, if one could be read.
    pub(super) answer: Option<Answer>,
    pub(super) time_s: f64,
    pub(super) peak_bytes: u64,
}

/// What came of a plan.
#[derive(Default)]
pub(super) struct Answers {
    /// By id of the check.
    pub(super) done: BTreeMap<String, Done>,
    /// By id of the stage.
    pub(super) remarks: BTreeMap<String, Vec<String>>,
}

impl Done {
    fn unmeasured(judgement: Judgement, picture: Option<Image>) -> Self {
        Self { judgement, picture, answer: None, time_s: 0.0, peak_bytes: 0 }
    }
}

/// One program to run.
enum Task<'a> {
    Picture(&'a Questions, &'a Case),
    Units(&'a Part<'a>),
}

/// Runs the program for all that is planned, `jobs` at a time.
pub(super) fn exercise(plan: &Plan, candidate: &Candidate, jobs: usize, progress: &dyn Progress) -> Answers {
    let mut tasks: Vec<Task> = plan.stages.iter().filter(|part| !part.checks.is_empty()).map(Task::Units).collect();
    for part in &plan.stages {
        tasks.extend(part.cases.iter().map(|case| Task::Picture(part.questions, case)));
    }
    progress.phase("running the program");
    progress.begin(tasks.len() as u64);
    let perform = |task: &Task| {
        let answers = match task {
            Task::Picture(questions, case) => picture(candidate, questions, case),
            Task::Units(part) => units(candidate, part),
        };
        progress.step();
        answers
    };
    let all: Vec<Answers> = match rayon::ThreadPoolBuilder::new().num_threads(jobs.max(1)).build() {
        Ok(pool) => pool.install(|| tasks.par_iter().with_max_len(1).map(perform).collect()),
        Err(_) => tasks.iter().map(perform).collect(),
    };
    let mut answers = Answers::default();
    for one in all {
        answers.done.extend(one.done);
        answers.remarks.extend(one.remarks);
    }
    answers
}

/// Judges pictures that lie in `folder`.
pub(super) fn review(plan: &Plan, folder: &Path) -> Answers {
    let mut answers = Answers::default();
    for part in &plan.stages {
        for case in &part.cases {
            let size = case.scene.render;
            let read = exercise::read(&folder.join(format!("{}.png", case.id)), size.width, size.height);
            let judgement = match &read {
                Ok(image) => judge_picture(image, part.questions, case),
                Err(why) => Judgement::fail(no_picture(why)),
            };
            answers.done.insert(case.id.clone(), Done::unmeasured(judgement, read.ok()));
        }
    }
    answers
}

/// Nothing can be asked, because of `finding`.
pub(super) fn nothing(plan: &Plan, finding: Option<&Finding>) -> Answers {
    let kind = finding.map_or(FindingKind::Internal, |finding| finding.kind);
    let why = match kind {
        FindingKind::Build => "not run: the submission does not build",
        FindingKind::Submission => "not run: what was handed in is no submission",
        _ => "not run: the grader was interrupted",
    };
    let done = || Done::unmeasured(Judgement::not_run(Finding::new(kind, why)), None);
    let ids = plan.stages.iter().flat_map(Part::ids);
    Answers { done: ids.map(|id| (id.to_owned(), done())).collect(), remarks: BTreeMap::new() }
}

fn picture(candidate: &Candidate, questions: &Questions, case: &Case) -> Answers {
    let done = match exercise::shoot(candidate, &case.scene) {
        Err(why) => Done::unmeasured(Judgement::ours(format!("the work folder: {why}")), None),
        Ok(shot) => Done {
            judgement: judge_shot(&shot, &candidate.allowance.picture, questions, case),
            time_s: shot.finished.wall.as_secs_f64(),
            peak_bytes: shot.finished.peak_bytes,
            picture: shot.picture.ok(),
            answer: None,
        },
    };
    Answers { done: BTreeMap::from([(case.id.clone(), done)]), remarks: BTreeMap::new() }
}

/// A picture counts however the program ended after writing it, unless it had to be stopped.
fn judge_shot(shot: &Shot, limits: &Limits, questions: &Questions, case: &Case) -> Judgement {
    let finished = &shot.finished;
    let is_over = matches!(finished.outcome, Outcome::Exited(_) | Outcome::Signalled(_));
    let judgement = match &shot.picture {
        Ok(image) if is_over => judge_picture(image, questions, case),
        Err(why @ (NoPicture::Size(_) | NoPicture::Unreadable(_))) if finished.outcome == Outcome::Exited(0) => {
            Judgement::fail(no_picture(why)).with_stderr(finished.stderr_text())
        }
        _ => {
            return judge::todo(finished).unwrap_or_else(|| judge::ending(finished, limits));
        }
    };
    match finished.outcome {
        Outcome::Exited(0) => left_behind(judgement, finished),
        _ => {
            let end = judge::ending(finished, limits).finding.map_or(String::new(), |finding| finding.message);
            judgement.remark(&format!("{end}, after writing its picture")).with_stderr(finished.stderr_text())
        }
    }
}

fn left_behind(judgement: Judgement, finished: &Finished) -> Judgement {
    match finished.left_behind {
        0 => judgement,
        1 => judgement.remark("it left a process running, which was ended"),
        n => judgement.remark(&format!("it left {n} processes running, which were ended")),
    }
}

fn judge_picture(image: &Image, questions: &Questions, case: &Case) -> Judgement {
    match questions.images.get(&case.id) {
        Some(answer) => judge::picture(image, answer),
        None => Judgement::ours("there is no stored answer"),
    }
}

fn no_picture(why: &NoPicture) -> Finding {
    match why {
        NoPicture::Missing => Finding::new(FindingKind::Missing, "there is no picture"),
        NoPicture::Size(why) => Finding::new(FindingKind::Size, format!("the picture has the wrong size: {why}")),
        NoPicture::Unreadable(why) => {
            Finding::new(FindingKind::Unreadable, format!("the picture cannot be read: {why}"))
        }
    }
}

fn units(candidate: &Candidate, part: &Part) -> Answers {
    let question = |(check, _): &(&Check, u64)| Question { id: check.id.clone(), ask: check.ask.clone() };
    let questions: Vec<Question> = part.checks.iter().map(question).collect();
    let mut answers = Answers::default();
    let probed = exercise::probe(candidate, &questions);
    for question in &questions {
        let done = match &probed {
            Err(why) => Done::unmeasured(Judgement::ours(format!("the work folder: {why}")), None),
            Ok(probed) => Done {
                judgement: judge_answer(question, probed, &candidate.allowance.questions, part.questions),
                picture: None,
                answer: answer_to(question, probed),
                time_s: probed.time.as_secs_f64(),
                peak_bytes: probed.peak_bytes,
            },
        };
        answers.done.insert(question.id.clone(), done);
    }
    let remarks = probed.map(|probed| probed.remarks).unwrap_or_default();
    answers.remarks.insert(part.questions.stage.id.clone(), remarks);
    answers
}

fn answer_to(question: &Question, probed: &Probed) -> Option<Answer> {
    match probed.got.get(&question.id) {
        Some(Got::Answer(answer)) => Some(answer.clone()),
        _ => None,
    }
}

fn judge_answer(question: &Question, probed: &Probed, limits: &Limits, questions: &Questions) -> Judgement {
    let Some(right) = questions.units.get(&question.id) else {
        return Judgement::ours("there is no stored answer");
    };
    let wrong = |kind, message: String| Judgement::fail(Finding::new(kind, message));
    let mut judgement = match (probed.got.get(&question.id), probed.ended.get(&question.id)) {
        (Some(Got::Answer(answer)), _) => judge::unit(answer, right, question.ask.function()),
        (Some(Got::Malformed(why)), _) => wrong(FindingKind::Unreadable, format!("its answer cannot be read: {why}")),
        (Some(Got::Twice), _) => wrong(FindingKind::Wrong, "it gave more than one answer".to_owned()),
        (None, Some(finished)) if finished.outcome == Outcome::Exited(0) => {
            wrong(FindingKind::Missing, "it gave no answer to this question".to_owned())
        }
        (None, Some(finished)) => judge::ending(finished, limits),
        (None, None) => {
            let why = probed.not_asked.get(&question.id).map_or("not asked", String::as_str);
            wrong(FindingKind::Timeout, why.to_owned())
        }
    };
    if let Some(finding) = &mut judgement.finding {
        finding.asked = serde_json::to_value(question).ok();
    }
    judgement
}
