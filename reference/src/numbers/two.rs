//! Numbers in two words of f64, some 106 bits, for decisions that one word leaves open.
//!
//! A value is the unevaluated sum of two words, the second at most half a unit in the last place of
//! the first. The relative error of an operation is below 2⁻¹⁰⁰ (Joldes, Muller, Popescu 2017), as
//! long as nothing leaves the range 1e-140 to 1e140: callers scale by powers of two first. No fused
//! operation is used, so that every machine computes the same bits.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::numbers::real::scaled;
use crate::numbers::vec3::Vec3;

/// A sum of terms counts as zero if it is at most this share of the sum of their magnitudes. The
/// share is that of some hundred roundings in two words.
pub const DOUBT: f64 = f64::from_bits((1023 - 94) << 52);

/// The number hi + lo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Two {
    hi: f64,
    lo: f64,
}

impl Two {
    /// 0.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// Returns the number `x`.
    #[inline]
    pub const fn of(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// Returns a + b, exactly (Knuth).
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let of_b = hi - a;
        Self { hi, lo: (a - (hi - of_b)) + (b - of_b) }
    }

    /// Returns a b, exactly unless its last digits underflow (Dekker).
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        Self { hi, lo: ((a1 * b1 - hi) + a1 * b2 + a2 * b1) + a2 * b2 }
    }

    /// Returns the nearest number in one word.
    #[inline]
    pub fn f64(self) -> f64 {
        self.hi
    }

    /// Returns |x|.
    #[inline]
    pub fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    /// Returns x 2^e. Words that become subnormal are rounded.
    #[inline]
    pub fn scaled(self, e: i32) -> Self {
        Self { hi: scaled(self.hi, e), lo: scaled(self.lo, e) }
    }

    /// Returns the number, or 0 where rounding leaves its sign in doubt. `amounts` is the sum of
    /// the magnitudes of its terms.
    #[inline]
    pub fn certain(self, amounts: f64) -> Self {
        if self.hi.abs() <= DOUBT * amounts { Self::ZERO } else { self }
    }

    /// Returns √x; NaN below 0.
    #[inline]
    pub fn sqrt(self) -> Self {
        if self.hi == 0.0 {
            return Self::ZERO;
        }
        let root = self.hi.sqrt();
        let rest = self - Self::product(root, root);
        quick_sum(root, rest.hi / (2.0 * root))
    }
}

/// Returns a + b, exactly, for |a| ≥ |b|.
#[inline]
fn quick_sum(a: f64, b: f64) -> Two {
    let hi = a + b;
    Two { hi, lo: b - (hi - a) }
}

/// Returns x as the sum of two numbers of 26 bits (Veltkamp).
#[inline]
fn halves(x: f64) -> (f64, f64) {
    let shifted = x * 134_217_729.0; // 2²⁷ + 1
    let high = shifted - (shifted - x);
    (high, x - high)
}

impl From<f64> for Two {
    fn from(x: f64) -> Self {
        Self::of(x)
    }
}

impl Add for Two {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.hi, other.hi), Self::sum(self.lo, other.lo));
        let first = quick_sum(high.hi, high.lo + low.hi);
        quick_sum(first.hi, first.lo + low.lo)
    }
}

impl Neg for Two {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Two {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Two {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let whole = Self::product(self.hi, other.hi);
        quick_sum(whole.hi, whole.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for Two {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        if !first.is_finite() {
            return Self::of(first);
        }
        let rest = self - other * Self::of(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::of(second);
        quick_sum(first, second) + Self::of(rest.hi / other.hi)
    }
}

impl PartialOrd for Two {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        match self.hi.partial_cmp(&other.hi)? {
            std::cmp::Ordering::Equal => self.lo.partial_cmp(&other.lo),
            decided => Some(decided),
        }
    }
}

/// A vector whose components have two words each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Two3 {
    /// The first component.
    pub x: Two,
    /// The second component.
    pub y: Two,
    /// The third component.
    pub z: Two,
}

impl Two3 {
    /// Returns the vector `v`.
    pub fn of(v: Vec3<f64>) -> Self {
        Self { x: v.x.into(), y: v.y.into(), z: v.z.into() }
    }

    /// Returns a − b, exactly.
    pub fn difference(a: Vec3<f64>, b: Vec3<f64>) -> Self {
        Self { x: Two::sum(a.x, -b.x), y: Two::sum(a.y, -b.y), z: Two::sum(a.z, -b.z) }
    }

    /// Returns v 2^e.
    pub fn scaled(self, e: i32) -> Self {
        Self { x: self.x.scaled(e), y: self.y.scaled(e), z: self.z.scaled(e) }
    }

    /// Returns the component along axis 0, 1 or 2.
    pub fn along(self, axis: usize) -> Two {
        [self.x, self.y, self.z][axis]
    }

    /// Returns the dot product, Σ of the products of components.
    pub fn dot(self, other: Self) -> Two {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Returns the cross product.
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns the nearest vector with one word per component.
    pub fn f64(self) -> Vec3<f64> {
        Vec3::new(self.x.f64(), self.y.f64(), self.z.f64())
    }
}

impl Add for Two3 {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Two3 {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Neg for Two3 {
    type Output = Self;

    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl Mul<Two> for Two3 {
    type Output = Self;

    fn mul(self, scale: Two) -> Self {
        Self { x: self.x * scale, y: self.y * scale, z: self.z * scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const U: f64 = f64::EPSILON / 2.0;

    #[test]
    fn sums_and_products_lose_nothing() {
        assert_eq!(Two::sum(1.0, U / 4.0), Two { hi: 1.0, lo: U / 4.0 });
        // (1 + 2u)² = 1 + 4u + 4u²
        assert_eq!(
            Two::product(1.0 + 2.0 * U, 1.0 + 2.0 * U),
            Two { hi: 1.0 + 4.0 * U, lo: 4.0 * U * U }
        );
        let rest = Two::sum(1e16, 1.0) * Two::of(1e16) - Two::product(1e16, 1e16); // (x + 1) x − x²
        assert_eq!(rest, Two::of(1e16));
    }

    #[test]
    fn quotients_and_roots_come_back() {
        let third = Two::of(1.0) / Two::of(3.0);
        assert!((third * Two::of(3.0) - Two::of(1.0)).abs().f64() < DOUBT);
        let root = Two::of(2.0).sqrt();
        assert!((root * root - Two::of(2.0)).abs().f64() < DOUBT);
        assert_eq!(Two::product(3.0, 3.0).sqrt(), Two::of(3.0));
        assert!(Two::of(-1.0).sqrt().f64().is_nan());
    }
}
