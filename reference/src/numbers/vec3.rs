//! Vectors of three components (points, directions, normals, colours) and affine maps between
//! frames.

use std::ops::{Add, AddAssign, Index, Mul, Neg, Sub};

use glam::{DAffine3, DVec3};

use crate::numbers::real::{Real, exponent, scaled};

/// A vector of three components: x, y, z, or red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<T> {
    /// The first component.
    pub x: T,
    /// The second component.
    pub y: T,
    /// The third component.
    pub z: T,
}

impl<T: Real> Vec3<T> {
    /// The vector (0, 0, 0).
    pub const ZERO: Self = Self { x: T::ZERO, y: T::ZERO, z: T::ZERO };
    /// The vector (1, 1, 1).
    pub const ONE: Self = Self { x: T::ONE, y: T::ONE, z: T::ONE };

    /// Returns the vector (x, y, z).
    #[inline(always)]
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// Returns the vector nearest to `v`, component by component.
    pub fn of(v: DVec3) -> Self {
        Self::new(T::of(v.x), T::of(v.y), T::of(v.z))
    }

    /// Returns this vector in f64, exactly.
    pub fn f64(self) -> DVec3 {
        DVec3::new(self.x.f64(), self.y.f64(), self.z.f64())
    }

    /// Returns the dot product, Σ of the products of components.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Returns the cross product: perpendicular to both vectors, right-handed.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Returns ‖v‖, also where ‖v‖² overflows or underflows.
    #[inline(always)]
    pub fn length(self) -> T {
        let square = self.dot(self);
        if square.is_safe() { square.sqrt() } else { self.small_or_great().0 }
    }

    /// Returns v/‖v‖, however short or long v is; components are NaN for the zero vector.
    #[inline(always)]
    pub fn normalised(self) -> Self {
        let square = self.dot(self);
        if square.is_safe() { self * (T::ONE / square.sqrt()) } else { self.small_or_great().1 }
    }

    /// Returns ‖v‖ and v/‖v‖, computed from v times a power of two, which rounds nothing.
    #[cold]
    #[inline(never)]
    fn small_or_great(self) -> (T, Self) {
        let [x, y, z] = [self.x, self.y, self.z].map(T::f64);
        let exponent = exponent(x).max(exponent(y)).max(exponent(z));
        let near_one = |x: f64| scaled(x, -exponent);
        let (x, y, z) = (near_one(x), near_one(y), near_one(z));
        let length = (x * x + y * y + z * z).sqrt();
        let unit = Self::new(T::of(x / length), T::of(y / length), T::of(z / length));
        (T::of(scaled(length, exponent)), unit)
    }

    /// Returns the greatest component; NaN components are ignored.
    pub fn max_element(self) -> T {
        self.x.greatest(self.y).greatest(self.z)
    }

    /// Returns the least component; NaN components are ignored.
    pub fn min_element(self) -> T {
        self.x.least(self.y).least(self.z)
    }

    /// Returns the vector (|x|, |y|, |z|).
    pub fn abs(self) -> Self {
        self.map(T::abs)
    }

    /// Returns the vector of `f` applied to each component.
    #[inline(always)]
    pub fn map(self, f: impl Fn(T) -> T) -> Self {
        Self::new(f(self.x), f(self.y), f(self.z))
    }

    /// Returns the lesser of each pair of components; if one is NaN, the other.
    pub fn least(self, other: Self) -> Self {
        Self::new(self.x.least(other.x), self.y.least(other.y), self.z.least(other.z))
    }

    /// Returns the greater of each pair of components; if one is NaN, the other.
    pub fn greatest(self, other: Self) -> Self {
        Self::new(self.x.greatest(other.x), self.y.greatest(other.y), self.z.greatest(other.z))
    }

    /// Returns the unit vector along axis 0, 1 or 2; the zero vector for any other number.
    pub fn axis(axis: usize) -> Self {
        let at = |n| if n == axis { T::ONE } else { T::ZERO };
        Self::new(at(0), at(1), at(2))
    }
}

impl<T> Index<usize> for Vec3<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, axis: usize) -> &T {
        match axis {
            0 => &self.x,
            1 => &self.y,
            _ => &self.z,
        }
    }
}

impl<T: Real> Add for Vec3<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Real> AddAssign for Vec3<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real> Sub for Vec3<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Real> Neg for Vec3<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<T: Real> Mul<T> for Vec3<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, scale: T) -> Self {
        Self::new(self.x * scale, self.y * scale, self.z * scale)
    }
}

/// The product component by component, such as light times a colour.
impl<T: Real> Mul for Vec3<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }
}

/// The affine map X ↦ A X + t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine<T> {
    /// The rows of A.
    pub rows: [Vec3<T>; 3],
    /// The translation t.
    pub translation: Vec3<T>,
}

impl<T: Real> Affine<T> {
    /// Returns the map nearest to `map`, number by number.
    pub fn of(map: &DAffine3) -> Self {
        let rows = map.matrix3.transpose();
        Self {
            rows: [rows.x_axis, rows.y_axis, rows.z_axis].map(Vec3::of),
            translation: Vec3::of(map.translation),
        }
    }

    /// Returns A X + t, the image of a point.
    #[inline(always)]
    pub fn point(&self, x: Vec3<T>) -> Vec3<T> {
        self.vector(x) + self.translation
    }

    /// Returns A X, the image of a direction, which is not translated.
    #[inline(always)]
    pub fn vector(&self, x: Vec3<T>) -> Vec3<T> {
        Vec3::new(self.rows[0].dot(x), self.rows[1].dot(x), self.rows[2].dot(x))
    }

    /// Returns Aᵀ X.
    #[inline(always)]
    pub fn transposed(&self, x: Vec3<T>) -> Vec3<T> {
        self.rows[0] * x.x + self.rows[1] * x.y + self.rows[2] * x.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_of_any_size_has_its_length_and_direction() {
        for e in [-1060, -1000, -600, -300, -1, 0, 1, 300, 600, 1000] {
            let v = Vec3::new(3.0, -4.0, 12.0).map(|x| scaled(x, e));
            assert_eq!(v.length(), scaled(13.0, e), "times 2^{e}");
            let off = v.normalised() - Vec3::new(3.0 / 13.0, -4.0 / 13.0, 12.0 / 13.0);
            assert!(off.abs().max_element() <= f64::EPSILON, "times 2^{e}");
        }
        assert_eq!(Vec3::new(3e-30f32, 0.0, 4e-30).length(), 5e-30);
        assert_eq!(Vec3::<f64>::ZERO.length(), 0.0);
        assert!(Vec3::<f64>::ZERO.normalised().x.is_nan());
    }
}
