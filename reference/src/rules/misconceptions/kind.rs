//! A known mistake.

use crate::rules::Rules;

/// A known way to get a rule wrong.
#[derive(Clone, Copy, Debug)]
pub struct Misconception {
    /// A unique name, such as `mirror_backwards`.
    pub id: &'static str,
    /// The rule that the mistake breaks, 1 to 21.
    pub rule: u8,
    /// A sentence for the student on what the program does wrong. It does not give the solution:
    /// that is the rule.
    pub says: &'static str,
    /// The student's function to check, as `file.rs function`.
    pub look_at: &'static str,
    /// The field of [`Rules`] that the mistake changes. A program makes at most one mistake of each
    /// field.
    pub field: &'static str,
    /// Makes the mistake in a set of rules.
    pub apply: fn(&mut Rules),
}

impl Misconception {
    /// Returns the rules of a course with this mistake, in the plain style of a student.
    pub fn in_student_style(&self, rules: &Rules) -> Rules {
        self.on(rules).plain()
    }

    /// Returns the rules of a course with this mistake.
    pub fn on(&self, rules: &Rules) -> Rules {
        let mut rules = *rules;
        (self.apply)(&mut rules);
        rules
    }
}
