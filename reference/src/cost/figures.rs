//! Formats of levels and of numbers with a sign in reports.

use cases::film::level;
use pages::figures::figure;

/// Returns linear light on the scale of 8-bit levels, without clamping.
pub fn levels(light: f64) -> f64 {
    light * level(1.0)
}

/// Formats a number with three significant digits, and with a sign unless it is 0.
pub fn signed(x: f64) -> String {
    if x > 0.0 { format!("+{}", figure(x)) } else { figure(x) }
}

/// Rounds a number to three digits, so that two numbers that print alike count as equal.
pub fn three_digits(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}
