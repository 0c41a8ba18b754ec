//! Formats of numbers in messages.

/// Formats a count with grouped thousands: 19200 becomes `19,200`.
pub(super) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Formats a share in percent: 0.023 becomes `2.3 %`.
pub(super) fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

/// Formats a number with nine significant digits, without trailing zeros and without a minus before
/// zero.
pub(super) fn short(x: f64) -> String {
    if !x.is_finite() || x == 0.0 {
        return (x + 0.0).to_string();
    }
    let scientific = format!("{x:.8e}");
    let rounded: f64 = scientific.parse().unwrap_or(x);
    if (1e-5..1e15).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_grouped() {
        for (n, text) in
            [(0, "0"), (999, "999"), (1000, "1,000"), (19200, "19,200"), (1_234_567, "1,234,567")]
        {
            assert_eq!(grouped(n), text);
        }
    }

    #[test]
    fn nine_digits_are_shown() {
        let table = [
            (1.5, "1.5"),
            (-0.0, "0"),
            (1.0 / 3.0, "0.333333333"),
            (0.1 + 0.2, "0.3"),
            (1e-9, "1e-9"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
            (123_456_789_012.0, "123456789000"),
        ];
        for (x, text) in table {
            assert_eq!(short(x), text, "{x:?}");
        }
    }
}
