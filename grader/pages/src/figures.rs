//! Formats of measured numbers and of shares.

/// Formats a number with three significant digits, such as `1.23`, `0.00149` or `1.23e-5`.
///
/// From 1,000 to 9,999,999 the number is rounded to an integer. Smaller numbers than 0.001 and
/// greater ones have an exponent. 0 becomes `0`, infinity `inf`, and NaN `NaN`.
pub fn figure(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{x:.2e}");
    // The exponent after rounding: 9.996 has the digits of 10.0.
    let exponent =
        scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        Some(exponent @ -3..=6) => {
            let n_decimals = usize::try_from(2 - exponent).unwrap_or(0);
            format!("{x:.n_decimals$}")
        }
        _ => scientific,
    }
}

/// Formats a share in percent. A share above 0 never reads as 0 %, and a share below 1 never reads
/// as 100 %.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0 %".to_owned(),
        p if p < 0.01 => "<0.01 %".to_owned(),
        p if p < 10.0 => format!("{p:.2} %"),
        p if p < 100.0 => format!("{:.1} %", p.min(99.9)),
        p => format!("{p:.0} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        let table = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.2345e-12, "1.23e-12"),
            (1.2345e-5, "1.23e-5"),
            (9.994e-4, "9.99e-4"),
            (9.996e-4, "0.00100"),
            (0.00149, "0.00149"),
            (0.01234, "0.0123"),
            (0.1234, "0.123"),
            (0.9996, "1.00"),
            (1.2345, "1.23"),
            (-3.456, "-3.46"),
            (9.996, "10.0"),
            (12.345, "12.3"),
            (99.96, "100"),
            (123.4, "123"),
            (1234.5, "1234"),
            (827_637.0, "827637"),
            (9_440_581.0, "9440581"),
            (1.2e7, "1.20e7"),
            (2.444e14, "2.44e14"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "NaN"),
        ];
        for (x, text) in table {
            assert_eq!(figure(x), text, "{x:?}");
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
