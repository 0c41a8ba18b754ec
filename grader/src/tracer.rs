//! The reference tracer, as a program of its own beside the grader. The grader links none of it.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use cases::film::Image;
use cases::scene::Scene;
use cases::stage::Case;

use crate::exercise;

/// The wall time for a picture, after which the program is ended.
const PICTURE: Duration = Duration::from_secs(5);
/// The wall time for all pictures of a submission.
const SUBMISSION: Duration = Duration::from_secs(60);
/// The time between two looks at a program that runs.
const PAUSE: Duration = Duration::from_millis(1);

/// The program.
#[derive(Clone, Debug)]
pub struct Tracer {
    program: PathBuf,
}

impl Tracer {
    /// Returns the program `reference` in the folder of this program, or `None` if there is none.
    pub fn beside() -> Option<Self> {
        let name = format!("reference{}", std::env::consts::EXE_SUFFIX);
        let program = std::env::current_exe().ok()?.with_file_name(name);
        program.is_file().then_some(Self { program })
    }

    /// Returns the time at which the work for a submission that begins now has to end.
    pub fn end(&self) -> Instant {
        Instant::now() + SUBMISSION
    }

    /// Returns the picture of a case below `stages` by a program that makes these mistakes. `None`
    /// if the tracer fails or takes too long, or if `end` is over.
    pub fn render(
        &self,
        stages: &Path,
        case: &Case,
        mistakes: &[&str],
        end: Instant,
    ) -> Option<Image> {
        let folder = tempfile::tempdir().ok()?;
        let out = folder.path().join("picture.png");
        let child = Command::new(&self.program)
            .args(["render", "--quiet", "--mistakes", &mistakes.join(",")])
            .arg(stages.join(format!("{}.toml", case.id)))
            .arg("--output")
            .arg(&out)
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        if !has_worked(child, end.min(Instant::now() + PICTURE)) {
            return None;
        }
        let Scene { render, .. } = &case.scene;
        exercise::read(&out, render.width, render.height).ok()
    }
}

/// Waits for a program, and ends it at `end`. Returns whether it ended with exit code 0.
fn has_worked(mut child: Child, end: Instant) -> bool {
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if Instant::now() < end => sleep(PAUSE),
            _ => {
                let _ = child.kill();
                let _ = child.wait();
                return false;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_ended_when_its_time_is_over() {
        let start = |seconds: &str| Command::new("sleep").arg(seconds).spawn().unwrap();
        let soon = || Instant::now() + Duration::from_millis(50);
        assert!(!has_worked(start("1000"), soon()));
        assert!(!has_worked(Command::new("false").spawn().unwrap(), soon() + PICTURE));
        assert!(has_worked(start("0"), soon() + PICTURE));
    }
}
