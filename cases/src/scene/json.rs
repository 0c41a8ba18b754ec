//! The JSON form of the resolved scene: plain numbers, matrices as four rows of four, read without losing a bit.

use crate::scene::Scene;

/// The scene as JSON text.
pub fn to_string(scene: &Scene) -> String {
    serde_json::to_string_pretty(scene).expect("a resolved scene holds only finite numbers and string keys")
}

/// The scene that `text` holds.
///
/// # Errors
/// What is missing, unknown or of the wrong kind, with line and column.
pub fn from_str(text: &str) -> Result<Scene, serde_json::Error> {
    serde_json::from_str(text)
}

/// An affine map as four rows of four numbers, the last one 0 0 0 1.
pub(crate) mod affine {
    use glam::{DAffine3, DMat4};
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    /// Rows, top to bottom.
    pub(crate) fn serialize<S: Serializer>(map: &DAffine3, out: S) -> Result<S::Ok, S::Error> {
        DMat4::from(*map).transpose().to_cols_array_2d().serialize(out)
    }

    /// Fails where the last row is not 0 0 0 1.
    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<DAffine3, D::Error> {
        let rows = <[[f64; 4]; 4]>::deserialize(input)?;
        if rows[3] != [0.0, 0.0, 0.0, 1.0] {
            return Err(D::Error::custom("the last row of a matrix must be [0, 0, 0, 1]"));
        }
        Ok(DAffine3::from_mat4(DMat4::from_cols_array_2d(&rows).transpose()))
    }
}
