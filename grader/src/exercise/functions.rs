//! Finds the functions at which a program fails whatever the question is. They get no more
//! questions.

use std::collections::BTreeMap;

use cases::probe::Question;

use super::failure::{Failure, spread};

/// The evidence about each function from the questions of one stage.
#[derive(Debug, Default)]
pub(super) struct Functions<'a>(BTreeMap<&'a str, State>);

#[derive(Debug)]
enum State {
    /// All questions so far have ended the process in this way. The number counts them.
    Failing(Box<Failure>, u32),
    /// A question was answered, or ended the process in another way. From now on all questions are
    /// sent.
    Fine,
}

impl<'a> Functions<'a> {
    /// Records that `function` answered a question.
    pub(super) fn answer(&mut self, function: &'a str) {
        self.0.insert(function, State::Fine);
    }

    /// Records that a process ended at a question to `function`. `failure` is `None` if that is not
    /// a failure of the program.
    pub(super) fn end(&mut self, function: &'a str, failure: Option<Failure>) {
        let before = self.0.remove(function);
        let state = match (before, failure) {
            (None, Some(failure)) => State::Failing(Box::new(failure), 1),
            (Some(State::Failing(first, n)), Some(failure)) if failure.is_like(&first) => {
                State::Failing(first, n + 1)
            }
            _ => State::Fine,
        };
        self.0.insert(function, state);
    }

    /// Returns the next question to a function that has failed at all of its questions so far, at
    /// least two.
    ///
    /// The question is far from the earlier ones, so that it best shows whether the function fails
    /// at all of them. Returns `None` if there is no such function, or no open question to it.
    pub(super) fn next_single<'b>(&self, open: &[&'b Question]) -> Option<&'b Question> {
        self.0.iter().find_map(|(function, state)| {
            let State::Failing(_, n @ 2..) = state else { return None };
            let of_function: Vec<&Question> =
                open.iter().copied().filter(|it| it.ask.function() == *function).collect();
            spread(*n, of_function.len()).map(|place| of_function[place])
        })
    }

    /// Returns the number of questions at which `function` failed, if that proves that it fails at
    /// all of them.
    pub(super) fn n_failures(&self, function: &str) -> Option<u32> {
        match self.0.get(function) {
            // One more than for a whole program, since a function has no trial without a question.
            Some(State::Failing(failure, n)) if *n > failure.n_needed() => Some(*n),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use cases::probe::Ask;

    use super::*;
    use crate::exercise::failure::tests::crash;

    fn questions(n: usize) -> Vec<Question> {
        let ask = |_| Ask::Indices { inside: true, index: 1.5 };
        (0..n).map(|n| Question { id: format!("q{n}"), ask: ask(n) }).collect()
    }

    /// Checks what is known after questions to `indices` ended as in `ends`.
    ///
    /// `next_single` is the index among 80 open questions of the next one to send alone, and
    /// `n_failures` the number of failures if that is enough.
    fn check(ends: &[Option<&str>], next_single: Option<usize>, n_failures: Option<u32>) {
        let questions = questions(80);
        let open: Vec<&Question> = questions.iter().collect();
        let mut functions = Functions::default();
        for end in ends {
            match end {
                Some("answer") => functions.answer("indices"),
                other => functions.end("indices", other.and_then(crash)),
            }
        }
        let place = functions
            .next_single(&open)
            .map(|it| questions.iter().position(|one| one.id == it.id).unwrap());
        assert_eq!((place, functions.n_failures("indices")), (next_single, n_failures), "{ends:?}");
        assert_eq!(functions.n_failures("attenuation"), None);
    }

    #[test]
    fn a_function_that_fails_alike_at_questions_from_all_over_fails_at_all() {
        let (no_sphere, no_cone) = (Some("no sphere"), Some("no cone"));
        check(&[], None, None);
        check(&[no_sphere], None, None);
        check(&[no_sphere; 2], Some(79), None);
        check(&[no_sphere; 3], Some(10), None);
        check(&[no_sphere; 4], Some(20), Some(4));
        check(&[no_sphere, no_sphere, no_sphere, no_cone], None, None);
        check(&[no_sphere, no_sphere, Some("answer")], None, None);
        check(&[Some("answer"), no_sphere, no_sphere, no_sphere, no_sphere], None, None);
        check(&[no_sphere, no_sphere, None, no_sphere, no_sphere], None, None);
        check(&[None, no_sphere, no_sphere, no_sphere, no_sphere], None, None);
        check(&[Some(""); 8], Some(60), None);
        check(&[Some(""); 9], Some(70), Some(9));
    }

    #[test]
    fn where_no_question_is_left_none_is_put() {
        let mut functions = Functions::default();
        (0..2).for_each(|_| functions.end("indices", crash("no sphere")));
        assert!(functions.next_single(&[]).is_none());
    }
}
