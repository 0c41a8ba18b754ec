//! Combinations of known mistakes, and how well their parts are named.

use std::fmt;

use reference::rules::Rules;
use reference::rules::misconceptions::{self, Misconception};

use crate::dice::Dice;

/// Returns `n` combinations of `size` known mistakes each, no two of which change the same field of
/// the rules. They depend only on the seed.
pub fn combinations(seed: u64, n: usize, size: usize) -> Vec<Vec<&'static Misconception>> {
    let known = misconceptions::of(&Rules::LECTURE);
    let mut dice = Dice::new(seed);
    let draw = |_| {
        let mut chosen: Vec<&Misconception> = vec![];
        while chosen.len() < size {
            let one = known[dice.below(known.len())];
            if chosen.iter().all(|other| other.field != one.field) {
                chosen.push(one);
            }
        }
        chosen
    };
    (0..n).map(draw).collect()
}

/// Returns the rules of the lecture with these mistakes, in the plain style of a student.
pub fn parts(mistakes: &[&Misconception]) -> Rules {
    let mut rules = Rules::LECTURE;
    mistakes.iter().for_each(|one| (one.apply)(&mut rules));
    rules.plain()
}

/// The numbers of names in one or several runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Mistakes in the programs.
    pub parts: usize,
    /// Mistakes in the programs that are named.
    pub found: usize,
    /// Diagnoses.
    pub given: usize,
    /// Diagnoses of which no mistake is in the program, but one changes a field that a mistake of
    /// the program changes.
    pub near: usize,
    /// Other diagnoses of which no mistake is in the program.
    pub wrong: usize,
}

impl Names {
    /// Returns the numbers of one program with the mistakes `parts` that is given the names
    /// `named`.
    pub fn of(parts: &[&Misconception], named: &[Vec<&str>]) -> Self {
        let known = misconceptions::of(&Rules::LECTURE);
        let field = |id: &str| known.iter().find(|one| one.id == id).map(|one| one.field);
        let is_part = |id: &&str| parts.iter().any(|part| part.id == *id);
        let is_near = |id: &&str| parts.iter().any(|part| Some(part.field) == field(id));
        let others = || named.iter().filter(|ids| !ids.iter().any(&is_part));
        let near = others().filter(|ids| ids.iter().any(&is_near)).count();
        Self {
            parts: parts.len(),
            found: parts.iter().filter(|part| named.concat().contains(&part.id)).count(),
            given: named.len(),
            near,
            wrong: others().count() - near,
        }
    }

    /// Returns the sum of both.
    pub fn plus(self, other: Self) -> Self {
        Self {
            parts: self.parts + other.parts,
            found: self.found + other.found,
            given: self.given + other.given,
            near: self.near + other.near,
            wrong: self.wrong + other.wrong,
        }
    }
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = 100.0 * self.found as f64 / self.parts.max(1) as f64;
        write!(
            f,
            "{} of {} parts found ({share:.1} %), {} names, {} near, {} wrong",
            self.found, self.parts, self.given, self.near, self.wrong
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_take_each_decision_once() {
        let drawn = combinations(1, 20, 5);
        assert_eq!(drawn.len(), 20);
        for parts in &drawn {
            let fields: std::collections::BTreeSet<&str> =
                parts.iter().map(|part| part.field).collect();
            assert_eq!(fields.len(), 5);
        }
        let ids = |drawn: &[Vec<&Misconception>]| {
            drawn.concat().iter().map(|part| part.id).collect::<Vec<_>>()
        };
        assert_eq!(ids(&drawn), ids(&combinations(1, 20, 5)));
        assert_ne!(ids(&drawn), ids(&combinations(2, 20, 5)));
    }

    #[test]
    fn names_are_right_near_or_wrong() {
        let known = misconceptions::of(&Rules::LECTURE);
        let part = |id: &str| *known.iter().find(|one| one.id == id).expect("a mistake");
        let parts = [part("no_shadows"), part("perfect_mirror"), part("flat_shading")];
        let named = [
            vec!["no_shadows"],
            vec!["perfect_mirror", "stretched"],
            vec!["nearest_vertex_normal"],
            vec!["mirrored"],
        ];
        let expected = Names { parts: 3, found: 2, given: 4, near: 1, wrong: 1 };
        assert_eq!(Names::of(&parts, &named), expected);
        assert_eq!(expected.plus(expected).given, 8);
    }
}
