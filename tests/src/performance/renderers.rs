//! The renderers that are compared, the commands that run them, and the parsers of their output.

use std::path::{Path, PathBuf};
use std::process::Command;

use cases::Scene;
use cases::glam::DVec3;
use serde_json::Value;

use super::child::{self, Spent};
use super::export::{self, File};
use crate::workspace;

/// A renderer of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "their names say it")]
pub enum Renderer {
    Ours,
    Pov,
    Tachyon,
    MitsubaLlvm,
    MitsubaScalar,
}

/// The cost of one picture.
#[derive(Clone, Debug)]
pub struct Took {
    /// The CPU seconds of rendering alone. Tachyon reports only wall time, which is capped by the
    /// CPU time of the process.
    pub render_s: f64,
    /// The seconds of reading the scene, if the renderer reports them.
    pub read_s: Option<f64>,
    /// The number of eye, shadow, reflected and refracted rays, if the renderer counts them.
    pub rays: Option<[u64; 4]>,
    /// The time and the output of the whole process.
    pub spent: Spent,
}

impl Renderer {
    /// All renderers, ours first.
    pub const ALL: [Self; 5] =
        [Self::Ours, Self::Pov, Self::Tachyon, Self::MitsubaLlvm, Self::MitsubaScalar];

    /// Returns the name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ours => "this reference",
            Self::Pov => "POV-Ray",
            Self::Tachyon => "Tachyon",
            Self::MitsubaLlvm => "Mitsuba 3, LLVM",
            Self::MitsubaScalar => "Mitsuba 3, scalar",
        }
    }

    /// Returns the precision of its arithmetic.
    pub fn precision(self) -> &'static str {
        if matches!(self, Self::MitsubaLlvm | Self::MitsubaScalar) { "f32" } else { "f64" }
    }

    /// Returns the reason why its picture of `scene` is less work than ours, if it is.
    pub fn easier(self, scene: &Scene) -> Option<&'static str> {
        let any = |of: fn(&cases::Material) -> DVec3| {
            scene.materials.iter().any(|m| of(m) != DVec3::ZERO)
        };
        let refracts = any(|m| m.kt) && scene.render.max_depth > 0;
        let spawns = refracts || (any(|m| m.kr) && scene.render.max_depth > 0);
        let is_moved = scene.objects.iter().any(|object| !object.is_untransformed());
        match self {
            Self::Ours | Self::Pov => None,
            Self::Tachyon if refracts => Some("no refraction: rays go straight through glass"),
            Self::MitsubaLlvm | Self::MitsubaScalar if spawns => {
                Some("one branch at random, reflected or refracted")
            }
            _ if is_moved => Some("spheres instead of ellipsoids"),
            _ => None,
        }
    }

    /// Returns whether the renderer is run on `scene`. Tachyon is not run on a large mesh of glass,
    /// which takes a minute and which it does not refract.
    pub fn is_run(self, scene: &Scene) -> bool {
        let has_large_mesh = scene.meshes.iter().any(|mesh| mesh.triangles.len() > 10_000);
        self != Self::Tachyon || self.easier(scene).is_none() || !has_large_mesh
    }

    /// Returns the scene in the renderer's own format. The list is empty for ours, which reads the
    /// files as they are.
    ///
    /// # Errors
    /// Returns the errors of the exporters.
    pub fn export(self, scene: &Scene) -> Result<Vec<File>, String> {
        match self {
            Self::Ours => Ok(vec![]),
            Self::Pov => export::pov::export(scene),
            Self::Tachyon => export::tachyon::export(scene),
            Self::MitsubaLlvm | Self::MitsubaScalar => export::mitsuba::export(scene),
        }
    }

    /// Renders one picture on `threads` threads. `scene` is our file. `folder` holds the exported
    /// files, and receives the picture.
    ///
    /// # Errors
    /// Returns an error if the renderer is missing or fails, or if its output lacks the expected
    /// numbers.
    pub fn render(
        self,
        peers: &Path,
        scene: &Path,
        folder: &Path,
        threads: usize,
    ) -> Result<Took, String> {
        let mut command = self.command(peers, scene, threads)?;
        let spent = child::run(command.current_dir(folder), folder)?;
        let silent = || format!("the output of {} lacks its times:\n{}", self.name(), spent.said);
        let took = |render_s, read_s, rays| Took { render_s, read_s, rays, spent: spent.clone() };
        match self {
            Self::Pov => {
                pov(&spent.said).map(|(render_s, read_s, rays)| took(render_s, read_s, Some(rays)))
            }
            // Tachyon reports wall time, which must not count the time that other processes took.
            Self::Tachyon => tachyon(&spent.said)
                .map(|(render_s, read_s)| took(render_s.min(spent.cpu_s), Some(read_s), None)),
            _ => json(&spent.said).map(|(render_s, read_s, rays)| took(render_s, read_s, rays)),
        }
        .ok_or_else(silent)
    }

    fn command(self, peers: &Path, scene: &Path, threads: usize) -> Result<Command, String> {
        let n = threads.to_string();
        let mut command = match self {
            Self::Ours => Command::new(std::env::current_exe().map_err(|why| why.to_string())?),
            Self::Pov => Command::new("povray"),
            Self::Tachyon => Command::new("tachyon"),
            Self::MitsubaLlvm | Self::MitsubaScalar => Command::new(peers.join("venv/bin/python")),
        };
        match self {
            Self::Ours => command.args(["--worker", "render"]).arg(scene).arg(n),
            Self::Pov => {
                let size = cases::stage::load_scene(scene, &cases::Course::default())
                    .map_err(|why| why.to_string())?
                    .render;
                let (width, height) = (format!("+W{}", size.width), format!("+H{}", size.height));
                command.args([
                    "+Iscene.pov",
                    "+Oout.png",
                    "+FN8",
                    "-D",
                    "-A",
                    "+GS",
                    &width,
                    &height,
                    &format!("+WT{n}"),
                ])
            }
            Self::Tachyon => {
                command.args(["scene.dat", "-o", "out.png", "-format", "PNG", "-numthreads", &n])
            }
            Self::MitsubaLlvm | Self::MitsubaScalar => {
                let variant = if self == Self::MitsubaLlvm { "llvm_ad_rgb" } else { "scalar_rgb" };
                let script = workspace().join("tests/peers/renderers/mitsuba_render.py");
                command.env("DRJIT_LIBLLVM_PATH", peers.join("libLLVM.so"));
                command.arg(script).args([variant, "scene.xml", &n, "out.png"])
            }
        };
        Ok(command)
    }
}

/// Returns the folder in which the peers are installed.
pub fn peers() -> PathBuf {
    workspace().join("target/renderers")
}

/// Returns the number after the first `label` in the output.
fn after(said: &str, label: &str) -> Option<f64> {
    let rest = said.split_once(label)?.1.trim_start();
    rest.split(|c: char| !(c.is_ascii_digit() || c == '.')).next()?.parse().ok()
}

/// Returns the CPU seconds of tracing and of parsing, and the numbers of rays, from POV-Ray's
/// statistics.
fn pov(said: &str) -> Option<(f64, Option<f64>, [u64; 4])> {
    let cpu_s = |label: &str| after(said.split_once(label)?.1, "thread(s) with");
    let count = |label: &str| after(said, label).map_or(0, |n| n as u64);
    let refracted = count("Refracted Rays:") + count("Transmitted Rays:");
    let rays = [count("Pixels:"), count("Shadow Ray Tests:"), count("Reflected Rays:"), refracted];
    Some((cpu_s("Trace Time:")?, cpu_s("Parse Time:"), rays))
}

/// Returns the wall time of tracing and of reading, in seconds.
fn tachyon(said: &str) -> Option<(f64, f64)> {
    Some((after(said, "Ray Tracing Time:")?, after(said, "Scene Parsing Time:")?))
}

type Reported = (f64, Option<f64>, Option<[u64; 4]>);

/// Parses the last line that our own worker and our script for Mitsuba print.
fn json(said: &str) -> Option<Reported> {
    let reported: Value = serde_json::from_str(said.lines().last()?).ok()?;
    let count = |key: &str| reported[key].as_u64();
    let rays = ["eye", "shadow", "reflected", "refracted"].map(count);
    let rays = rays.iter().all(Option::is_some).then(|| rays.map(Option::unwrap_or_default));
    Some((reported["render_cpu_s"].as_f64()?, reported["read_s"].as_f64(), rays))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_renderers_say_of_themselves_is_understood() {
        let said = "Parse Time:       0 hours  0 minutes  0 seconds (0.002 \
            seconds)\n              using 1 thread(s) with 0.001 CPU-seconds total\n\
             Pixels:           307200   Samples:               0\n\
             Rays:             817947   Saved:   0\n\
             Shadow Ray Tests:            599469   Succeeded:                192376\n\
             Reflected Rays:              270400\n\
             Refracted Rays:              240347\n\
             Trace Time:       0 hours  0 minutes  0 seconds (0.331 seconds)\n\
             using 1 thread(s) with 0.299 CPU-seconds total";
        assert_eq!(pov(said), Some((0.299, Some(0.001), [307_200, 599_469, 270_400, 240_347])));
        assert_eq!(
            tachyon(
                "Scene Parsing Time:     0.2944 seconds\n  Ray Tracing Time:     0.5661 seconds"
            ),
            Some((0.5661, 0.2944))
        );
        let ours = r#"{"render_cpu_s": 0.5, "read_s": 0.25, "eye": 4, "shadow": 3, "reflected": 2, "refracted": 1}"#;
        assert_eq!(json(ours), Some((0.5, Some(0.25), Some([4, 3, 2, 1]))));
        assert_eq!(
            json(r#"warning\n{"render_cpu_s": 0.5, "read_s": 0.25}"#.replace("\\n", "\n").as_str()),
            Some((0.5, Some(0.25), None))
        );
        assert_eq!((pov("error"), tachyon("error"), json("error")), (None, None, None));
    }
}
