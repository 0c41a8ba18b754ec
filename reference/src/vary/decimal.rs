//! Numbers as written in a file: whole units of a power of ten. Sums are exact, short, and the same
//! on every machine.

use std::fmt;

use toml_edit::Value;

use crate::numbers::stream::Stream;

/// Least number of possible moves to either side within a bound.
const LEAST_MOVES: f64 = 20.0;
/// Largest number of decimals of a move.
const MOST_DECIMALS: u32 = 12;

/// The number units · 10^−decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimal {
    units: i128,
    decimals: u32,
}

impl Decimal {
    /// The number 0, which moves nothing.
    pub(super) const ZERO: Self = Self { units: 0, decimals: 0 };

    /// Returns the number in a file, or `None` if the value is no finite number or has too many
    /// digits.
    pub(super) fn of(value: &Value) -> Option<Self> {
        let number = value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))?;
        // Rust prints the shortest digits that give the same number again, and never an exponent.
        let text = number.to_string();
        let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
        let units = format!("{whole}{fraction}").parse().ok()?;
        Some(Self { units, decimals: u32::try_from(fraction.len()).ok()? })
    }

    /// Returns a random move by at most `bound` either way; 0 if the bound is 0.
    pub(super) fn drawn(bound: f64, stream: &mut Stream) -> Self {
        let (mut decimals, mut scale) = (0, 1.0);
        while bound * scale < LEAST_MOVES && decimals < MOST_DECIMALS {
            (decimals, scale) = (decimals + 1, scale * 10.0); // powers of ten up to 10²² are exact
        }
        let most = (bound * scale).floor().clamp(0.0, f64::from(u32::MAX)) as u32;
        Self { units: i128::from(stream.within(most)), decimals }.shortened()
    }

    /// Returns the nearest floating-point number.
    pub(super) fn get(self) -> f64 {
        self.to_string().parse().unwrap_or(f64::NAN)
    }

    /// Returns the sum, or `None` if it has too many digits.
    pub(super) fn plus(self, other: Self) -> Option<Self> {
        let decimals = self.decimals.max(other.decimals);
        let units = self.scaled(decimals)?.checked_add(other.scaled(decimals)?)?;
        Some(Self { units, decimals }.shortened())
    }

    /// Returns the product, or `None` if it has too many digits.
    pub(super) fn times(self, other: Self) -> Option<Self> {
        let units = self.units.checked_mul(other.units)?;
        Some(Self { units, decimals: self.decimals + other.decimals }.shortened())
    }

    fn scaled(self, decimals: u32) -> Option<i128> {
        10i128.checked_pow(decimals - self.decimals)?.checked_mul(self.units)
    }

    fn shortened(mut self) -> Self {
        while self.decimals > 0 && self.units % 10 == 0 {
            self = Self { units: self.units / 10, decimals: self.decimals - 1 };
        }
        self
    }

    /// Returns the number as a value for a file. Whole numbers have no decimal point.
    pub(super) fn written(self) -> Value {
        match (self.decimals, i64::try_from(self.units)) {
            (0, Ok(whole)) => Value::from(whole),
            _ => Value::from(self.get()),
        }
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.units < 0 { "-" } else { "" };
        let decimals = self.decimals as usize;
        let digits = format!("{:0>1$}", self.units.unsigned_abs(), decimals + 1);
        let (whole, fraction) = digits.split_at(digits.len() - decimals);
        if fraction.is_empty() {
            write!(f, "{sign}{whole}")
        } else {
            write!(f, "{sign}{whole}.{fraction}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(text: &str) -> Decimal {
        Decimal::of(&text.parse().unwrap()).unwrap()
    }

    #[test]
    fn sums_and_products_are_exact_and_short() {
        let table = [
            ("0.1", "0.2", "0.3", "0.02"),
            ("-0.8001", "0.0001", "-0.8", "-0.00008001"),
            ("3", "-3", "0", "-9"),
            ("1e-3", "0.02", "0.021", "0.00002"),
            ("-0.05", "0.01", "-0.04", "-0.0005"),
            ("2.50", "2", "4.5", "5"),
        ];
        for (a, b, sum, product) in table {
            assert_eq!(decimal(a).plus(decimal(b)).unwrap().to_string(), sum, "{a} + {b}");
            assert_eq!(decimal(a).times(decimal(b)).unwrap().to_string(), product, "{a} · {b}");
        }
    }

    #[test]
    fn numbers_of_too_many_digits_are_no_sum() {
        assert_eq!(decimal("1e18").plus(decimal("1e-30")), None);
        assert_eq!(
            decimal("1.2345678901234567e30").times(decimal("1.2345678901234567e30")).map(|_| ()),
            None
        );
        assert_eq!(Decimal::of(&Value::from("text")), None);
        assert_eq!(Decimal::of(&Value::from(f64::INFINITY)), None);
    }

    #[test]
    fn moves_stay_within_their_bound_and_have_few_decimals() {
        let mut stream = Stream::new(1, "moves");
        for (bound, decimals) in [(0.0, 0), (0.05, 3), (0.29, 2), (3.0, 1), (25.0, 0), (0.0004, 5)]
        {
            let moves: Vec<Decimal> =
                (0..500).map(|_| Decimal::drawn(bound, &mut stream)).collect();
            let farthest = moves.iter().map(|by| by.get().abs()).fold(0.0, f64::max);
            assert!(farthest <= bound && farthest >= 0.8 * bound, "{bound}: {farthest}");
            assert!(moves.iter().all(|by| by.decimals <= decimals), "{bound}");
        }
    }

    #[test]
    fn is_written_as_people_write() {
        for text in ["0.125", "-3", "0.0001", "12.5"] {
            assert_eq!(decimal(text).written().to_string(), text);
        }
    }
}
