//! A question to one function, with all its numbers.

use crate::real::Real;

/// r(t) = origin + t · direction, t > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the formula names both")]
pub struct Line {
    pub origin: [f64; 3],
    pub direction: [f64; 3],
}

/// What is asked. The numbers are exact: the answer is theirs, not that of the decimals they came
/// from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "fields are named as in the rules of light")]
pub enum Question {
    /// Where the line meets ‖X − center‖ = radius, and N there. [rule 14]
    Sphere { line: Line, center: [f64; 3], radius: f64 },
    /// Where it meets N·X = k. [rule 15]
    Plane { line: Line, normal: [f64; 3], k: f64 },
    /// Where it meets |x|, |y| ≤ ½, z = 0. [rule 15]
    Square { line: Line },
    /// Where it meets the surface of min ≤ X ≤ max, and N there. [rule 15]
    Cuboid { line: Line, min: [f64; 3], max: [f64; 3] },
    /// Where it meets x² + y² = r(z)², and N there. [rule 15]
    Round { line: Line, radii: [f64; 2], ends: [f64; 2], is_capped: bool },
    /// Where it meets a triangle, with N and (α, β, γ). [rule 16] [rule 17]
    Triangle { line: Line, corners: [[f64; 3]; 3] },
    /// Where it meets the sphere of radius ½ about the origin, moved by A X + t; rows are those of
    /// A. [rule 20]
    TransformedSphere { line: Line, rows: [[f64; 3]; 3], translation: [f64; 3] },
    /// The mirrored direction. [rule 7]
    Reflect { direction: [f64; 3], normal: [f64; 3] },
    /// The transmitted direction; a miss is total internal reflection. [rule 8] [rule 10]
    Refract { direction: [f64; 3], normal: [f64; 3], eta_i: f64, eta_t: f64 },
    /// A normal, moved by A. [rule 20]
    Normal { rows: [[f64; 3]; 3], normal: [f64; 3] },
}

impl Question {
    /// The same question with `f` of each number, in order.
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
            Self::TransformedSphere { line: l, rows, translation } => {
                let (line, rows) = (line(l, f), rows.map(|row| three(row, f)));
                Self::TransformedSphere { line, rows, translation: three(translation, f) }
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

    /// The question with its numbers rounded to the precision `T`.
    pub fn rounded<T: Real>(self) -> Self {
        self.map(&mut |x| T::of(x).f64())
    }

    /// The questions with one number moved to the next one that `T` has, each number in turn, both
    /// ways; zeros stay.
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

/// The neighbour of x in the precision `T`, farther from 0 or nearer; 0 for 0.
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
