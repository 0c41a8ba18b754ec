//! Numbers m · 2^e with an m of any size: sums and products of floats without rounding.
//!
//! The sign of a polynomial in the numbers of the question decides a hit, so decisions are exact.
//! Quotients and roots, on which no decision depends, have [`WIDE`] bits.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_base::{BitTest, SquareRoot, UnsignedAbs};
use dashu_int::{IBig, Sign};

use super::question::Line;

/// The bits of a quotient or a root. Its error is less than one unit of the last bit.
pub const WIDE: i64 = 192;

/// The number mantissa · 2^exponent.
#[derive(Clone, Debug)]
pub struct Exact {
    mantissa: IBig,
    exponent: i64,
}

impl Exact {
    /// The number 0.
    pub const ZERO: Self = Self { mantissa: IBig::ZERO, exponent: 0 };

    /// Returns `x` exactly.
    ///
    /// # Panics
    /// If `x` is infinite or NaN: questions have only finite numbers.
    pub fn of(x: f64) -> Self {
        assert!(x.is_finite(), "questions have only finite numbers, not {x}");
        let bits = x.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
        let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
        if mantissa == 0 {
            return Self::ZERO;
        }
        let zeros = mantissa.trailing_zeros(); // numbers of few digits keep few bits
        let mantissa = IBig::from(mantissa >> zeros);
        let exponent = biased.max(1) - 1075 + i64::from(zeros);
        Self { mantissa: if x < 0.0 { -mantissa } else { mantissa }, exponent }
    }

    /// Returns the sign: −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        match self.mantissa.sign() {
            _ if self.mantissa.is_zero() => 0,
            Sign::Positive => 1,
            Sign::Negative => -1,
        }
    }

    /// Returns x².
    pub fn squared(&self) -> Self {
        self * self
    }

    /// Returns x 2^e.
    pub fn scaled(mut self, e: i64) -> Self {
        self.exponent += e;
        self
    }

    /// Returns self / other, to [`WIDE`] bits.
    ///
    /// # Panics
    /// If `other` is 0.
    pub fn over(&self, other: &Self) -> Self {
        let shift = (WIDE + other.length_of_mantissa() - self.length_of_mantissa()).max(0);
        let mantissa = (&self.mantissa << shift as usize) / &other.mantissa;
        Self { mantissa, exponent: self.exponent - other.exponent - shift }
    }

    /// Returns √|x|, to [`WIDE`] bits.
    pub fn sqrt(&self) -> Self {
        let mut shift = (2 * WIDE - self.length_of_mantissa()).max(0);
        shift += (self.exponent - shift) & 1;
        let root = (&self.mantissa << shift as usize).unsigned_abs().sqrt();
        Self { mantissa: root.into(), exponent: (self.exponent - shift) / 2 }
    }

    /// Returns the number to one part in 2⁵². It becomes 0 if it underflows, and infinite if it
    /// overflows.
    pub fn f64(&self) -> f64 {
        let (mantissa, exponent) = self.leading();
        crate::numbers::real::scaled(mantissa, exponent.clamp(-10_000, 10_000) as i32)
    }

    /// Returns self / other to one part in 2⁵⁰, even if both are far out of the range of f64. ±∞ or
    /// NaN if `other` is 0.
    pub fn ratio(&self, other: &Self) -> f64 {
        let ((a, a_exponent), (b, b_exponent)) = (self.leading(), other.leading());
        crate::numbers::real::scaled(a / b, (a_exponent - b_exponent).clamp(-10_000, 10_000) as i32)
    }

    /// Returns a float m and an exponent e such that m · 2^e is the number to one part in 2⁵².
    fn leading(&self) -> (f64, i64) {
        let (sign, words) = self.mantissa.as_sign_words();
        let mut top = words.iter().rev().take(2);
        let (high, low) = (top.next().copied().unwrap_or(0), top.next().copied().unwrap_or(0));
        let below = words.len().saturating_sub(2) as i64 * 64;
        let amount = match words.len() {
            0 | 1 => high as f64,
            _ => high as f64 * 18_446_744_073_709_551_616.0 + low as f64,
        };
        (if sign == Sign::Negative { -amount } else { amount }, self.exponent + below)
    }

    fn length_of_mantissa(&self) -> i64 {
        self.mantissa.bit_len() as i64
    }
}

impl Add for &Exact {
    type Output = Exact;

    fn add(self, other: Self) -> Exact {
        let (low, high) =
            if self.exponent <= other.exponent { (self, other) } else { (other, self) };
        if high.mantissa.is_zero() {
            return low.clone();
        }
        if low.mantissa.is_zero() {
            return high.clone();
        }
        let raised = &high.mantissa << (high.exponent - low.exponent) as usize;
        Exact { mantissa: raised + &low.mantissa, exponent: low.exponent }
    }
}

impl Neg for &Exact {
    type Output = Exact;

    fn neg(self) -> Exact {
        Exact { mantissa: -&self.mantissa, exponent: self.exponent }
    }
}

impl Sub for &Exact {
    type Output = Exact;

    fn sub(self, other: Self) -> Exact {
        self + &-other
    }
}

impl Mul for &Exact {
    type Output = Exact;

    fn mul(self, other: Self) -> Exact {
        Exact {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Exact {}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Exact {
    fn cmp(&self, other: &Self) -> Ordering {
        (self - other).sign().cmp(&0)
    }
}

/// A vector of three exact numbers.
pub type Exact3 = [Exact; 3];

/// Returns `v` exactly.
pub fn exact3(v: [f64; 3]) -> Exact3 {
    v.map(Exact::of)
}

/// Returns a + b.
pub fn plus(a: &Exact3, b: &Exact3) -> Exact3 {
    std::array::from_fn(|n| &a[n] + &b[n])
}

/// Returns a − b.
pub fn minus(a: &Exact3, b: &Exact3) -> Exact3 {
    std::array::from_fn(|n| &a[n] - &b[n])
}

/// Returns v s.
pub fn times(v: &Exact3, s: &Exact) -> Exact3 {
    std::array::from_fn(|n| &v[n] * s)
}

/// Returns the dot product.
pub fn dot(a: &Exact3, b: &Exact3) -> Exact {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

/// Returns the cross product.
pub fn cross(a: &Exact3, b: &Exact3) -> Exact3 {
    std::array::from_fn(|n| {
        let (y, z) = ((n + 1) % 3, (n + 2) % 3);
        &(&a[y] * &b[z]) - &(&a[z] * &b[y])
    })
}

/// Returns v/‖v‖, to [`WIDE`] bits.
///
/// # Panics
/// If `v` is the zero vector.
pub fn unit(v: &Exact3) -> Exact3 {
    let length = dot(v, v).sqrt();
    std::array::from_fn(|n| v[n].over(&length))
}

/// The line of a question in exact arithmetic.
pub(super) struct ExactLine {
    pub(super) origin: Exact3,
    pub(super) direction: Exact3,
}

impl ExactLine {
    /// Returns `line` exactly.
    pub(super) fn of(line: &Line) -> Self {
        Self { origin: exact3(line.origin), direction: exact3(line.direction) }
    }

    /// Returns the point at `t`.
    pub(super) fn at(&self, t: &Exact) -> Exact3 {
        plus(&self.origin, &times(&self.direction, t))
    }
}

/// Returns the sign of p + q √d, for d ≥ 0.
pub fn sign_with_root(p: &Exact, q: &Exact, d: &Exact) -> i32 {
    let of_root = q.sign() * d.sign();
    match (p.sign(), of_root) {
        (0, sign) | (sign, 0) => sign,
        (one, other) if one == other => one,
        (sign, _) => sign * (&p.squared() - &(&q.squared() * d)).sign(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_are_exact() {
        let (huge, tiny) = (Exact::of(1e300), Exact::of(-5e-324));
        assert_eq!((&(&huge + &tiny) - &huge).f64(), -5e-324);
        assert_eq!((&tiny * &tiny).ratio(&tiny), -5e-324);
        for x in [1.0, -0.1, 1e-310, 3e200, f64::MAX, 5e-324] {
            assert_eq!(Exact::of(x).f64(), x);
        }
        assert_eq!(Exact::of(-0.0).sign(), 0);
        assert!(Exact::of(1.0) < Exact::of(1.0f64.next_up()));
    }

    #[test]
    fn quotients_and_roots_are_wide() {
        let third = Exact::of(1.0).over(&Exact::of(-3.0));
        let rest = &(&third * &Exact::of(3.0)) + &Exact::of(1.0);
        assert!(rest.f64().abs() < 1e-57, "{}", rest.f64());
        for x in [2.0, 8.0, 1e-301, 1e301] {
            let root = Exact::of(x).sqrt();
            let rest = &root.squared() - &Exact::of(x);
            assert!(rest.ratio(&Exact::of(x)).abs() < 1e-56, "√{x}");
        }
        assert_eq!(Exact::of(9.0).sqrt(), Exact::of(3.0));
        assert_eq!(Exact::ZERO.sqrt().sign(), 0);
    }

    #[test]
    fn signs_beside_a_root_are_exact() {
        // 3 − 2 √d changes its sign at d = 9/4.
        for (d, sign) in [(2.25, 0), (2.25f64.next_up(), -1), (2.25f64.next_down(), 1), (0.0, 1)] {
            assert_eq!(
                sign_with_root(&Exact::of(3.0), &Exact::of(-2.0), &Exact::of(d)),
                sign,
                "{d}"
            );
            assert_eq!(
                sign_with_root(&Exact::of(-3.0), &Exact::of(2.0), &Exact::of(d)),
                -sign,
                "{d}"
            );
        }
        assert_eq!(sign_with_root(&Exact::ZERO, &Exact::of(-2.0), &Exact::of(2.0)), -1);
    }
}
