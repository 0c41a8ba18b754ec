//! The platform-dependent functions of mathematics, each from `libm`, so that every machine
//! computes the same bits.
//!
//! The standard library hands these to the system's C library, whose last digit differs between
//! machines; `clippy.toml` forbids them everywhere else. (`sqrt` is exact by IEEE 754 and needs no
//! such care.)

/// `x` to the power `y`.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// e to the power `x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// The natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Sine of an angle in radians.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Tangent of an angle in radians.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// The logarithm to base 10; −∞ of 0, NaN below.
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}
