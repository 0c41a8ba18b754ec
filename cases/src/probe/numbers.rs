//! The JSON form of three numbers, each as in [`number`].

use glam::DVec3;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::number;

struct Out(f64);

impl Serialize for Out {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        number::serialize(&self.0, out)
    }
}

/// Writes a list of three numbers.
///
/// # Errors
/// An error of the serializer.
pub(super) fn serialize<S: Serializer>(v: &DVec3, out: S) -> Result<S::Ok, S::Error> {
    v.to_array().map(Out).serialize(out)
}

/// Reads a list of three numbers.
///
/// # Errors
/// The value is not a list of three numbers.
pub(super) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<DVec3, D::Error> {
    let [x, y, z] = <[number::Wire; 3]>::deserialize(input)?;
    Ok(DVec3::new(x.number()?, y.number()?, z.number()?))
}
