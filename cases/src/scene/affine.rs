//! The JSON form of an affine map: four rows of four numbers, the last one 0 0 0 1.

use glam::{DAffine3, DMat4};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

/// Writes the four rows, from top to bottom.
pub(crate) fn serialize<S: Serializer>(map: &DAffine3, out: S) -> Result<S::Ok, S::Error> {
    DMat4::from(*map).transpose().to_cols_array_2d().serialize(out)
}

/// Reads the four rows. Fails if the last one is not 0 0 0 1.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<DAffine3, D::Error> {
    let rows = <[[f64; 4]; 4]>::deserialize(input)?;
    if rows[3] != [0.0, 0.0, 0.0, 1.0] {
        return Err(D::Error::custom("the last row of a matrix must be [0, 0, 0, 1]"));
    }
    Ok(DAffine3::from_mat4(DMat4::from_cols_array_2d(&rows).transpose()))
}
