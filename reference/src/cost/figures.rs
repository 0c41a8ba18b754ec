//! Formats of shares and levels in reports.

use cases::film::level;
use pages::figures::figure;

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

/// Returns linear light on the scale of 8-bit levels, without clamping.
pub fn levels(light: f64) -> f64 {
    light * level(1.0)
}

/// Formats a number with three significant digits, and with a sign unless it is 0.
pub(super) fn signed(x: f64) -> String {
    if x > 0.0 { format!("+{}", figure(x)) } else { figure(x) }
}

#[cfg(test)]
mod tests {
    use super::*;

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
