//! The unit checks of a stage. A program that dies or hangs at one question is started again behind
//! it, so that the question costs only itself.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use cases::probe::Question;

use super::attempt::{Attempt, NEEDED, Task, attempt};
use super::failure::{Failure, spread};
use super::functions::Functions;
use super::replies::{self, Got, Replies};
use super::{Allowance, Candidate, N_TIMEOUTS, Start, reduced};
use crate::sandbox::{Finished, Limits, Outcome};

/// Questions at which one function may have to be stopped, before no more are put to it.
const MAX_HANGS: usize = 2;
/// CPU time and idle time of all processes of a stage, after which no more are started.
const MAX_TIME: Duration = Duration::from_secs(120);

/// The results of the calls to probe.
#[derive(Debug, Default)]
pub struct Probed {
    /// The replies, by id of the question.
    pub got: BTreeMap<String, Got>,
    /// The end of the process for a question without a reply, by id of the question.
    pub ended: BTreeMap<String, Ended>,
    /// Questions that were not put to the program, and why.
    pub not_asked: BTreeMap<String, String>,
    /// Questions that were left out because the program fails whatever it is given.
    pub skipped: BTreeSet<String>,
    /// Questions that were left out because the function fails whatever the question is, by id.
    pub left_out: BTreeMap<String, LeftOut>,
    /// What is worth saying of the output as a whole.
    pub remarks: Vec<String>,
    /// Wall time of all processes.
    pub time: Duration,
    /// CPU time of all processes.
    pub cpu: Duration,
    /// Idle time of all processes.
    pub idle: Duration,
    /// Largest resident bytes.
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

/// Puts all questions to the program. `start` holds what is known of the program so far.
///
/// Where the program ends early, the first question behind the last answer is to blame. Where not
/// one answer came, it may just not have sent off its answers; so the suspect is put to it alone
/// before it is blamed, unless answers have been seen to come out of a process that died.
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
                .not_asked
                .extend(open.drain(..).map(|question| (question.id.clone(), why.clone())));
            break;
        }
        let batch = batch(&open, start, &functions);
        let Asked { finished, behind, failure } =
            ask(candidate, &batch, limits, &mut probed, start);
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
        let Asked { finished, failure, .. } = match is_sure {
            true => Asked { finished, behind, failure },
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

/// Returns why no process is started any more, where those before took too long.
///
/// What other stages take does not count, so that the order of the stages decides nothing.
fn spent(probed: &Probed, allowance: &Allowance) -> Option<String> {
    let most_idle = allowance.most_idle();
    if probed.cpu + probed.idle >= MAX_TIME {
        return Some(format!(
            "not asked: the questions before it took more than {} s",
            MAX_TIME.as_secs()
        ));
    }
    let seconds = most_idle.as_secs();
    (probed.idle >= most_idle).then(|| {
        format!("not asked: the program was idle for {seconds} s at the questions before it")
    })
}

/// Returns the questions for the next process: all that are open, or a single one where it is still
/// to be found out whether the program, or one of its functions, fails whatever it is given.
fn batch<'a>(open: &[&'a Question], start: &Start, functions: &Functions) -> Vec<&'a Question> {
    let telling = match start.n_failures() {
        0 | 1 => functions.telling(open),
        n => spread(n, open.len()).map(|place| open[place]),
    };
    telling.map_or_else(|| open.to_vec(), |question| vec![question])
}

/// The result of putting questions to one process.
struct Asked {
    finished: Finished,
    /// Place behind the last question that was answered.
    behind: usize,
    /// The failure of the program, or `None` where its end says nothing against it.
    failure: Option<Failure>,
}

/// Puts the questions to one process, and takes in its answers.
fn ask(
    candidate: &Candidate,
    open: &[&Question],
    limits: Limits,
    probed: &mut Probed,
    start: &mut Start,
) -> Asked {
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
    Asked { finished: finished.without_streams(), behind, failure }
}

/// Removes the questions that have been answered.
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
    let asked: BTreeSet<&str> = questions.iter().map(|question| question.id.as_str()).collect();
    let task = Task {
        limits,
        needed: NEEDED,
        stdin: stdin.as_bytes(),
        prepare: &|_| Ok(vec!["probe".into()]),
    };
    attempt(candidate, &task, &|_, finished| {
        let replies = replies::parse(&finished.stdout, &asked);
        let is_good = finished.outcome == Outcome::Exited(0) && replies.got.len() == asked.len();
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
        probed
            .remarks
            .push(format!("{} answers are to questions that were not asked", replies.n_unknown));
    }
}

fn cannot_go_on(finished: &Finished) -> bool {
    matches!(finished.outcome, Outcome::Machine(_) | Outcome::NoProgram(_) | Outcome::Interrupted)
}

/// Puts no more questions to `function`, which fails at all of them.
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

/// Puts no more questions to a function that had to be stopped again and again.
fn give_up(open: &mut Vec<&Question>, hangs: &BTreeMap<&str, usize>, probed: &mut Probed) {
    open.retain(|question| {
        let function = question.ask.function();
        let n = hangs.get(function).copied().unwrap_or(0);
        if n >= MAX_HANGS {
            let why =
                format!("not asked: `{function}` had to be stopped on {n} questions before it");
            probed.not_asked.insert(question.id.clone(), why);
        }
        n < MAX_HANGS
    });
}
