//! The solver of quadratic equations; no other module solves them.

use std::ops::{Add, Div, Sub};

use crate::numbers::real::Real;
use crate::numbers::two::Two;

/// A type of number in which quadratics can be solved.
pub trait Number:
    Copy + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Div<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// Returns √x; NaN below 0.
    fn sqrt(self) -> Self;
}

impl<T: Real> Number for T {
    const ZERO: Self = <T as Real>::ZERO;

    #[inline(always)]
    fn sqrt(self) -> Self {
        Real::sqrt(self)
    }
}

impl Number for Two {
    const ZERO: Self = Self::ZERO;

    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

/// Returns the real roots of a t² − 2 b t + c = 0 in ascending order, given `disc` = b² − a c.
/// [rule 14]
///
/// `None` means that there is no real root.
///
/// - The caller computes the discriminant, because it often knows a form that does not cancel.
/// - One root is q / a with q = b ± √disc, where the sign is the one that does not cancel. The
///   other is c / q, because the product of the roots is c / a.
/// - A double root is returned twice.
/// - With a = 0, one root is c / 2b and the other is infinite. With a = b = 0, the result is
///   `None`.
/// - NaN gives `None`.
///
/// ```
/// use reference::numbers::roots::ascending;
///
/// // t² − 6 t + 8 = (t − 2)(t − 4): a = 1, b = 3, c = 8, disc = 9 − 8
/// assert_eq!(ascending(1.0, 3.0, 8.0, 1.0), Some([2.0, 4.0]));
/// // t² + 1: disc = 0 − 1
/// assert_eq!(ascending(1.0, 0.0, 1.0, -1.0), None);
/// ```
#[inline(always)]
pub fn ascending<T: Number>(a: T, b: T, c: T, disc: T) -> Option<[T; 2]> {
    let is_real = disc >= T::ZERO; // false for NaN
    if !is_real {
        return None;
    }
    let root = disc.sqrt();
    let q = if b < T::ZERO { b - root } else { b + root };
    if q == T::ZERO {
        return (a != T::ZERO).then_some([T::ZERO; 2]); // b = disc = 0: the double root is 0
    }
    let (one, other) = (c / q, q / a);
    Some(if one <= other { [one, other] } else { [other, one] })
}

/// Returns the real roots of a t² − 2 b t + c = 0 by the textbook.
///
/// The roots are (2b ± √((2b)² − 4 a c)) / 2a, in ascending order; `None` means that there are
/// none, or that a number is NaN. Where b² is much greater than a c, the small root loses its
/// digits. With a = 0, the result is that of [`ascending`].
pub fn textbook<T: Real>(a: T, b: T, c: T) -> Option<[T; 2]> {
    if a == T::ZERO {
        return ascending(a, b, c, b * b);
    }
    let twice = T::TWO * b;
    let disc = twice * twice - T::TWO * T::TWO * a * c;
    let is_real = disc >= T::ZERO; // false for NaN
    let root = disc.sqrt();
    let (one, other) = ((twice - root) / (T::TWO * a), (twice + root) / (T::TWO * a));
    is_real.then_some(if one <= other { [one, other] } else { [other, one] })
}

/// Returns what a·t² − 2b·t + c gives by the usual formula without the factor 4 of its
/// discriminant: a mistake of students. `None` where that discriminant is negative or NaN.
pub fn four_missing<T: Real>(a: T, b: T, c: T) -> Option<[T; 2]> {
    let (twice, disc) = (b * T::TWO, b * b * T::of(4.0) - a * c);
    let root = disc.sqrt();
    let ends = [(twice - root) * T::HALF / a, (twice + root) * T::HALF / a];
    (disc >= T::ZERO).then_some(ends)
}

/// Returns `middle` − √`square` and `middle` + √`square`; `None` where `square` is negative or NaN.
pub fn about<T: Real>(middle: T, square: T) -> Option<[T; 2]> {
    let is_real = square >= T::ZERO; // false for NaN
    let half = square.sqrt();
    is_real.then_some([middle - half, middle + half])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(a: f64, b: f64, c: f64, expected: Option<[f64; 2]>) {
        assert_eq!(ascending(a, b, c, b * b - a * c), expected, "{a} t² − 2 · {b} t + {c}");
        assert_eq!(textbook(a, b, c), expected, "by the textbook, {a} t² − 2 · {b} t + {c}");
        if a > 0.0 {
            assert_eq!(
                about(b / a, (b * b - a * c) / (a * a)),
                expected,
                "from the middle, {a} t² − 2 · {b} t + {c}"
            );
        }
    }

    #[test]
    fn roots_worked_out_on_paper() {
        check(1.0, 3.0, 8.0, Some([2.0, 4.0])); // (t − 2)(t − 4)
        check(1.0, -3.0, 8.0, Some([-4.0, -2.0]));
        check(-1.0, -3.0, -8.0, Some([2.0, 4.0]));
        check(1.0, 0.0, -4.0, Some([-2.0, 2.0])); // b = 0 has no sign
        check(2.0, 2.0, 2.0, Some([1.0, 1.0])); // tangent
        check(1.0, 0.0, 0.0, Some([0.0, 0.0]));
        check(1.0, 1.0, 0.0, Some([0.0, 2.0]));
        check(1.0, 0.0, 1.0, None);
        check(0.0, 2.0, 4.0, Some([1.0, f64::INFINITY])); // linear: 4 t = 4
        check(0.0, 0.0, 1.0, None);
        check(1.0, f64::NAN, 1.0, None);
    }

    #[test]
    fn the_small_root_keeps_its_digits() {
        let [near, far] = ascending(1.0, 5e7, 1.0, 25e14 - 1.0).unwrap();
        assert_eq!((near, far), (1e-8, 1e8));
        let [rough, _] = textbook(1.0, 5e7, 1.0).unwrap();
        assert!(
            (rough - 7.45e-9).abs() < 1e-11,
            "the difference of two numbers near 5e7 is {rough}"
        );
    }
}
