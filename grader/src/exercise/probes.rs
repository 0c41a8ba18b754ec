//! The unit checks of a stage. A program that dies or hangs at one question is started again behind it, so that the
//! question costs only itself.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use cases::probe::Question;

use super::replies::{self, Got, Replies};
use super::{Candidate, run};
use crate::sandbox::{Finished, Folder, Outcome};

/// Questions at which one function may have to be stopped, before it is not asked any more.
const MAX_HANGS: usize = 2;
/// Time by the clock for all processes of a stage, after which no more are started.
const MAX_TIME: Duration = Duration::from_secs(120);

/// What came of `probe`.
#[derive(Debug, Default)]
pub struct Probed {
    /// What came back, by id of the question.
    pub got: BTreeMap<String, Got>,
    /// Where nothing came back: how the program ended when it was asked, by id of the question.
    pub ended: BTreeMap<String, Finished>,
    /// Questions that were not asked, and why.
    pub not_asked: BTreeMap<String, String>,
    /// What is worth saying of the output as a whole.
    pub remarks: Vec<String>,
    /// Time by the clock, of all processes.
    pub time: Duration,
    /// Largest resident bytes.
    pub peak_bytes: u64,
}

/// Asks all questions.
///
/// Where the program ends early, the first question behind the last answer is to blame. Where not one answer came, it may
/// just not have sent off its answers; so the suspect is asked alone before it is blamed, unless answers have been seen to
/// come out of a process that died.
///
/// # Errors
/// A folder that cannot be made: the machine's fault.
pub fn probe(candidate: &Candidate, questions: &[Question]) -> std::io::Result<Probed> {
    let mut probed = Probed::default();
    let mut open: Vec<&Question> = questions.iter().collect();
    let mut hangs: BTreeMap<&str, usize> = BTreeMap::new();
    let mut sends_off = false;
    while !open.is_empty() {
        if probed.time >= MAX_TIME {
            let why = format!("not asked: the questions before it took more than {} s", MAX_TIME.as_secs());
            probed.not_asked.extend(open.drain(..).map(|question| (question.id.clone(), why.clone())));
            break;
        }
        let (finished, behind) = ask(candidate, &open, &mut probed)?;
        let answers_nothing = behind == 0 && probed.got.is_empty();
        let is_through = finished.outcome == Outcome::Exited(0) && (answers_nothing || behind == open.len());
        sends_off |= behind > 0 && finished.outcome != Outcome::Exited(0);
        let suspect = open.get(behind).or(open.first()).copied();
        let is_sure = behind > 0 || open.len() == 1 || sends_off;
        open.retain(|question| !probed.got.contains_key(&question.id));
        if is_through || cannot_go_on(&finished) {
            probed.ended.extend(open.drain(..).map(|question| (question.id.clone(), finished.clone())));
            break;
        }
        let Some(suspect) = suspect.filter(|suspect| open.iter().any(|question| question.id == suspect.id)) else {
            continue;
        };
        let ended = if is_sure { finished } else { ask(candidate, &[suspect], &mut probed)?.0 };
        open.retain(|question| question.id != suspect.id);
        if probed.got.contains_key(&suspect.id) {
            continue;
        }
        if !matches!(ended.outcome, Outcome::Exited(_) | Outcome::Signalled(_)) {
            *hangs.entry(suspect.ask.function()).or_default() += 1;
        }
        probed.ended.insert(suspect.id.clone(), ended);
        give_up(&mut open, &hangs, &mut probed);
    }
    Ok(probed)
}

/// Asks the questions in one process and takes in what it says; how it ended, and the place behind the last one answered.
fn ask(candidate: &Candidate, open: &[&Question], probed: &mut Probed) -> std::io::Result<(Finished, usize)> {
    let folder = Folder::new()?;
    let mut stdin = vec![];
    for question in open {
        serde_json::to_writer(&mut stdin, question)?;
        stdin.push(b'\n');
    }
    let finished = run(candidate.program, &["probe".into()], folder.path(), stdin, candidate.allowance.questions);
    let asked: BTreeSet<&str> = open.iter().map(|question| question.id.as_str()).collect();
    let replies = replies::parse(&finished.stdout, &asked);
    probed.time += finished.wall;
    probed.peak_bytes = probed.peak_bytes.max(finished.peak_bytes);
    remark(&replies, probed);
    let behind = open.iter().rposition(|question| replies.got.contains_key(&question.id)).map_or(0, |last| last + 1);
    probed.got.extend(replies.got);
    Ok((finished.without_streams(), behind))
}

fn remark(replies: &Replies, probed: &mut Probed) {
    if let Some(line) = &replies.stray {
        let n = replies.n_stray;
        probed.remarks.push(format!("{n} lines on standard output are no answers (print to standard error): {line}"));
    }
    if replies.n_unknown > 0 {
        probed.remarks.push(format!("{} answers are to questions that were not asked", replies.n_unknown));
    }
}

fn cannot_go_on(finished: &Finished) -> bool {
    matches!(finished.outcome, Outcome::CouldNotStart(_) | Outcome::NoProgram(_) | Outcome::Interrupted)
}

/// Asks no more of a function that has to be stopped again and again.
fn give_up(open: &mut Vec<&Question>, hangs: &BTreeMap<&str, usize>, probed: &mut Probed) {
    open.retain(|question| {
        let function = question.ask.function();
        let n = hangs.get(function).copied().unwrap_or(0);
        if n >= MAX_HANGS {
            let why = format!("not asked: `{function}` had to be stopped on {n} questions before it");
            probed.not_asked.insert(question.id.clone(), why);
        }
        n < MAX_HANGS
    });
}
