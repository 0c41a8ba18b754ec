//! Obtains the ray tree behind a pixel from the program.

use std::path::Path;

use cases::scene::{self, Scene};

use super::allowance::Candidate;
use super::attempt::{Attempt, NEEDED, Task, attempt};
use crate::judge;
use crate::plain::shown;
use crate::sandbox::Outcome;

/// Returns what the program prints about pixel (`x`, `y`) of `scene`, made harmless to show.
///
/// # Errors
/// Returns the message for the student if the program does not end with code 0.
pub fn explain(candidate: &Candidate, scene: &Scene, x: u32, y: u32) -> Result<String, String> {
    let limits = candidate.allowance.picture;
    let prepare = |folder: &Path| {
        let input = folder.join("scene.json");
        std::fs::write(&input, scene::json::to_string(scene))?;
        Ok(vec![
            "explain".into(),
            input.into_os_string(),
            x.to_string().into(),
            y.to_string().into(),
        ])
    };
    let task = Task { limits, needed: NEEDED, stdin: &[], prepare: &prepare };
    let Attempt { finished, .. } =
        attempt(candidate, &task, &|_, finished| ((), finished.outcome == Outcome::Exited(0)));
    if finished.outcome == Outcome::Exited(0) {
        return Ok(shown(&String::from_utf8_lossy(&finished.stdout)));
    }
    let judgement = judge::todo(&finished).unwrap_or_else(|| judge::ending(&finished, &limits));
    Err(judgement.finding.map_or(String::new(), |finding| finding.message))
}
