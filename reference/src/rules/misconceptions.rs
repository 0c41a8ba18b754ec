//! The known mistakes. Each is one change to the rules, with a sentence that explains it to a
//! student.

/// Defines a list of mistakes. Each entry has the id, the rule, the function to look at, the field
/// with its mistaken value, and the sentence for the student.
macro_rules! misconceptions {
    ($name:ident: $(
        $id:ident, $rule:literal, $look_at:literal,
        $($field:ident)? $(|$rules:ident| $other:ident)? = $value:expr, $says:literal;
    )*) => {
        /// The mistakes, in the order of the rules that they break.
        pub(super) const $name: &[Misconception] = &[$(Misconception {
            id: stringify!($id),
            rule: $rule,
            says: $says,
            look_at: $look_at,
            field: stringify!($($field)? $($other)?),
            apply: misconceptions!(@apply $($field)? $(|$rules| $other)? = $value),
        },)*];
    };
    (@apply $field:ident = $value:expr) => { |rules| rules.$field = $value };
    (@apply |$rules:ident| $field:ident = $value:expr) => { |$rules| $rules.$field = $value };
}

mod eye;
mod light;
mod shadows;
mod shapes;
mod spaces;
mod spawned;

use crate::rules::{Depth, Rules};

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

/// Returns the mistakes that change these rules, in the order of the rules that they break. A
/// mistake that the course itself requires is left out.
pub fn of(rules: &Rules) -> Vec<&'static Misconception> {
    ALL.into_iter().flatten().filter(|wrong| wrong.on(rules) != *rules).collect()
}

/// Returns the depth test with one bounce more than `right`. If the course already allows one more
/// than the lecture, that is `right` itself, so that the mistake is left out.
fn one_more(right: Depth) -> Depth {
    if right == Depth::OneMore { right } else { Depth::LessOrEqual }
}

/// All mistakes, in the order of the rules that they break. [`of`] leaves out those that a course
/// requires.
const ALL: [&[Misconception]; 6] = [
    eye::EYE_RAYS_AND_HITS,
    light::LIGHT,
    shadows::SHADOWS,
    spawned::SPAWNED_RAYS,
    shapes::SHAPES,
    spaces::SPACES,
];
