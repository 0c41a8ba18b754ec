//! The command `reference probe`: the protocol of the unit checks, so that the reference can be
//! graded like a submission.

use std::io::BufRead;

use cases::probe::{Question, Reply};

use super::args::ProbeArgs;
use super::find;
use super::output::print;
use super::stop::Stop;
use crate::rules::Rules;
use crate::trace::answers::answer;

/// Answers each line of standard input with a line, in order.
pub(super) fn run(args: &ProbeArgs) -> Result<(), Stop> {
    let rules = Rules::of(&find::given(&args.course)?.unwrap_or_default());
    for line in std::io::stdin().lock().lines() {
        let line = line.map_err(|why| Stop::Usage(format!("cannot read a question: {why}")))?;
        if line.trim().is_empty() {
            continue;
        }
        let question: Question = serde_json::from_str(&line)
            .map_err(|why| Stop::Usage(format!("cannot understand the question {line}: {why}")))?;
        let reply = Reply { answer: answer(&rules, &question.ask), id: question.id };
        let text =
            serde_json::to_string(&reply).map_err(Stop::machine("cannot write an answer"))?;
        print(format!("{text}\n").as_bytes())?;
    }
    Ok(())
}
