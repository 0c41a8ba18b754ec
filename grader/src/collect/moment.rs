//! Moments and spans of time: how they are read, compared and shown.

use std::fmt;

/// A moment, to the second. Fractions of a second are cut off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Moment {
    /// Seconds since 1970-01-01 00:00 UTC.
    pub unix_s: i64,
}

/// A moment with the offset of the clock that shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clock {
    /// The moment.
    pub moment: Moment,
    /// Seconds by which the clock is ahead of UTC.
    pub offset_s: i64,
}

const DAY_S: i64 = 86_400;

impl Clock {
    /// Reads a date, a time and an offset: `2026-10-05T23:59:00+02:00`, `2026-10-05 23:59 Z`.
    /// Returns `None` for anything else, also if the offset is missing.
    pub fn parse(text: &str) -> Option<Self> {
        let (date, rest) = text.split_at_checked(10)?;
        let rest = rest.strip_prefix(['T', 't', ' '])?;
        let at = rest.find(['Z', 'z', 'U', '+', '-', ' '])?;
        let (time, offset) = (&rest[..at], rest[at..].trim_start());
        let offset_s = offset_s(offset)?;
        let local_s = days(date)? * DAY_S + seconds(time)?;
        Some(Self { moment: Moment { unix_s: local_s - offset_s }, offset_s })
    }

    /// Returns `moment` as this clock shows it.
    pub fn of(self, moment: Moment) -> Self {
        Self { moment, ..self }
    }
}

/// Returns the number that a text of `length` digits holds.
fn number(text: &str, length: usize) -> Option<i64> {
    let is_number = text.len() == length && text.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then(|| text.parse().ok())?
}

/// Returns the days from 1970-01-01 to a date such as `2026-10-05`.
fn days(date: &str) -> Option<i64> {
    let mut parts = date.split('-');
    let (year, month, day) =
        (number(parts.next()?, 4)?, number(parts.next()?, 2)?, number(parts.next()?, 2)?);
    let is_date = parts.next().is_none() && (1..=12).contains(&month) && day >= 1;
    (is_date && day <= days_of_month(year, month)).then(|| days_before(year, month) + day - 1)
}

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

fn days_of_month(year: i64, month: i64) -> i64 {
    match month {
        2 => 28 + i64::from(is_leap(year)),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

/// Returns the days from 1970-01-01 to the first day of a month of the year 0 or later.
fn days_before(year: i64, month: i64) -> i64 {
    let leap_days = |year: i64| year / 4 - year / 100 + year / 400;
    // The year 0 is a leap year, which the count of the years before has to include.
    let before = |year: i64| year * 365 + if year > 0 { leap_days(year - 1) + 1 } else { 0 };
    let months: i64 = (1..month).map(|month| days_of_month(year, month)).sum();
    before(year) - before(1970) + months
}

/// Returns the seconds from midnight to a time such as `23:59` or `23:59:59.5`.
fn seconds(time: &str) -> Option<i64> {
    let (whole, fraction) = time.split_once('.').unwrap_or((time, "0"));
    let mut parts = whole.split(':');
    let (hour, minute) = (number(parts.next()?, 2)?, number(parts.next()?, 2)?);
    let second = parts.next().map_or(Some(0), |text| number(text, 2))?;
    let is_time = parts.next().is_none()
        && hour < 24
        && minute < 60
        && second < 60
        && !fraction.is_empty()
        && fraction.bytes().all(|byte| byte.is_ascii_digit());
    is_time.then_some(hour * 3600 + minute * 60 + second)
}

fn offset_s(text: &str) -> Option<i64> {
    if matches!(text, "Z" | "z" | "UTC") {
        return Some(0);
    }
    let (sign, rest) = match text.split_at_checked(1)? {
        ("+", rest) => (1, rest),
        ("-", rest) => (-1, rest),
        _ => return None,
    };
    let (hour, minute) = rest.split_once(':').or_else(|| rest.split_at_checked(2))?;
    let (hour, minute) = (number(hour, 2)?, number(minute, 2)?);
    (hour < 24 && minute < 60).then_some(sign * (hour * 3600 + minute * 60))
}

impl fmt::Display for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let local_s = self.moment.unix_s + self.offset_s;
        let (mut day, second) = (local_s.div_euclid(DAY_S), local_s.rem_euclid(DAY_S));
        let mut year = 1970 + day.div_euclid(366);
        while days_before(year, 1) > day {
            year -= 1;
        }
        while days_before(year + 1, 1) <= day {
            year += 1;
        }
        day -= days_before(year, 1);
        let mut month = 1;
        while day >= days_of_month(year, month) {
            day -= days_of_month(year, month);
            month += 1;
        }
        let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
        write!(f, "{year:04}-{month:02}-{:02} {hour:02}:{minute:02}:{second:02}", day + 1)?;
        let (sign, offset) =
            if self.offset_s < 0 { ('-', -self.offset_s) } else { ('+', self.offset_s) };
        write!(f, " {sign}{:02}:{:02}", offset / 3600, offset / 60 % 60)
    }
}

/// Reads a span of time of whole minutes, hours or days: `90 min`, `36 h`, `2 days`. Returns
/// seconds.
pub fn span_s(text: &str) -> Option<u64> {
    let text = text.trim();
    let at = text.find(|c: char| !c.is_ascii_digit())?;
    let number: u64 = text[..at].parse().ok()?;
    let unit = match text[at..].trim() {
        "min" | "minute" | "minutes" => 60,
        "h" | "hour" | "hours" => 3600,
        "d" | "day" | "days" => 86_400,
        _ => return None,
    };
    // A century is more than any course grants, and far from an overflow.
    number.checked_mul(unit).filter(|seconds| *seconds <= 100 * 366 * 86_400)
}

/// Shows a span of time in its two largest units, the rest cut off: `2 d 3 h`, `5 min`.
pub fn shown_span(seconds: u64) -> String {
    let units = [(86_400, "d"), (3600, "h"), (60, "min"), (1, "s")];
    let first = units.iter().position(|(unit, _)| seconds >= *unit).unwrap_or(units.len() - 1);
    let (unit, name) = units[first];
    let mut text = format!("{} {name}", seconds / unit);
    if let Some((smaller, name)) = units.get(first + 1)
        && seconds % unit / smaller > 0
    {
        text += &format!(" {} {name}", seconds % unit / smaller);
    }
    text
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn moments_are_read_with_their_offset() {
        for (text, unix_s) in [
            ("1970-01-01T00:00:00Z", 0),
            ("2000-02-29 23:59:59 Z", 951_868_799),
            ("2000-03-01T00:59:59+01:00", 951_868_799),
            ("2020-09-20 03:29:23.640434000 Z", 1_600_572_563),
            ("2026-10-05T23:59+02:00", 1_791_237_540),
            ("2026-10-05 23:59:00 -0330", 1_791_257_340),
            ("1969-12-31 23:59:59 UTC", -1),
        ] {
            assert_eq!(Clock::parse(text).map(|clock| clock.moment.unix_s), Some(unix_s), "{text}");
        }
    }

    #[test]
    fn what_is_no_moment_is_refused() {
        for text in [
            "",
            "2026-10-05",
            "2026-10-05 23:59",
            "2026-10-05 23:59:00",
            "2026-02-29T00:00Z",
            "2026-13-01T00:00Z",
            "2026-10-05T24:00Z",
            "2026-10-05T23:60Z",
            "2026-10-05T23:59:60Z",
            "2026-10-05T23:59 CET",
            "05.10.2026 23:59 Z",
            "2026-10-05T23:59+2",
            "2026-10-0é 23:59Z",
            "2026-10-05T23:59.Z",
            "+026-10-05T23:59Z",
            "2026-10-05T23:59+24:00",
        ] {
            assert_eq!(Clock::parse(text), None, "{text}");
        }
    }

    #[test]
    fn spans_are_read_and_shown() {
        for (text, seconds) in [
            ("90 min", Some(5400)),
            ("36h", Some(129_600)),
            (" 2 days ", Some(172_800)),
            ("1 d", Some(86_400)),
            ("0 min", Some(0)),
            ("2", None),
            ("days", None),
            ("-1 d", None),
            ("1.5 h", None),
            ("99999999999999999999 d", None),
            ("18446744073709551615 d", None),
        ] {
            assert_eq!(span_s(text), seconds, "{text}");
        }
        for (seconds, text) in [
            (0, "0 s"),
            (59, "59 s"),
            (60, "1 min"),
            (3_601, "1 h"),
            (3_660, "1 h 1 min"),
            (183_600, "2 d 3 h"),
            (172_860, "2 d"),
        ] {
            assert_eq!(shown_span(seconds), text);
        }
    }

    proptest! {
        #[test]
        fn what_is_shown_is_read(
            unix_s in -60_000_000_000_i64..200_000_000_000, quarter in -56_i64..=56,
        ) {
            let clock = Clock { moment: Moment { unix_s }, offset_s: quarter * 900 };
            prop_assert_eq!(Clock::parse(&clock.to_string()), Some(clock));
        }

        #[test]
        fn any_text_is_read_or_refused(text in any::<String>(), tail in "[0-9TZ:+. -]{0,30}") {
            let _ = (Clock::parse(&text), Clock::parse(&tail), span_s(&text), span_s(&tail));
        }
    }
}
