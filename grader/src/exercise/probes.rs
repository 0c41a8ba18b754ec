//! Runs the unit checks of a stage. A program that dies or hangs at a question is restarted with
//! the next one, so that only that question is lost.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use cases::probe::Question;

use super::attempt::{Attempt, NEEDED, Task, attempt};
use super::failure::{Failure, spread};
use super::functions::Functions;
use super::replies::{self, Got, Replies};
use super::{Allowance, Candidate, N_TIMEOUTS, Start, reduced};
use crate::sandbox::{Finished, Limits, Outcome};

/// Number of questions at which a function may have to be stopped before it gets no more.
const MAX_HANGS: usize = 2;
/// CPU time plus idle time of all processes of a stage after which no more are started.
const MAX_TIME: Duration = Duration::from_secs(100);

/// The results of the unit checks of a stage.
#[derive(Debug, Default)]
pub struct Probed {
    /// The replies, by id of the question.
    pub got: BTreeMap<String, Got>,
    /// The end of the process for a question without a reply, by id of the question.
    pub ended: BTreeMap<String, Ended>,
    /// Questions that were not sent to the program, with the reason, by id.
    pub not_run: BTreeMap<String, String>,
    /// Ids of the questions that were left out because the program fails whatever its input is.
    pub skipped: BTreeSet<String>,
    /// Questions that were left out because the function fails whatever the question is, by id.
    pub left_out: BTreeMap<String, LeftOut>,
    /// Remarks on the output as a whole.
    pub remarks: Vec<String>,
    /// Wall time of all processes.
    pub time: Duration,
    /// CPU time of all processes.
    pub cpu: Duration,
    /// Idle time of all processes.
    pub idle: Duration,
    /// Largest resident size of a process, in bytes.
    pub peak_bytes: u64,
}

/// The end of a process at a question.
#[derive(Clone, Debug)]
pub struct Ended {
    /// The end of the process.
    pub finished: Finished,
    /// The limits under which it ran.
    pub limits: Limits,
}

/// The evidence that a function fails at all questions of a stage.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The end of the last process.
    pub ended: Ended,
    /// Number of questions at which a process ended in this way.
    pub n_failures: u32,
    /// Number of questions that were left out.
    pub n: usize,
}

/// Sends all questions to the program. `start` holds what is known about the program so far.
///
/// If the program ends early, the first question after the last answer is to blame. If there is no
/// answer at all, the program may still have buffered its answers. The suspect is then sent alone
/// before it is blamed, unless an earlier process that died has already delivered answers.
pub fn probe(candidate: &Candidate, questions: &[Question], start: &mut Start) -> Probed {
    let mut probed = Probed::default();
    let mut open: Vec<&Question> = questions.iter().collect();
    let mut hangs: BTreeMap<&str, usize> = BTreeMap::new();
    let mut functions = Functions::default();
    let mut limits = candidate.allowance.questions;
    let mut n_timeouts = 0;
    let mut sends_off = false;
    while !open.is_empty() {
        if start.broken().is_some() {
            probed.skipped.extend(open.drain(..).map(|question| question.id.clone()));
            break;
        }
        if let Some(why) = spent(&probed, &candidate.allowance) {
            probed
                .not_run
                .extend(open.drain(..).map(|question| (question.id.clone(), why.clone())));
            break;
        }
        let batch = batch(&open, start, &functions);
        let Sent { finished, behind, failure } = ask(candidate, &batch, limits, &mut probed, start);
        let answers_nothing = behind == 0 && probed.got.is_empty();
        let is_through =
            finished.outcome == Outcome::Exited(0) && (answers_nothing || behind == batch.len());
        sends_off |= behind > 0 && finished.outcome != Outcome::Exited(0);
        let suspect = batch.get(behind).or(batch.first()).copied();
        let is_sure = behind > 0 || batch.len() == 1 || sends_off;
        take_answers(&mut open, &probed, &mut functions);
        if is_through || cannot_go_on(&finished) {
            let is_over = cannot_go_on(&finished);
            let ended = Ended { finished, limits };
            let is_done =
                |question: &&Question| is_over || batch.iter().any(|one| one.id == question.id);
            for question in open.extract_if(.., |question| is_done(question)) {
                functions.end(question.ask.function(), None);
                probed.ended.insert(question.id.clone(), ended.clone());
            }
            continue;
        }
        let Some(suspect) =
            suspect.filter(|suspect| open.iter().any(|question| question.id == suspect.id))
        else {
            continue;
        };
        let Sent { finished, failure, .. } = match is_sure {
            true => Sent { finished, behind, failure },
            false => ask(candidate, &[suspect], limits, &mut probed, start),
        };
        take_answers(&mut open, &probed, &mut functions);
        if probed.got.contains_key(&suspect.id) {
            continue;
        }
        open.retain(|question| question.id != suspect.id);
        let function = suspect.ask.function();
        functions.end(function, failure);
        if !matches!(finished.outcome, Outcome::Exited(_) | Outcome::Signalled(_)) {
            *hangs.entry(function).or_default() += 1;
        }
        n_timeouts += usize::from(matches!(finished.outcome, Outcome::TimedOut(_)));
        let ended = Ended { finished, limits };
        if let Some(n_failures) = functions.n_failures(function) {
            leave_out(&mut open, function, &ended, n_failures, &mut probed);
        }
        probed.ended.insert(suspect.id.clone(), ended);
        if n_timeouts >= N_TIMEOUTS {
            limits = reduced(candidate.allowance.questions);
        }
        give_up(&mut open, &hangs, &mut probed);
    }
    probed
}

/// Returns why no more processes are started if the earlier ones took too long, else `None`.
///
/// The time of other stages does not count, so that the order of the stages does not matter.
fn spent(probed: &Probed, allowance: &Allowance) -> Option<String> {
    let most_idle = allowance.most_idle();
    if probed.cpu + probed.idle >= MAX_TIME {
        return Some(format!(
            "not run: the questions before it took more than {} s",
            MAX_TIME.as_secs()
        ));
    }
    let seconds = most_idle.as_secs();
    (probed.idle >= most_idle).then(|| {
        format!("not run: the program was idle for {seconds} s at the questions before it")
    })
}

/// Returns the questions for the next process: all that are open, or a single one.
///
/// The single one helps to decide whether the program, or one of its functions, fails whatever its
/// input is.
fn batch<'a>(open: &[&'a Question], start: &Start, functions: &Functions) -> Vec<&'a Question> {
    let next_single = match start.n_failures() {
        0 | 1 => functions.next_single(open),
        n => spread(n, open.len()).map(|place| open[place]),
    };
    next_single.map_or_else(|| open.to_vec(), |question| vec![question])
}

/// The result of sending questions to one process.
struct Sent {
    finished: Finished,
    /// Index after the last question that was answered; 0 if there is none.
    behind: usize,
    /// The failure of the program, or `None` if it did not fail by its own fault.
    failure: Option<Failure>,
}

/// Sends the questions to one process, and adds its answers to `probed`.
fn ask(
    candidate: &Candidate,
    open: &[&Question],
    limits: Limits,
    probed: &mut Probed,
    start: &mut Start,
) -> Sent {
    let Attempt { output: replies, finished, failure } = run(candidate, open, limits);
    start.see(failure.as_ref().filter(|_| replies.got.is_empty()), || {
        run(candidate, &[], limits).failure
    });
    probed.time += finished.wall;
    probed.cpu += finished.cpu;
    probed.idle += finished.idle;
    probed.peak_bytes = probed.peak_bytes.max(finished.peak_bytes);
    remark(&replies, probed);
    let behind = open
        .iter()
        .rposition(|question| replies.got.contains_key(&question.id))
        .map_or(0, |last| last + 1);
    probed.got.extend(replies.got);
    Sent { finished: finished.without_streams(), behind, failure }
}

/// Removes the questions that have been answered, and records that for their functions.
fn take_answers<'a>(open: &mut Vec<&'a Question>, probed: &Probed, functions: &mut Functions<'a>) {
    for question in open.extract_if(.., |question| probed.got.contains_key(&question.id)) {
        functions.answer(question.ask.function());
    }
}

/// Runs one process with the questions on its standard input.
fn run(candidate: &Candidate, questions: &[&Question], limits: Limits) -> Attempt<Replies> {
    let lines = questions.iter().map(|question| {
        serde_json::to_string(question).expect("a question has string keys and no failing part")
            + "\n"
    });
    let stdin: String = lines.collect();
    let ids: BTreeSet<&str> = questions.iter().map(|question| question.id.as_str()).collect();
    let task = Task {
        limits,
        needed: NEEDED,
        stdin: stdin.as_bytes(),
        prepare: &|_| Ok(vec!["probe".into()]),
    };
    attempt(candidate, &task, &|_, finished| {
        let replies = replies::parse(&finished.stdout, &ids);
        let is_good = finished.outcome == Outcome::Exited(0) && replies.got.len() == ids.len();
        (replies, is_good)
    })
}

fn remark(replies: &Replies, probed: &mut Probed) {
    if let Some(line) = &replies.stray {
        let n = replies.n_stray;
        probed.remarks.push(format!(
            "{n} lines on standard output are no answers (print to standard error): {line}"
        ));
    }
    if replies.n_unknown > 0 {
        probed.remarks.push(format!("{} answers belong to no question", replies.n_unknown));
    }
}

fn cannot_go_on(finished: &Finished) -> bool {
    matches!(finished.outcome, Outcome::Machine(_) | Outcome::NoProgram(_) | Outcome::Interrupted)
}

/// Removes the questions to `function`, which fails at all of them.
fn leave_out(
    open: &mut Vec<&Question>,
    function: &str,
    ended: &Ended,
    n_failures: u32,
    probed: &mut Probed,
) {
    let ids: Vec<String> = open
        .extract_if(.., |question| question.ask.function() == function)
        .map(|it| it.id.clone())
        .collect();
    let left_out = LeftOut { ended: ended.clone(), n_failures, n: ids.len() };
    probed.left_out.extend(ids.into_iter().map(|id| (id, left_out.clone())));
}

/// Removes the questions to functions that had to be stopped [`MAX_HANGS`] times.
fn give_up(open: &mut Vec<&Question>, hangs: &BTreeMap<&str, usize>, probed: &mut Probed) {
    open.retain(|question| {
        let function = question.ask.function();
        let n = hangs.get(function).copied().unwrap_or(0);
        if n >= MAX_HANGS {
            let why = format!("not run: `{function}` had to be stopped on {n} questions before it");
            probed.not_run.insert(question.id.clone(), why);
        }
        n < MAX_HANGS
    });
}
