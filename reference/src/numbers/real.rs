//! The scalar type that the tracer is generic over, and scaling by powers of two, which rounds
//! nothing.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use cases::maths;

/// A floating-point scalar: f32 or f64. One source gives single and double precision.
///
/// Platform-dependent functions come from [`cases::maths`], so that every machine computes the same
/// bits. Those of f32 are computed in f64 and rounded once.
pub trait Real:
    Copy
    + Debug
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1/2.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// 2.
    const TWO: Self;
    /// ∞.
    const INFINITY: Self;
    /// The distance from 1 to the next greater number.
    const ULP: Self;
    /// RAY_EPSILON in this precision: a hit at this parameter or below does not count. [rule 21]
    const RAY_EPSILON: Self;
    /// The least and the greatest magnitude of a product that a certified formula trusts. Between
    /// them, a further product neither overflows nor underflows.
    const SAFE: [Self; 2];
    /// The multiple of its error bound that a value must reach for its own digits to be trusted,
    /// and not only its sign.
    const MARGIN: Self;
    /// The multiple of its error bound that a value must reach for a ray that a matrix has moved: a
    /// share of its digits is then right.
    const MOVED_MARGIN: Self;

    /// Returns the number nearest to `x`; ±∞ where `x` is beyond the range.
    fn of(x: f64) -> Self;
    /// Returns this number as f64, exactly.
    fn f64(self) -> f64;
    /// Returns √x, correctly rounded; NaN below 0.
    fn sqrt(self) -> Self;
    /// Returns |x|.
    fn abs(self) -> Self;
    /// Returns the lesser of both; if one is NaN, the other.
    fn least(self, other: Self) -> Self;
    /// Returns the greater of both; if one is NaN, the other.
    fn greatest(self, other: Self) -> Self;
    /// Returns `self` to the power `y`; 0 to the power 0 is 1.
    fn pow(self, y: Self) -> Self;
    /// Returns e to the power `self`.
    fn exp(self) -> Self;
    /// Returns the natural logarithm; −∞ for 0, NaN below.
    fn ln(self) -> Self;
    /// Returns whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Returns whether the magnitude lies strictly within [`Real::SAFE`]; false for 0, ∞ and NaN.
    #[inline(always)]
    fn is_safe(self) -> bool {
        let size = self.abs();
        (Self::SAFE[0] < size) & (size < Self::SAFE[1])
    }
}

macro_rules! real {
    ($t:ident, $ray_epsilon:expr, $safe:expr, $margin:expr, $moved_margin:expr) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            const HALF: Self = 0.5;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const INFINITY: Self = $t::INFINITY;
            const ULP: Self = $t::EPSILON;
            const RAY_EPSILON: Self = $ray_epsilon;
            const SAFE: [Self; 2] = $safe;
            const MARGIN: Self = $margin;
            const MOVED_MARGIN: Self = $moved_margin;

            #[inline(always)]
            fn of(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $t::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $t::abs(self)
            }
            #[inline(always)]
            fn least(self, other: Self) -> Self {
                $t::min(self, other)
            }
            #[inline(always)]
            fn greatest(self, other: Self) -> Self {
                $t::max(self, other)
            }
            #[inline]
            fn pow(self, y: Self) -> Self {
                maths::pow(f64::from(self), f64::from(y)) as $t
            }
            #[inline]
            fn exp(self) -> Self {
                maths::exp(f64::from(self)) as $t
            }
            #[inline]
            fn ln(self) -> Self {
                maths::ln(f64::from(self)) as $t
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $t::is_finite(self)
            }
        }
    };
}

real!(f32, 1e-4, [1e-18, 1e18], 512.0, 16.0);
real!(f64, cases::RAY_EPSILON, [1e-150, 1e150], 268_435_456.0, 16_384.0);

/// Returns the exponent e with 2^e ≤ |x| < 2^(e + 1); −1023 for 0 and subnormal numbers, 1024 for ∞
/// and NaN.
pub fn exponent(x: f64) -> i32 {
    (x.to_bits() >> 52 & 0x7ff) as i32 - 1023
}

/// Returns x 2^e. The result is rounded only where it is subnormal, and ±∞ where it overflows.
pub fn scaled(x: f64, e: i32) -> f64 {
    let power = |e: i32| f64::from_bits(((e + 1023) as u64) << 52);
    let mut rest = e.clamp(-2200, 2200);
    let mut x = x;
    while rest != 0 {
        let step = rest.clamp(-1022, 1023);
        x *= power(step);
        rest -= step;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_takes_the_exponent_along() {
        for (x, e) in
            [(1.5, 0), (-3.0, 1), (0.75, -1), (1e-200, -665), (0.0, -1023), (f64::INFINITY, 1024)]
        {
            assert_eq!(exponent(x), e, "{x}");
        }
        assert_eq!(scaled(3.0, -1074), f64::from_bits(3));
        assert_eq!(scaled(f64::from_bits(3), 1074), 3.0);
        assert_eq!(scaled(1.0, 2000), f64::INFINITY);
    }
}
