//! The known mistakes that give the same answer as a function.

use std::collections::BTreeMap;

use cases::answer::CheckAnswer;
use cases::probe::Answer;

use crate::judge;

/// Returns, by id, 1 for each mistake that gives the answer `actual`, and 0 for the others.
pub fn unit(actual: &Answer, right: &CheckAnswer) -> BTreeMap<String, f64> {
    let share = |wrong: &Answer| f64::from(u8::from(judge::equal(wrong, actual, right.allowed)));
    right.wrong.iter().map(|(id, wrong)| (id.clone(), share(wrong))).collect()
}

#[cfg(test)]
mod tests {
    use cases::answer::Digest;

    use super::*;

    #[test]
    fn a_mistake_explains_its_own_answer_and_no_other() {
        let wrong = [
            ("twice", Answer::Value(2.0)),
            ("none", Answer::Value(f64::NAN)),
            ("miss", Answer::Miss(true)),
        ];
        let wrong = wrong.map(|(id, answer)| (id.to_owned(), answer)).into();
        let right = CheckAnswer {
            id: "x".to_owned(),
            made_from: Digest::default(),
            answer: Answer::Value(1.0),
            allowed: 1e-6,
            also: vec![],
            wrong,
        };
        let table = [
            (Answer::Value(2.0 + 9e-7), [0.0, 0.0, 1.0]),
            (Answer::Value(2.1), [0.0, 0.0, 0.0]),
            (Answer::Value(f64::NAN), [0.0, 1.0, 0.0]),
            (Answer::Miss(true), [1.0, 0.0, 0.0]),
            (Answer::GoesOn(true), [0.0, 0.0, 0.0]),
        ];
        for (actual, [miss, none, twice]) in table {
            let expected = [("miss", miss), ("none", none), ("twice", twice)]
                .map(|(id, share)| (id.to_owned(), share));
            assert_eq!(unit(&actual, &right), expected.into(), "{actual:?}");
        }
    }
}
