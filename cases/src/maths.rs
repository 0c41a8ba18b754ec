//! The platform-dependent functions of mathematics, each from `libm`, so that every machine
//! computes the same bits.
//!
//! The standard library calls the system's C library, whose last digit differs between machines;
//! `clippy.toml` forbids these functions everywhere else. (`sqrt` is exact by IEEE 754 and needs no
//! such care.)

/// Returns `x` to the power `y`.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// Returns e to the power `x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Returns the natural logarithm; −∞ for 0, NaN below.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Returns the sine of an angle in radians.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Returns the cosine of an angle in radians.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Returns the tangent of an angle in radians.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Returns the logarithm to base 10; −∞ for 0, NaN below.
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}
