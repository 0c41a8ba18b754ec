//! The JSON form of the resolved scene: plain numbers, matrices as four rows of four, read without
//! losing a bit.

use crate::scene::Scene;

/// The scene as JSON text.
pub fn to_string(scene: &Scene) -> String {
    serde_json::to_string_pretty(scene)
        .expect("a resolved scene holds only finite numbers and string keys")
}

/// The scene that `text` holds.
///
/// # Errors
/// What is missing, unknown or of the wrong kind, with line and column.
pub fn from_str(text: &str) -> Result<Scene, serde_json::Error> {
    serde_json::from_str(text)
}
