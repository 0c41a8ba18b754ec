//! The JSON form of the resolved scene: plain numbers, and matrices as four rows of four. Reading
//! loses no bit.

use crate::scene::Scene;

/// Returns the scene as JSON text.
pub fn to_string(scene: &Scene) -> String {
    serde_json::to_string_pretty(scene)
        .expect("a resolved scene holds only finite numbers and string keys")
}

/// Parses a scene.
///
/// # Errors
/// A part that is missing, unknown or of the wrong kind, with line and column.
pub fn from_str(text: &str) -> Result<Scene, serde_json::Error> {
    serde_json::from_str(text)
}
