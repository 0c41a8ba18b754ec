//! Judgements on the results of a program, and on how it ended if it gave no result.

use cases::film::Image;
use cases::probe::{Answer, Question};
use cases::stage::Case;

use crate::exam::Questions;
use crate::exercise::{Ended, Failure, Got, LeftOut, NoPicture, Probed, Rendered};
use crate::judge::{self, Judgement};
use crate::record::{Finding, FindingKind};
use crate::sandbox::{Clock, Finished, Limits, Outcome};

/// Judges the process of a picture.
///
/// A picture counts however the program ended after writing it, unless the program had to be
/// stopped.
pub(super) fn of_shot(shot: &Rendered, questions: &Questions, case: &Case) -> Judgement {
    let (finished, limits) = (&shot.finished, &shot.limits);
    let is_over = matches!(finished.outcome, Outcome::Exited(_) | Outcome::Signalled(_));
    let judgement = match &shot.picture {
        Ok(image) if is_over => of_picture(image, questions, case),
        Err(why @ NoPicture::Machine(_)) => return no_picture(why),
        Err(why @ (NoPicture::Size(_) | NoPicture::Unreadable(_)))
            if finished.outcome == Outcome::Exited(0) =>
        {
            no_picture(why).with_stderr(finished.stderr_text())
        }
        _ => {
            return judge::todo(finished).unwrap_or_else(|| judge::ending(finished, limits));
        }
    };
    match finished.outcome {
        Outcome::Exited(0) => left_behind(judgement, finished),
        _ => {
            let end = judge::ending(finished, limits)
                .finding
                .map_or(String::new(), |finding| finding.message);
            judgement
                .remark(&format!("{end}, after writing its picture"))
                .with_stderr(finished.stderr_text())
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

/// Judges a picture of the right size.
pub(super) fn of_picture(image: &Image, questions: &Questions, case: &Case) -> Judgement {
    match questions.images.get(&case.id) {
        Some(answer) => judge::picture(image, answer),
        None => Judgement::ours("there is no stored answer"),
    }
}

/// Judges a missing picture, or one that cannot be read or has the wrong size.
pub(super) fn no_picture(why: &NoPicture) -> Judgement {
    Judgement::fail(match why {
        NoPicture::Machine(why) => return Judgement::ours(why.clone()),
        NoPicture::Missing => Finding::new(FindingKind::Missing, "there is no picture"),
        NoPicture::Size(why) => {
            Finding::new(FindingKind::Size, format!("the picture has the wrong size: {why}"))
        }
        NoPicture::Unreadable(why) => {
            Finding::new(FindingKind::Unreadable, format!("the picture cannot be read: {why}"))
        }
    })
}

/// Returns the answer to a question if one could be read, else `None`.
pub(super) fn answer_to(question: &Question, probed: &Probed) -> Option<Answer> {
    match probed.got.get(&question.id) {
        Some(Got::Answer(answer)) => Some(answer.clone()),
        _ => None,
    }
}

/// Judges the answer to a question, or how the process ended without one.
pub(super) fn of_answer(question: &Question, probed: &Probed, questions: &Questions) -> Judgement {
    let Some(right) = questions.units.get(&question.id) else {
        return Judgement::ours("there is no stored answer");
    };
    let wrong = |kind, message: String| Judgement::fail(Finding::new(kind, message));
    let function = question.ask.function();
    let mut judgement = match (probed.got.get(&question.id), probed.ended.get(&question.id)) {
        (Some(Got::Answer(answer)), _) => judge::unit(answer, right, function),
        (Some(Got::Malformed(why)), _) => {
            wrong(FindingKind::Unreadable, format!("its answer cannot be read: {why}"))
        }
        (Some(Got::Twice), _) => {
            wrong(FindingKind::Wrong, "it gave more than one answer".to_owned())
        }
        (None, Some(Ended { finished, .. })) if finished.outcome == Outcome::Exited(0) => {
            wrong(FindingKind::Missing, "it gave no answer to this question".to_owned())
        }
        (None, Some(Ended { finished, limits })) => judge::ending(finished, limits),
        (None, None) if let Some(left_out) = probed.left_out.get(&question.id) => {
            not_run(function, left_out)
        }
        (None, None) => {
            let why = probed.not_run.get(&question.id).map_or("not run", String::as_str);
            wrong(FindingKind::Timeout, why.to_owned())
        }
    };
    if let Some(finding) = &mut judgement.finding {
        finding.asked = serde_json::to_value(question).ok();
    }
    judgement
}

/// Returns the judgement on a question that was left out because `function` fails at all of them.
fn not_run(function: &str, LeftOut { ended, n_failures, n }: &LeftOut) -> Judgement {
    let mut judgement = judge::ending(&ended.finished, &ended.limits);
    if let Some(finding) = &mut judgement.finding {
        finding.message = format!(
            "not run, because the program fails at `{function}` whatever the question is: {}. \
             {n_failures} processes ended in this way, so {} left out",
            finding.message,
            were(*n, "question")
        );
    }
    judgement
}

fn were(n: usize, one: &str) -> String {
    if n == 1 { format!("1 {one} was") } else { format!("{n} {one}s were") }
}

/// Returns the judgement on one of `n` checks that were left out because the program fails whatever
/// it is given, as `n_same` processes have shown.
pub(super) fn skipped(
    failure: &Failure,
    n_same: u32,
    limits: &Limits,
    (what, n): (Skipped, usize),
) -> Judgement {
    let mut judgement = judge::ending(&failure.finished, limits);
    if let Some(finding) = &mut judgement.finding {
        let (given, one) = match what {
            Skipped::Pictures => ("with an empty scene", "picture"),
            Skipped::Questions => ("without a question", "question"),
        };
        finding.message = format!(
            "not run, because the program fails whatever it is given: {}. {n_same} processes \
             ended in this way, the last of them {given}, so {} left out",
            finding.message,
            were(n, one)
        );
    }
    judgement
}

/// The kind of check that was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Skipped {
    Pictures,
    Questions,
}

/// Returns the judgement on a check that was left out because the submission was idle for too long.
pub(super) fn idle_for_too_long(most: std::time::Duration) -> Judgement {
    let seconds = most.as_secs();
    let message =
        format!("not run, because the program was idle for {seconds} s in all before this");
    Judgement::fail(Finding::new(FindingKind::Timeout, message))
}

/// Returns the judgement on a check that was left out because the time of its stage is over, of
/// `most` for the whole submission.
pub(super) fn out_of_time(most: std::time::Duration) -> Judgement {
    let message = format!(
        "not run: out of time. A submission has {} s of CPU time and idle time for all its runs, \
         which its stages share",
        most.as_secs()
    );
    Judgement::not_run(Finding::new(FindingKind::Timeout, message))
}

/// Returns the judgement on a picture that took more time than `limits` allow, or `None` where it
/// did not.
pub(super) fn beyond(finished: &Finished, limits: &Limits) -> Option<Judgement> {
    let clock = match () {
        () if matches!(finished.outcome, Outcome::Machine(_) | Outcome::Interrupted) => {
            return None;
        }
        () if finished.cpu > limits.cpu => Clock::Cpu,
        () if finished.idle > limits.idle => Clock::Idle,
        () => return None,
    };
    Some(judge::ending(&Finished { outcome: Outcome::TimedOut(clock), ..finished.clone() }, limits))
}
