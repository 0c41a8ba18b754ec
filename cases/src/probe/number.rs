//! The JSON form of a number: infinities and NaN are the strings "inf", "-inf", "nan".

#[cfg(feature = "authoring")]
pub(crate) use schema::Number;
use serde::{Deserialize, Deserializer, Serializer, de::Error};

#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum Wire {
    Finite(f64),
    Word(String),
}

impl Wire {
    pub(super) fn number<E: Error>(self) -> Result<f64, E> {
        match self {
            Self::Finite(number) => Ok(number),
            Self::Word(word) => match word.as_str() {
                "inf" => Ok(f64::INFINITY),
                "-inf" => Ok(f64::NEG_INFINITY),
                "nan" => Ok(f64::NAN),
                _ => Err(E::custom(
                    "a number must be a JSON number or one of \"inf\", \"-inf\", \"nan\"",
                )),
            },
        }
    }
}

pub(super) fn word(number: f64) -> Option<&'static str> {
    match number {
        n if n.is_nan() => Some("nan"),
        f64::INFINITY => Some("inf"),
        f64::NEG_INFINITY => Some("-inf"),
        _ => None,
    }
}

/// Writes the number, or its word if it is not finite.
///
/// # Errors
/// An error of the serializer.
pub(crate) fn serialize<S: Serializer>(number: &f64, out: S) -> Result<S::Ok, S::Error> {
    match word(*number) {
        Some(word) => out.serialize_str(word),
        None => out.serialize_f64(*number),
    }
}

/// Reads a number or one of the three words.
///
/// # Errors
/// The value is neither.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<f64, D::Error> {
    Wire::deserialize(input)?.number()
}

/// The JSON Schema of a number.
#[cfg(feature = "authoring")]
mod schema {
    use std::borrow::Cow;

    use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

    /// A number that may be infinite or NaN, for which JSON has no literals, so that they are
    /// strings.
    pub(crate) struct Number;

    impl JsonSchema for Number {
        fn inline_schema() -> bool {
            true
        }

        fn schema_name() -> Cow<'static, str> {
            "Number".into()
        }

        fn json_schema(_: &mut SchemaGenerator) -> Schema {
            json_schema!({ "anyOf": [{ "type": "number" }, { "enum": ["inf", "-inf", "nan"] }] })
        }
    }
}
