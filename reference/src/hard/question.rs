//! A call of one function, with all its numbers.

use crate::numbers::real::Real;

/// A ray r(t) = origin + t · direction, t > 0, whose direction may have any length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the formula names both fields")]
pub struct Line {
    pub origin: [f64; 3],
    pub direction: [f64; 3],
}

/// A question: the function to call, and its arguments. The numbers are exact: the correct answer
/// is that of these floats, not that of the decimals they were parsed from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "fields are named as in the rules of light")]
pub enum Question {
    /// The intersection of the line with ‖X − center‖ = radius, and N there. [rule 14]
    Sphere { line: Line, center: [f64; 3], radius: f64 },
    /// The intersection with N·X = k. [rule 15]
    Plane { line: Line, normal: [f64; 3], k: f64 },
    /// The intersection with |x|, |y| ≤ ½, z = 0. [rule 15]
    Square { line: Line },
    /// The intersection with the surface of min ≤ X ≤ max, and N there. [rule 15]
    Cuboid { line: Line, min: [f64; 3], max: [f64; 3] },
    /// The intersection with x² + y² = r(z)² between `ends` and, if `is_capped`, with the discs
    /// there; and N at the hit. r is linear in z, and `radii` are its values at `ends`. [rule 15]
    Round { line: Line, radii: [f64; 2], ends: [f64; 2], is_capped: bool },
    /// The intersection with a triangle, with N and (α, β, γ). [rule 16] [rule 17]
    Triangle { line: Line, corners: [[f64; 3]; 3] },
    /// The intersection with a shape that is transformed by A X + t, and N there. `rows` are the
    /// rows of A. [rule 20]
    Transformed { line: Line, form: Form, rows: [[f64; 3]; 3], translation: [f64; 3] },
    /// The reflected direction. [rule 7]
    Reflect { direction: [f64; 3], normal: [f64; 3] },
    /// The transmitted direction. Total internal reflection is a miss. [rule 8] [rule 10]
    Refract { direction: [f64; 3], normal: [f64; 3], eta_i: f64, eta_t: f64 },
    /// A normal, transformed by A. A singular matrix is a miss. [rule 20]
    Normal { rows: [[f64; 3]; 3], normal: [f64; 3] },
}

/// A shape in a space of its own. The fields are those of the questions about shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "fields are named as in the questions")]
pub enum Form {
    Sphere { center: [f64; 3], radius: f64 },
    Plane { normal: [f64; 3], k: f64 },
    Square,
    Cuboid { min: [f64; 3], max: [f64; 3] },
    Round { radii: [f64; 2], ends: [f64; 2], is_capped: bool },
}

impl Form {
    /// The sphere of radius ½ about the origin. [rule 14]
    pub const SPHERE: Self = Self::Sphere { center: [0.0; 3], radius: 0.5 };

    /// Returns line and shape of a question about a shape.
    ///
    /// # Panics
    /// If the question is about a triangle or not about a shape.
    pub fn of(question: Question) -> (Line, Self) {
        match question {
            Question::Sphere { line, center, radius } => (line, Self::Sphere { center, radius }),
            Question::Plane { line, normal, k } => (line, Self::Plane { normal, k }),
            Question::Square { line } => (line, Self::Square),
            Question::Cuboid { line, min, max } => (line, Self::Cuboid { min, max }),
            Question::Round { line, radii, ends, is_capped } => {
                (line, Self::Round { radii, ends, is_capped })
            }
            other => panic!("{other:?} is not about a solid"),
        }
    }

    fn map(self, f: &mut impl FnMut(f64) -> f64) -> Self {
        match self {
            Self::Sphere { center, radius } => {
                Self::Sphere { center: three(center, f), radius: f(radius) }
            }
            Self::Plane { normal, k } => Self::Plane { normal: three(normal, f), k: f(k) },
            Self::Square => Self::Square,
            Self::Cuboid { min, max } => Self::Cuboid { min: three(min, f), max: three(max, f) },
            Self::Round { radii, ends, is_capped } => {
                Self::Round { radii: radii.map(&mut *f), ends: ends.map(&mut *f), is_capped }
            }
        }
    }
}

impl Question {
    /// Returns the question with `f` applied to each number, in order.
    pub fn map(self, f: &mut impl FnMut(f64) -> f64) -> Self {
        let line = |line: Line, f: &mut _| Line {
            origin: three(line.origin, f),
            direction: three(line.direction, f),
        };
        match self {
            Self::Sphere { line: l, center, radius } => {
                Self::Sphere { line: line(l, f), center: three(center, f), radius: f(radius) }
            }
            Self::Plane { line: l, normal, k } => {
                Self::Plane { line: line(l, f), normal: three(normal, f), k: f(k) }
            }
            Self::Square { line: l } => Self::Square { line: line(l, f) },
            Self::Cuboid { line: l, min, max } => {
                Self::Cuboid { line: line(l, f), min: three(min, f), max: three(max, f) }
            }
            Self::Round { line: l, radii, ends, is_capped } => Self::Round {
                line: line(l, f),
                radii: radii.map(&mut *f),
                ends: ends.map(&mut *f),
                is_capped,
            },
            Self::Triangle { line: l, corners } => {
                Self::Triangle { line: line(l, f), corners: corners.map(|c| three(c, f)) }
            }
            Self::Transformed { line: l, form, rows, translation } => {
                let (line, form) = (line(l, f), form.map(f));
                let rows = rows.map(|row| three(row, f));
                Self::Transformed { line, form, rows, translation: three(translation, f) }
            }
            Self::Reflect { direction, normal } => {
                Self::Reflect { direction: three(direction, f), normal: three(normal, f) }
            }
            Self::Refract { direction, normal, eta_i, eta_t } => {
                let (direction, normal) = (three(direction, f), three(normal, f));
                Self::Refract { direction, normal, eta_i: f(eta_i), eta_t: f(eta_t) }
            }
            Self::Normal { rows, normal } => {
                Self::Normal { rows: rows.map(|row| three(row, f)), normal: three(normal, f) }
            }
        }
    }

    /// Returns the question with its numbers rounded to the precision `T`.
    pub fn rounded<T: Real>(self) -> Self {
        self.map(&mut |x| T::of(x).f64())
    }

    /// Returns the questions in which one number is moved to its neighbour in the precision `T`:
    /// each number in turn, farther from 0 and nearer. Zeros stay.
    pub fn moved<T: Real>(self) -> impl Iterator<Item = Self> {
        let mut n_numbers = 0;
        self.map(&mut |x| {
            n_numbers += 1;
            x
        });
        (0..2 * n_numbers).map(move |step| {
            let mut place = 0;
            self.map(&mut |x| {
                place += 1;
                if place - 1 == step / 2 { next::<T>(x, step % 2 == 0) } else { x }
            })
        })
    }
}

fn three(v: [f64; 3], f: &mut impl FnMut(f64) -> f64) -> [f64; 3] {
    v.map(&mut *f)
}

/// Returns the neighbour of `x` in the precision `T`, farther from 0 or nearer to it. 0 for 0.
fn next<T: Real>(x: f64, is_outwards: bool) -> f64 {
    if x == 0.0 {
        return x;
    }
    let (up, down) = if T::ULP.f64() == f64::EPSILON {
        (x.next_up(), x.next_down())
    } else {
        (f64::from((x as f32).next_up()), f64::from((x as f32).next_down()))
    };
    if (up.abs() > x.abs()) == is_outwards { up } else { down }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_is_moved_both_ways_and_nothing_else() {
        let line = Line { origin: [0.0, 0.0, 2.0], direction: [0.0, 0.0, -1.0] };
        let question = Question::Sphere { line, center: [0.0, 0.5, 0.0], radius: 0.5 };
        let moved: Vec<Question> = question.moved::<f64>().collect();
        assert_eq!(moved.len(), 20);
        let others = moved.iter().filter(|other| **other != question).count();
        assert_eq!(others, 2 * 4, "four numbers are not 0");
        let farther = Question::Sphere { line, center: [0.0, 0.5, 0.0], radius: 0.5f64.next_up() };
        assert_eq!(moved[18], farther);
        assert_eq!(question.moved::<f32>().nth(5), {
            let line = Line { origin: [0.0, 0.0, f64::from(2.0f32.next_down())], ..line };
            Some(Question::Sphere { line, center: [0.0, 0.5, 0.0], radius: 0.5 })
        });
    }

    #[test]
    fn rounding_is_that_of_single_precision() {
        let question = Question::Reflect { direction: [0.1, 1.0, 0.0], normal: [0.0, 0.0, 1.0] };
        let rounded =
            Question::Reflect { direction: [f64::from(0.1f32), 1.0, 0.0], normal: [0.0, 0.0, 1.0] };
        assert_eq!(question.rounded::<f32>(), rounded);
        assert_eq!(question.rounded::<f64>(), question);
    }
}
