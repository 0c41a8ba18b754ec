//! Numbers of a file, each of a type with its own precondition: a number that was read needs no
//! further check.

use std::borrow::Cow;

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use toml::de::DeValue;

use super::read::{Notes, Read, Value};

/// Greatest absolute value of a number. Its square fits single precision, which tracers may use.
pub(crate) const MAX_NUMBER: f64 = 1e18;

/// Reads a number of at most [`MAX_NUMBER`] in absolute value. Messages call it `wanted`.
pub(crate) fn finite(value: &Value<'_>, wanted: &str, notes: &mut Notes) -> Option<f64> {
    let number = match value.get_ref() {
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(|n| n as f64)
        }
        DeValue::Float(float) => float.as_str().parse().ok(),
        _ => {
            notes.wrong(value, wanted);
            return None;
        }
    };
    let number = number.filter(|n: &f64| n.abs() <= MAX_NUMBER);
    if number.is_none() {
        let label = format!("expected {wanted}, at most {MAX_NUMBER:e} in absolute value");
        notes.add(value.span(), "this number cannot be used", label);
    }
    number
}

/// Declares types of numbers, each with its name in messages, its condition, and its JSON Schema.
macro_rules! numbers {
    ($($(#[$meta:meta])* $name:ident($wanted:literal, $holds:expr, $schema:tt)),* $(,)?) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) struct $name(f64);

        impl $name {
            pub(crate) fn get(self) -> f64 {
                self.0
            }
        }

        impl Read for $name {
            fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
                let number = finite(value, $wanted, notes)?;
                let holds: fn(f64) -> bool = $holds;
                if !holds(number) {
                    let message = concat!("this is not ", $wanted);
                    notes.add(value.span(), message, concat!("expected ", $wanted));
                    return None;
                }
                Some(Self(number))
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!($schema)
            }
        }
    )*};
}

numbers! {
    /// Any number.
    Number("a number", |_| true, { "type": "number" }),
    /// A factor other than 0.
    Factor("a number other than 0", |x| x.abs() >= 1.0 / MAX_NUMBER, {
        "type": "number", "not": { "const": 0 }
    }),
    /// A length.
    Size("a number above 0", |x| x >= 1.0 / MAX_NUMBER, {
        "type": "number", "exclusiveMinimum": 0
    }),
    /// A coefficient.
    NonNegative("a number of at least 0", |x| x >= 0.0, { "type": "number", "minimum": 0 }),
    /// A share, above 0 and below 1.
    Share(
        "a share above 0 and below 1",
        |x| x > 0.0 && x < 1.0,
        { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1 }
    ),
    /// A share of the points of a wrong picture.
    PartialShare(
        "a share from 0 to 0.9",
        |x| (0.0..=0.9).contains(&x),
        { "type": "number", "minimum": 0, "maximum": 0.9 }
    ),
    /// An angle of view.
    ViewAngle(
        "an angle above 0 and below 180 degrees",
        |x| x > 0.0 && x < 180.0,
        { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 180 }
    ),
}

/// Declares vector types, each with the type of its components and the function that makes it.
macro_rules! vectors {
    ($($(#[$meta:meta])* $name:ident of $number:ident, $make:expr),* $(,)?) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) struct $name(DVec3);

        impl $name {
            pub(crate) fn get(self) -> DVec3 {
                self.0
            }
        }

        impl Read for $name {
            fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
                let three = <[$number; 3]>::read(value, notes)?.map($number::get);
                let make: fn(DVec3) -> Result<DVec3, &'static str> = $make;
                match make(DVec3::from_array(three)) {
                    Ok(vector) => Some(Self(vector)),
                    Err(why) => {
                        notes.add(value.span(), why, "its length is 0");
                        None
                    }
                }
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                <[$number; 3]>::json_schema(generator)
            }
        }
    )*};
}

vectors! {
    /// A position or a displacement.
    Point of Number, Ok,
    /// A direction of any length but zero, which is not normalised.
    Travel of Number,
        |v| if v == DVec3::ZERO { Err("a direction cannot be the zero vector") } else { Ok(v) },
    /// A direction, which is normalised.
    Direction of Number, |v| unit(v).ok_or("a direction cannot be the zero vector"),
    /// Linear RGB.
    Colour of NonNegative, Ok,
    /// A length for each axis, not all of them 0.
    Reaches of NonNegative,
        |v| if v == DVec3::ZERO { Err("this moves nothing: leave it out") } else { Ok(v) },
    /// A factor for each axis.
    Factors of Factor, Ok,
}

/// Returns the unit vector along `v`, or `None` if its largest component is 0 or not finite.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if v.length() == 1.0 {
        // A unit vector in a file is kept to the last bit.
        return Some(v);
    }
    (largest > 0.0 && largest.is_finite()).then(|| (v / largest).normalize())
}

/// Reads a whole number from `least` to `most`.
pub(crate) fn whole(value: &Value<'_>, least: u64, most: u64, notes: &mut Notes) -> Option<u64> {
    let wanted = format!("a whole number from {least} to {most}");
    let DeValue::Integer(integer) = value.get_ref() else {
        notes.wrong(value, &wanted);
        return None;
    };
    let number = u64::from_str_radix(integer.as_str(), integer.radix()).ok();
    let number = number.filter(|n| (least..=most).contains(n));
    if number.is_none() {
        notes.add(value.span(), format!("this is not {wanted}"), format!("expected {wanted}"));
    }
    number
}

/// Declares types of whole numbers, each with its least and its greatest value.
macro_rules! counts {
    ($($(#[$meta:meta])* $name:ident($type:ty, $least:expr, $most:expr)),* $(,)?) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) struct $name(pub(crate) $type);

        impl Read for $name {
            fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
                whole(value, $least, $most, notes).and_then(|n| <$type>::try_from(n).ok()).map(Self)
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "type": "integer", "minimum": $least, "maximum": $most })
            }
        }
    )*};
}

counts! {
    /// Pixels in a row, or rows.
    Side(u32, 1, 16384),
    /// Depth of recursion. No picture shows a path that is longer than the greatest depth.
    Depth(u32, 0, 64),
    /// An index into a list.
    Index(u32, 0, u64::from(u32::MAX)),
    /// The number of a rule of light.
    Rule(u8, 1, 25),
}

/// Points, in thousandths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Points(pub(crate) u64);

impl Read for Points {
    fn read(value: &Value<'_>, notes: &mut Notes) -> Option<Self> {
        let text = match value.get_ref() {
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
            DeValue::Float(float) => float.as_str(),
            _ => {
                notes.wrong(value, "a number of points");
                return None;
            }
        };
        let points = thousandths(text);
        if points.is_none() {
            let label = "expected a number from 0 to 1000 with at most three decimals";
            notes.add(value.span(), "these points cannot be counted", label);
        }
        points.map(Self)
    }
}

/// Returns a decimal number as it is written in thousandths, without rounding.
fn thousandths(text: &str) -> Option<u64> {
    let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
    let decimals = decimals.trim_end_matches('0');
    let digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    if !digits(whole) || !digits(decimals) || decimals.len() > 3 || whole.len() > 4 {
        return None;
    }
    let whole: u64 = whole.parse().ok()?;
    let decimals: u64 = format!("{decimals:0<3}").parse().ok()?;
    Some(whole * 1000 + decimals).filter(|points| *points <= 1_000_000)
}

impl JsonSchema for Points {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Points".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "number", "minimum": 0, "maximum": 1000 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_exact_thousandths() {
        let table = [
            ("2", Some(2000)),
            ("0.1", Some(100)),
            ("1.125", Some(1125)),
            ("1.1250", Some(1125)),
            ("1000", Some(1_000_000)),
            ("1.1255", None),
            ("1000.001", None),
            ("-1", None),
            ("1e3", None),
            ("nan", None),
        ];
        for (text, points) in table {
            assert_eq!(thousandths(text), points, "{text}");
        }
    }

    #[test]
    fn a_direction_of_any_length_has_a_unit_vector() {
        for scale in [1e-300, 1e-9, 1.0, 1e18, 1e300] {
            let found = unit(DVec3::new(3.0, 0.0, -4.0) * scale).unwrap();
            assert!((found - DVec3::new(0.6, 0.0, -0.8)).length() < 1e-15, "{scale}");
        }
        assert_eq!(unit(DVec3::ZERO), None);
    }
}
