//! Finds the functions at which a program fails whatever the question is. No more questions are put
//! to such a function.

use std::collections::BTreeMap;

use cases::probe::Question;

use super::failure::{Failure, spread};

/// The evidence of the questions of one stage on each function.
#[derive(Debug, Default)]
pub(super) struct Functions<'a>(BTreeMap<&'a str, State>);

#[derive(Debug)]
enum State {
    /// All questions so far ended the process in this way; and how many there were.
    Failing(Box<Failure>, u32),
    /// One was answered, or ended the process otherwise. From now on all questions are put.
    Fine,
}

impl<'a> Functions<'a> {
    /// Takes in that `function` answered a question.
    pub(super) fn answer(&mut self, function: &'a str) {
        self.0.insert(function, State::Fine);
    }

    /// Takes in that a process ended at a question to `function`, without a failure where that says
    /// nothing against the program.
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

    /// Returns the question that best tells whether a function that has failed at its first two
    /// questions fails at all of them.
    pub(super) fn telling<'b>(&self, open: &[&'b Question]) -> Option<&'b Question> {
        self.0.iter().find_map(|(function, state)| {
            let State::Failing(_, n @ 2..) = state else { return None };
            let of_function: Vec<&Question> =
                open.iter().copied().filter(|it| it.ask.function() == *function).collect();
            spread(*n, of_function.len()).map(|place| of_function[place])
        })
    }

    /// Returns the number of questions at which `function` failed, if it fails at all of them.
    pub(super) fn n_failures(&self, function: &str) -> Option<u32> {
        match self.0.get(function) {
            // One more than for a whole program, for which a run without a question decides.
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

    /// Checks what is known after questions to `indices` ended so: the place among 80 open ones of
    /// the next one to put alone, and the number of failures where that is enough.
    fn check(ends: &[Option<&str>], telling: Option<usize>, n_failures: Option<u32>) {
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
            .telling(&open)
            .map(|it| questions.iter().position(|one| one.id == it.id).unwrap());
        assert_eq!((place, functions.n_failures("indices")), (telling, n_failures), "{ends:?}");
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
        assert!(functions.telling(&[]).is_none());
    }
}
