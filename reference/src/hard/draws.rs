//! The random numbers and vectors of the hard families. They are the same on every machine.

use cases::maths;

use crate::numbers::stream::Stream;

/// A stream of random numbers, and the range of scales for a precision.
#[derive(Debug)]
pub struct Draws {
    stream: Stream,
    /// The greatest exponent, up or down, of the power of ten by which a scene is scaled. It is the
    /// range of the precision, less a margin for products of a few lengths.
    pub decades: f64,
}

impl Draws {
    /// Returns the stream of `name` under `seed`.
    pub fn new(seed: u64, name: &str, decades: f64) -> Self {
        Self { stream: Stream::new(seed, name), decades }
    }

    /// Returns a number in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.stream.unit()
    }

    /// Returns 10 to a power in [low, high). All decades are equally likely.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        maths::pow(10.0, self.between(low, high))
    }

    /// Returns −1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.stream.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    /// Returns an integer from 0 to n − 1.
    pub fn index(&mut self, n: usize) -> usize {
        (self.stream.unit() * n as f64) as usize
    }

    /// Returns a point of the cube |x|, |y|, |z| ≤ `reach`.
    pub fn point(&mut self, reach: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-reach, reach))
    }

    /// Returns a unit vector, to the rounding of double precision.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.point(1.0);
            let squared = dot(v, v);
            if squared > 0.01 && squared <= 1.0 {
                return unit(v);
            }
        }
    }

    /// Returns a unit vector perpendicular to `v`.
    pub fn across(&mut self, v: [f64; 3]) -> [f64; 3] {
        loop {
            let out = cross(v, self.direction());
            if dot(out, out) > 0.01 * dot(v, v) {
                return unit(out);
            }
        }
    }
}

/// Returns a + b s.
pub fn along(a: [f64; 3], b: [f64; 3], s: f64) -> [f64; 3] {
    std::array::from_fn(|n| a[n] + b[n] * s)
}

/// Returns a − b.
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    along(a, b, -1.0)
}

/// Returns the dot product.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the cross product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns v/‖v‖.
pub fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stay_within_their_bounds() {
        let mut draws = Draws::new(1, "bounds", 8.0);
        for _ in 0..1000 {
            assert!((-2.0..3.0).contains(&draws.between(-2.0, 3.0)));
            assert!((1e-8..1e8).contains(&draws.power(-8.0, 8.0)));
            assert!(draws.index(3) < 3);
            let v = draws.direction();
            assert!((dot(v, v) - 1.0).abs() < 1e-15);
            assert!(dot(v, draws.across(v)).abs() < 1e-15);
        }
    }
}
