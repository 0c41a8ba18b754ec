//! Numbers as reports print them.

use cases::film::level;

/// Writes three significant digits; small and large numbers with an exponent.
pub fn figure(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        a if !(1e-3..1e7).contains(&a) => format!("{x:.1e}"),
        a if a < 1.0 => format!("{x:.3}"),
        a if a < 10.0 => format!("{x:.2}"),
        a if a < 100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

/// Writes a share in percent; what is above 0 never reads as 0, and what is below 1 never as all.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0 %".to_owned(),
        p if p < 0.01 => "<0.01 %".to_owned(),
        p if p < 10.0 => format!("{p:.2} %"),
        p if p < 100.0 => format!("{:.1} %", p.min(99.9)),
        p => format!("{p:.0} %"),
    }
}

/// Returns linear light on the scale of 8-bit levels, without an end.
pub fn levels(light: f64) -> f64 {
    light * level(1.0)
}

/// Writes three significant digits, with a sign unless the number is 0.
pub(super) fn signed(x: f64) -> String {
    if x > 0.0 { format!("+{}", figure(x)) } else { figure(x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        for (x, text) in [
            (0.0, "0"),
            (1.2345e-5, "1.2e-5"),
            (0.01234, "0.012"),
            (1.2345, "1.23"),
            (12.345, "12.3"),
            (1234.5, "1234"),
            (1.2e8, "1.2e8"),
            (-3.456, "-3.46"),
        ] {
            assert_eq!(figure(x), text);
        }
    }

    #[test]
    fn a_share_is_all_or_nothing_only_where_it_is() {
        for (share, text) in [
            (0.0, "0 %"),
            (1e-6, "<0.01 %"),
            (0.01234, "1.23 %"),
            (0.5, "50.0 %"),
            (0.99999, "99.9 %"),
            (1.0, "100 %"),
        ] {
            assert_eq!(percent(share), text);
        }
    }
}
