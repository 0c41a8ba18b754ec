//! Scenes for tests.

use cases::{Scene, scene};

/// Parses a scene in TOML. A default camera and an 8 × 6 picture of depth 4 are added unless the
/// text has its own.
///
/// # Panics
/// The text is not a valid scene.
pub(crate) fn scene(text: &str) -> Scene {
    let has_render = text.contains("[render]");
    let render = if has_render { "" } else { "[render]\nsize = [8, 6]\nmax_depth = 4\n" };
    let has_camera = text.contains("[scene.camera]");
    let camera =
        "[scene.camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n";
    let whole = format!("{render}{}{text}", if has_camera { "" } else { camera });
    match scene::parse("test.toml", &whole, std::path::Path::new(""), &cases::Course::default()) {
        Ok(scene) => scene,
        Err(problems) => panic!("{}", problems.render(false)),
    }
}
