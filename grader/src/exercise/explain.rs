//! The tree of rays behind a pixel, as the program tells it.

use cases::scene::{self, Scene};

use super::{Candidate, run};
use crate::judge;
use crate::plain::shown;
use crate::sandbox::{Folder, Outcome};

/// What the program prints about pixel (x, y), or what kept it from that.
///
/// # Errors
/// A folder that cannot be made: the machine's fault.
pub fn explain(candidate: &Candidate, scene: &Scene, x: u32, y: u32) -> std::io::Result<Result<String, String>> {
    let folder = Folder::new()?;
    let input = folder.path().join("scene.json");
    std::fs::write(&input, scene::json::to_string(scene))?;
    let args = ["explain".into(), input.into_os_string(), x.to_string().into(), y.to_string().into()];
    let finished = run(candidate.program, &args, folder.path(), vec![], candidate.allowance.picture);
    if finished.outcome == Outcome::Exited(0) {
        return Ok(Ok(shown(&String::from_utf8_lossy(&finished.stdout))));
    }
    let judgement = judge::todo(&finished).unwrap_or_else(|| judge::ending(&finished, &candidate.allowance.picture));
    Ok(Err(judgement.finding.map_or(String::new(), |finding| finding.message)))
}
