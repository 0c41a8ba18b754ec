//! Runs the program for all planned checks, with several processes at a time. The results do not
//! depend on the order of the processes.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use cases::probe::Question;
use cases::stage::{Case, Check};

use super::answers::{Answers, Done};
use super::pictures;
use super::plan::{Part, Plan};
use super::progress::Progress;
use super::thrift::{self, Share, Taken};
use super::verdicts::{self, Skipped};
use crate::exercise::{self, Candidate, Start, reduced};
use crate::judge::Judgement;
use crate::record::{Finding, FindingKind};
use crate::sandbox::{Finished, Limits, Outcome};
use crate::workers::{guarded, side_by_side};

/// A unit of work: a picture, or the unit checks of a stage.
#[derive(Clone, Copy)]
enum Task<'a> {
    /// The unit checks of a stage, and its place in the plan.
    Units(&'a Part<'a>, usize),
    /// A picture, and the place of its stage in the plan.
    Picture(&'a Part<'a>, &'a Case, usize),
}

/// The result of a task.
#[derive(Default)]
struct Ran {
    /// Results by id. A check that was left out because the program is broken is missing.
    done: BTreeMap<String, Done>,
    remarks: Vec<String>,
    taken: Taken,
    /// The end of the process, for a picture.
    picture: Option<Finished>,
}

/// Runs the program for all planned checks, `jobs` processes at a time.
pub(super) fn exercise(
    plan: &Plan,
    candidate: &Candidate,
    jobs: usize,
    progress: &dyn Progress,
) -> Answers {
    let tasks = tasks(plan);
    progress.phase("running the program");
    progress.begin(tasks.len() as u64);
    let taken = Mutex::new(vec![None; tasks.len()]);
    let session = Session { candidate, progress, taken, tasks, n_stages: plan.stages.len() };
    let n_units = session.tasks.iter().filter(|task| task.is_units()).count();
    let (units, pictures) = (0..n_units, n_units..session.tasks.len());
    let begun = side_by_side(jobs, &[units, pictures], |kind| session.begin(kind.clone()));
    let mut begun = begun.into_iter().map(Result::unwrap_or_default);
    let ((mut ran, units), (pictures_ran, pictures)) =
        (begun.next().unwrap_or_default(), begun.next().unwrap_or_default());
    ran.extend(pictures_ran);
    let rest: Vec<usize> = (0..session.tasks.len()).filter(|n| !ran.contains_key(n)).collect();
    let run = |n: &usize| {
        session.run(*n, &mut if *n < n_units { units.clone() } else { pictures.clone() })
    };
    let finished = side_by_side(jobs, &rest, run);
    ran.extend(rest.iter().copied().zip(finished.into_iter().map(Result::unwrap_or_default)));
    session.settle(ran, &units, &pictures)
}

/// Returns all tasks in the order of the plan, unit checks first.
fn tasks<'a>(plan: &'a Plan) -> Vec<Task<'a>> {
    let stages = || plan.stages.iter().enumerate();
    let units = stages()
        .filter(|(_, part)| !part.checks.is_empty())
        .map(|(stage, part)| Task::Units(part, stage));
    let pictures = stages().flat_map(|(stage, part)| {
        part.cases.iter().map(move |case| Task::Picture(part, case, stage))
    });
    units.chain(pictures).collect()
}

impl Task<'_> {
    /// Returns the ids of the task's checks.
    fn ids(&self) -> Vec<&str> {
        match self {
            Self::Units(part, _) => {
                part.checks.iter().map(|(check, _)| check.id.as_str()).collect()
            }
            Self::Picture(_, case, _) => vec![&case.id],
        }
    }

    /// Returns the place of the stage in the plan.
    fn stage(&self) -> usize {
        let (Self::Units(_, stage) | Self::Picture(_, _, stage)) = self;
        *stage
    }

    fn is_units(&self) -> bool {
        matches!(self, Self::Units(..))
    }
}

/// One submission while it is run.
struct Session<'a> {
    tasks: Vec<Task<'a>>,
    candidate: &'a Candidate<'a>,
    progress: &'a dyn Progress,
    /// The time that each task took, once it has ended.
    taken: Mutex<Vec<Option<Taken>>>,
    /// Number of stages in the plan.
    n_stages: usize,
}

impl Session<'_> {
    /// Runs tasks of a kind one after another, until it is known whether the program is broken.
    fn begin(&self, kind: std::ops::Range<usize>) -> (BTreeMap<usize, Ran>, Start) {
        let mut start = Start::default();
        let mut ran = BTreeMap::new();
        for place in exercise::order(kind.len()) {
            if start.is_known() {
                break;
            }
            let n = kind.start + place;
            ran.insert(n, self.run(n, &mut start));
        }
        (ran, start)
    }

    /// Runs a task, unless it is to be left out.
    fn run(&self, n: usize, start: &mut Start) -> Ran {
        let task = &self.tasks[n];
        let share = {
            let taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
            self.share(taken[..n].iter().flatten(), task)
        };
        let is_left_out = share.is_nothing() || start.broken().is_some();
        let ran = if is_left_out {
            Ok(Ran::default())
        } else {
            guarded(|| self.perform(task, share, start))
        };
        let ran = ran.unwrap_or_else(|panicked| {
            let ours = || Done::unmeasured(Judgement::ours(panicked.to_string()), None);
            Ran {
                done: task.ids().into_iter().map(|id| (id.to_owned(), ours())).collect(),
                ..Ran::default()
            }
        });
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)[n] = Some(ran.taken);
        self.progress.step();
        ran
    }

    fn perform(&self, task: &Task, share: Share, start: &mut Start) -> Ran {
        match *task {
            Task::Units(part, stage) => units(self.candidate, (part, stage), start),
            Task::Picture(part, case, stage) => {
                let limits = self.candidate.allowance.picture;
                let limits = if share == Share::Reduced { reduced(limits) } else { limits };
                picture(self.candidate, (part, case, stage), limits, start)
            }
        }
    }

    /// Returns the share of the time limit for `task` after the runs `before` it.
    fn share<'t>(&self, before: impl Iterator<Item = &'t Taken>, task: &Task) -> Share {
        thrift::share(before, (task.stage(), self.n_stages), &self.candidate.allowance)
    }

    /// Combines the results as if all tasks had been run one after another.
    fn settle(&self, mut ran: BTreeMap<usize, Ran>, units: &Start, pictures: &Start) -> Answers {
        let mut answers = Answers::default();
        let mut before: Vec<Taken> = vec![];
        let mut left_out = LeftOut::default();
        for (n, task) in self.tasks.iter().enumerate() {
            let mut one = ran.remove(&n).unwrap_or_default();
            let allowance = &self.candidate.allowance;
            let left_out_because = match self.share(before.iter(), task) {
                Share::Whole => None,
                Share::Reduced => {
                    one.reduce_to(&reduced(allowance.picture));
                    None
                }
                Share::Idle => Some(verdicts::idle_for_too_long(allowance.most_idle())),
                Share::OutOfTime => Some(verdicts::out_of_time(allowance.whole)),
            };
            if let Some(why) = left_out_because {
                one = Ran::left_out(task, &why);
            }
            let missing = task.ids().into_iter().filter(|id| !one.done.contains_key(*id));
            left_out.of(task).extend(missing.map(str::to_owned));
            before.push(one.taken);
            answers.done.extend(one.done);
            if let Task::Units(part, _) = task {
                answers.remarks.insert(part.questions.stage.id.clone(), one.remarks);
            }
        }
        let allowance = &self.candidate.allowance;
        for (ids, start, limits, what) in [
            (left_out.questions, units, &allowance.questions, Skipped::Questions),
            (left_out.pictures, pictures, &allowance.picture, Skipped::Pictures),
        ] {
            let n = ids.len();
            let judgement = || match start.broken() {
                Some((failure, n_same)) => verdicts::skipped(failure, n_same, limits, (what, n)),
                None => Judgement::ours("it was planned, but not run"),
            };
            answers
                .done
                .extend(ids.into_iter().map(|id| (id, Done::unmeasured(judgement(), None))));
        }
        answers
    }
}

/// Ids of checks that were left out because the program is broken.
#[derive(Default)]
struct LeftOut {
    questions: Vec<String>,
    pictures: Vec<String>,
}

impl LeftOut {
    fn of(&mut self, task: &Task) -> &mut Vec<String> {
        if task.is_units() { &mut self.questions } else { &mut self.pictures }
    }
}

impl Ran {
    /// Returns the result of a task that is left out, which takes no time.
    fn left_out(task: &Task, why: &Judgement) -> Self {
        let done = |id: &str| (id.to_owned(), Done::unmeasured(why.clone(), None));
        let taken = Taken { stage: task.stage(), ..Taken::default() };
        Self { done: task.ids().into_iter().map(done).collect(), taken, ..Self::default() }
    }

    /// Changes the result of a picture to what it would be with these limits.
    fn reduce_to(&mut self, limits: &Limits) {
        let beyond = self.picture.as_ref().and_then(|finished| verdicts::beyond(finished, limits));
        let Some(judgement) = beyond else { return };
        for done in self.done.values_mut() {
            done.judgement = judgement.clone();
            done.picture = None;
        }
        self.taken.is_timeout = true;
    }
}

/// Judges the existing pictures in `folder`.
pub(super) fn review(plan: &Plan, folder: &Path) -> Answers {
    let mut answers = Answers::default();
    for part in &plan.stages {
        for case in &part.cases {
            let size = case.scene.render;
            let read =
                exercise::read(&folder.join(format!("{}.png", case.id)), size.width, size.height);
            let judgement = match &read {
                Ok(image) => verdicts::of_picture(image, part.questions, case),
                Err(why) => verdicts::no_picture(why),
            };
            answers.done.insert(case.id.clone(), Done::unmeasured(judgement, read.ok()));
        }
    }
    answers
}

/// Returns the results if nothing can be run because of `finding`.
pub(super) fn nothing(plan: &Plan, finding: Option<&Finding>) -> Answers {
    let kind = finding.map_or(FindingKind::Internal, |finding| finding.kind);
    let why = match kind {
        FindingKind::Build => "not run: the submission does not build",
        FindingKind::Submission => "not run: what was handed in is no submission",
        _ => "not run: the grader was interrupted",
    };
    let done = || Done::unmeasured(Judgement::not_run(Finding::new(kind, why)), None);
    let ids = plan.stages.iter().flat_map(Part::ids);
    let done = ids.map(|id| (id.to_owned(), done())).collect();
    Answers { done, ..Answers::default() }
}

fn picture(
    candidate: &Candidate,
    (part, case, stage): (&Part, &Case, usize),
    limits: Limits,
    start: &mut Start,
) -> Ran {
    let first = exercise::render_case(candidate, &case.scene, limits);
    if !start.is_known() {
        first.tell(start, candidate, &case.scene);
    }
    let finished = first.finished.clone().without_streams();
    let again = || exercise::render_case(candidate, &case.scene, limits);
    let (judgement, picture) = pictures::judged(&first, (part.questions, case), again);
    let taken = Taken {
        stage,
        time: finished.time(),
        idle: finished.idle,
        is_timeout: matches!(finished.outcome, Outcome::TimedOut(_)),
    };
    let done = Done {
        judgement,
        picture,
        answer: None,
        time_s: finished.wall.as_secs_f64(),
        cpu_s: Some(finished.cpu.as_secs_f64()),
        peak_bytes: finished.peak_bytes,
    };
    let done = BTreeMap::from([(case.id.clone(), done)]);
    Ran { done, taken, picture: Some(finished), ..Ran::default() }
}

fn units(candidate: &Candidate, (part, stage): (&Part, usize), start: &mut Start) -> Ran {
    let question =
        |(check, _): &(&Check, u64)| Question { id: check.id.clone(), ask: check.ask.clone() };
    let questions: Vec<Question> = part.checks.iter().map(question).collect();
    let probed = exercise::probe(candidate, &questions, start);
    let judged = |question: &Question| {
        let judgement = guarded(|| verdicts::of_answer(question, &probed, part.questions));
        let done = Done {
            judgement: judgement.unwrap_or_else(|panicked| Judgement::ours(panicked.to_string())),
            picture: None,
            answer: verdicts::answer_to(question, &probed),
            time_s: probed.time.as_secs_f64(),
            cpu_s: Some(probed.cpu.as_secs_f64()),
            peak_bytes: probed.peak_bytes,
        };
        (question.id.clone(), done)
    };
    let asked = questions.iter().filter(|question| !probed.skipped.contains(&question.id));
    let done = asked.map(judged).collect();
    Ran {
        done,
        taken: Taken {
            stage,
            time: probed.cpu + probed.idle,
            idle: probed.idle,
            is_timeout: false,
        },
        remarks: probed.remarks,
        picture: None,
    }
}
