//! Instruction counts of the reference on a fixed set of scenes, by callgrind, compared with the
//! budget in `tests/instructions.toml`.
//!
//! Seconds are noise on a machine that does other work. The instructions of one thread are the same
//! in every run, up to a few thousand. They are also the same on every machine of one architecture,
//! because valgrind emulates the same processor everywhere.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::workspace;

/// The relative distance that a count may have from its budget. A larger count is slower code; a
/// smaller one means a stale budget, which would hide the next regression.
const SLACK: f64 = 0.03;
/// The command that lowers or raises the budget.
const WAY_OUT: &str = "cargo run --release -p tests --bin instructions -- --bless";
/// The head of the file.
const HEAD: &str = "# Instructions of `reference render SCENE -o OUT.png --threads 1`, the whole \
    process, by callgrind. Written by\n# `";

/// The budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// The compiler and the target of the code that was counted.
    pub toolchain: String,
    /// The scenes that are counted.
    pub scene: Vec<Scene>,
}

/// A scene and its budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The name as `reference render` takes it: the id of a case, or a file of the workspace.
    pub name: String,
    /// The width and height, such as `160x120`; the scene's own if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<String>,
    /// The set of formulas, such as `plain`; the reference's own if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formulas: Option<String>,
    /// The budget in instructions; 0 if the scene was never counted.
    pub instructions: u64,
}

impl Scene {
    /// Returns the name, with the formulas if they are not the reference's own.
    pub fn title(&self) -> String {
        self.formulas
            .as_ref()
            .map_or_else(|| self.name.clone(), |formulas| format!("{} by {formulas}", self.name))
    }

    /// Returns a complaint if the count `found` is too far from the budget, or if there is no
    /// budget.
    pub fn complaint(&self, found: u64) -> Option<String> {
        let share = found as f64 / self.instructions as f64 - 1.0;
        let (name, budget) = (self.title(), self.instructions);
        if budget == 0 {
            return Some(format!("{name}: {found} instructions, and no budget yet"));
        }
        let by = format!(
            "{name}: {found} instructions for a budget of {budget}, {:+.1} %",
            100.0 * share
        );
        match share {
            share if share > SLACK => Some(format!("{by}: slower")),
            share if share < -SLACK => {
                Some(format!("{by}: faster, so a stale budget would hide the next regression"))
            }
            _ => None,
        }
    }
}

/// Returns the path of the budget.
pub fn path() -> PathBuf {
    workspace().join("tests/instructions.toml")
}

/// Parses a budget.
///
/// # Errors
/// Returns the message of the TOML parser.
pub fn parse(text: &str) -> Result<Budget, String> {
    toml::from_str(text).map_err(|why| why.to_string())
}

/// Returns the text of a budget.
///
/// # Errors
/// Returns the message of the TOML writer.
pub fn to_text(budget: &Budget) -> Result<String, String> {
    let body = toml::to_string(budget).map_err(|why| why.to_string())?;
    Ok(format!("{HEAD}{WAY_OUT}`, which keeps the list of scenes.\n\n{body}"))
}

/// Returns the complaints about `counts`, one count for every scene in order. Empty if there are
/// none.
pub fn complaints(budget: &Budget, counts: &[u64], toolchain: &str) -> String {
    let found: Vec<String> = budget
        .scene
        .iter()
        .zip(counts)
        .filter_map(|(scene, count)| scene.complaint(*count))
        .collect();
    if found.is_empty() {
        return String::new();
    }
    let mut text = found.join("\n");
    if budget.toolchain != toolchain {
        let _ = write!(
            text,
            "\nthe budget is of {}, this is {toolchain}; this alone may be the reason",
            budget.toolchain
        );
    }
    let _ = write!(text, "\nto accept the new counts: {WAY_OUT}");
    text
}

/// Returns the version and the host of the compiler.
///
/// # Errors
/// Returns an error if `rustc` cannot be run.
pub fn toolchain() -> Result<String, String> {
    let said = run(Command::new("rustc").arg("-vV"))?;
    let line = |start: &str| {
        said.lines().find_map(|line| line.strip_prefix(start)).unwrap_or("unknown").to_owned()
    };
    Ok(format!("rustc {}, {}", line("rustc "), line("host: ")))
}

/// Builds the reference, and returns the path of the program.
///
/// # Errors
/// Returns an error if cargo cannot be run or the build fails.
pub fn build() -> Result<PathBuf, String> {
    let cargo = Command::new("cargo")
        .args([
            "build",
            "--release",
            "--locked",
            "-p",
            "tests",
            "-p",
            "reference",
            "--bin",
            "reference",
            "--message-format=json",
        ])
        .current_dir(workspace())
        .stderr(std::process::Stdio::inherit())
        .output()
        .map_err(|why| format!("cargo cannot be run: {why}"))?;
    let messages = String::from_utf8_lossy(&cargo.stdout);
    let program =
        messages.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let program = program
        .filter_map(|message| Some(PathBuf::from(message.get("executable")?.as_str()?)))
        .next_back();
    match program {
        Some(program) if cargo.status.success() => Ok(program),
        _ => Err("the reference does not build".to_owned()),
    }
}

/// Returns the number of instructions that `program` executes to render the scene. Files go into
/// `folder`.
///
/// # Errors
/// Returns an error if valgrind is missing, the program fails, or the output has no count.
pub fn count(program: &Path, scene: &Scene, folder: &Path) -> Result<u64, String> {
    let counted = folder.join("callgrind.out");
    let mut command = Command::new("valgrind");
    command
        .args(["--tool=callgrind", "--quiet"])
        .arg(format!("--callgrind-out-file={}", counted.display()));
    command
        .arg(program)
        .args(["render", &scene.name, "--threads", "1", "-o"])
        .arg(folder.join("picture.png"));
    if let Some(size) = &scene.size {
        command.args(["--size", size]);
    }
    if let Some(formulas) = &scene.formulas {
        command.args(["--formulas", formulas]);
    }
    // The environment is copied and searched, and so would change the count.
    command.env_clear().current_dir(workspace());
    run(&mut command).map_err(|why| {
        format!("{why}\nhelp: valgrind counts the instructions; apt-get install valgrind")
    })?;
    let text =
        std::fs::read_to_string(&counted).map_err(|why| format!("{}: {why}", counted.display()))?;
    let totals = text.lines().find_map(|line| line.strip_prefix("totals: "));
    totals
        .and_then(|n| n.trim().parse().ok())
        .ok_or_else(|| format!("{}: no count", counted.display()))
}

/// Runs a command, and returns its standard output.
fn run(command: &mut Command) -> Result<String, String> {
    let shown = format!("{command:?}");
    let out = command.output().map_err(|why| format!("{shown}: {why}"))?;
    match out.status.success() {
        true => Ok(String::from_utf8_lossy(&out.stdout).into_owned()),
        false => Err(format!(
            "{shown} ends with {}\n{}",
            out.status,
            String::from_utf8_lossy(&out.stderr)
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget(instructions: u64) -> Budget {
        let scene = |name: &str, size: Option<&str>| Scene {
            name: name.into(),
            size: size.map(str::to_owned),
            formulas: None,
            instructions,
        };
        Budget {
            toolchain: "one".into(),
            scene: vec![scene("a/b", None), scene("c.toml", Some("4x3"))],
        }
    }

    #[test]
    fn three_percent_are_allowed_both_ways() {
        for (found, says) in [
            (1_000_000, ""),
            (1_029_900, ""),
            (970_100, ""),
            (1_030_100, "c.toml: 1030100 instructions for a budget of 1000000, +3.0 %: slower"),
            (500_000, "-50.0 %: faster"),
        ] {
            let said = complaints(&budget(1_000_000), &[1_000_000, found], "one");
            assert!(said.contains(says) && said.is_empty() == says.is_empty(), "{found}: {said}");
            assert!(!said.contains("a/b"), "{said}");
            assert_eq!(said.contains("--bless"), !says.is_empty(), "{said}");
        }
        assert!(
            complaints(&budget(0), &[5, 5], "one")
                .contains("a/b: 5 instructions, and no budget yet")
        );
    }

    #[test]
    fn complaints_name_the_formulas() {
        let scene = Scene {
            name: "a/b".into(),
            size: None,
            formulas: Some("plain".into()),
            instructions: 100,
        };
        let said = scene.complaint(200).unwrap();
        assert!(said.starts_with("a/b by plain: 200 instructions"), "{said}");
    }

    #[test]
    fn another_compiler_is_named_where_counts_differ() {
        assert_eq!(complaints(&budget(100), &[100, 100], "another"), "");
        let said = complaints(&budget(100), &[100, 200], "another");
        assert!(said.contains("the budget is of one, this is another"), "{said}");
    }

    #[test]
    fn the_file_is_read_as_it_is_written_and_names_scenes_that_exist() {
        let written = to_text(&budget(7)).unwrap();
        assert_eq!(parse(&written), Ok(budget(7)));
        assert!(
            parse("toolchain = \"x\"\nscene = []\nslack = 9\n").is_err(),
            "an unknown key is taken"
        );
        let stored = std::fs::read_to_string(path()).unwrap();
        let budget = parse(&stored).unwrap();
        assert_eq!(to_text(&budget).unwrap(), stored, "differs from what --bless writes");
        for scene in &budget.scene {
            let case = workspace().join(format!("cases/stages/{}.toml", scene.name));
            assert!(
                case.is_file() || workspace().join(&scene.name).is_file(),
                "there is no {}",
                scene.name
            );
            assert!(scene.instructions > 1_000_000, "{} was never counted", scene.name);
        }
        let stages =
            cases::stage::load_all(&crate::public_stages(), &cases::Course::default()).unwrap();
        for stage in stages.iter().filter(|stage| !stage.cases.is_empty()) {
            let is_counted = budget.scene.iter().any(|scene| scene.name.starts_with(&stage.id));
            assert!(is_counted, "no scene of {} is counted", stage.id);
        }
    }
}
