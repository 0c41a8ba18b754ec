//! The script that most courses grade with: a clone, a build, all pictures, and a comparison by the
//! mean error of each.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use cases::scene;
use cases::stage::{Stage, load_all};

use super::copies::{edited_solution, run};
use super::usage;
use crate::workspace;

/// The processor time for each submission.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    /// Clone and build.
    pub build: Duration,
    /// All pictures, and their comparison.
    pub pictures: Duration,
}

impl Cost {
    /// Returns the sum.
    pub fn all(&self) -> Duration {
        self.build + self.pictures
    }
}

/// The scenes of all cases as files, each with its expected picture.
#[derive(Debug)]
pub struct Scenes {
    folder: tempfile::TempDir,
    expected: Vec<PathBuf>,
}

impl Scenes {
    /// Writes the scenes of all public cases.
    ///
    /// # Errors
    /// Fails if the cases cannot be read or a file cannot be written.
    pub fn write() -> Result<Self, String> {
        let stages = workspace().join("cases/stages");
        let course = cases::course::course_of(&stages).map_err(|why| why.to_string())?;
        let loaded: Vec<Stage> = load_all(&stages, &course).map_err(|why| why.to_string())?;
        let folder = tempfile::tempdir().map_err(|why| why.to_string())?;
        let mut expected = vec![];
        for (n, case) in loaded.iter().flat_map(|stage| &stage.cases).enumerate() {
            let text = scene::json::to_string(&case.scene);
            std::fs::write(folder.path().join(format!("{n}.json")), text)
                .map_err(|why| why.to_string())?;
            expected.push(stages.join(format!("{}.expected.png", case.id)));
        }
        Ok(Self { folder, expected })
    }

    /// Returns the number of scenes.
    pub fn len(&self) -> usize {
        self.expected.len()
    }

    /// Returns whether there is no scene.
    pub fn is_empty(&self) -> bool {
        self.expected.is_empty()
    }
}

/// Measures the script for `n` submissions. A `shared` target folder is warm; without one, each
/// submission has a target folder of its own.
///
/// # Errors
/// Fails if a command does. `compare` is a part of ImageMagick.
pub fn measure(scenes: &Scenes, n: usize, shared: Option<&Path>) -> Result<Cost, String> {
    if let Some(shared) = shared {
        submission(scenes, usize::MAX, Some(shared))?;
    }
    let mut sum = Cost::default();
    for copy in 0..n {
        let one = submission(scenes, copy, shared)?;
        sum = Cost { build: sum.build + one.build, pictures: sum.pictures + one.pictures };
    }
    Ok(Cost { build: sum.build / n as u32, pictures: sum.pictures / n as u32 })
}

fn submission(scenes: &Scenes, copy: usize, shared: Option<&Path>) -> Result<Cost, String> {
    let place = tempfile::tempdir().map_err(|why| why.to_string())?;
    let clone = place.path().join("clone");
    let before = usage::of_machine()?;
    run(Command::new("git")
        .args(["clone", "--quiet", "--depth=1"])
        .arg("--no-local")
        .args([workspace().as_os_str(), clone.as_os_str()]))?;
    edited_solution(copy, &clone.join("student_template")).map_err(|why| why.to_string())?;
    let target = shared.map_or_else(|| clone.join("target"), Path::to_owned);
    run(Command::new("cargo")
        .args(["build", "--release", "--locked", "--offline", "-p", "student_template"])
        .env("CARGO_TARGET_DIR", &target)
        .current_dir(&clone))?;
    let built = usage::of_machine()?;
    let program = target.join("release/student_template");
    for (n, expected) in scenes.expected.iter().enumerate() {
        let (scene, out) = (format!("{n}.json"), place.path().join(format!("{n}.png")));
        run(Command::new(&program).arg("render").arg(scenes.folder.path().join(scene)).arg(&out))?;
        // It ends with 1 if the pictures differ.
        let mut compare = Command::new("compare");
        compare.args(["-metric", "RMSE"]).arg(&out).arg(expected).arg("null:");
        let output = compare.output().map_err(|why| format!("compare (ImageMagick): {why}"))?;
        if output.status.code().is_none_or(|code| code > 1) {
            return Err(format!("{compare:?}: {}", String::from_utf8_lossy(&output.stderr)));
        }
    }
    let pictures = usage::of_machine()? - built;
    Ok(Cost { build: built - before, pictures })
}
