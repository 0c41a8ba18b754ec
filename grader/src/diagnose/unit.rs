//! Which known mistakes say what a function answered.

use std::collections::BTreeMap;

use cases::answer::CheckAnswer;
use cases::probe::Answer;

use crate::judge;

/// 1 for each mistake that gives this answer, 0 for the others.
pub fn unit(actual: &Answer, right: &CheckAnswer) -> BTreeMap<String, f64> {
    let share = |wrong: &Answer| f64::from(u8::from(judge::alike(wrong, actual, right.allowed)));
    right.wrong.iter().map(|(id, wrong)| (id.clone(), share(wrong))).collect()
}
