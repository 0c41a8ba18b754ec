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
mod kind;
mod light;
mod shadows;
mod shapes;
mod spaces;
mod spawned;

pub use kind::Misconception;

use crate::rules::Rules;

/// Returns the mistakes that change these rules, in the order of the rules that they break. A
/// mistake that the course itself requires is left out.
pub fn of(rules: &Rules) -> Vec<&'static Misconception> {
    ALL.into_iter().flatten().filter(|wrong| wrong.on(rules) != *rules).collect()
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
