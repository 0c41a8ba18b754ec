//! The solution renders every case as the reference does.

use std::path::Path;
use std::process::Command;

use cases::film::{self, Image};
use cases::scene::json;
use cases::stage::{self, Case};

/// Pixels that differ by more than two 8-bit levels in some channel.
fn n_different(one: &Image, other: &Image) -> usize {
    let differs = |a: glam::DVec3, b: glam::DVec3| (0..3).any(|c| (film::level(a[c]) - film::level(b[c])).abs() > 2.0);
    one.pixels().iter().zip(other.pixels()).filter(|(a, b)| differs(**a, **b)).count()
}

fn check(case: &Case) -> Result<(), String> {
    let folder = tempfile::tempdir().unwrap();
    let (scene, picture) = (folder.path().join("scene.json"), folder.path().join("picture.pfm"));
    std::fs::write(&scene, json::to_string(&case.scene)).unwrap();
    let program = env!("CARGO_BIN_EXE_solution");
    let status = Command::new(program).arg("render").arg(&scene).arg(&picture).status().unwrap();
    assert!(status.success(), "{}: {status}", case.id);
    let expected = reference::expect::picture(case);
    let rendered = film::read_exact(&std::fs::read(&picture).unwrap(), expected.width(), expected.height()).unwrap();
    // Silhouettes may move by a pixel here and there: the formulas differ.
    match n_different(&rendered, &expected) {
        n if 1000 * n <= expected.pixels().len() => Ok(()),
        n => Err(format!("{}: {n} pixels differ", case.id)),
    }
}

#[test]
fn the_solution_renders_every_case() {
    let stages_dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/stages");
    let stages = stage::load_all(&stages_dir).unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let cases: Vec<Case> = stages.into_iter().flat_map(|stage| stage.cases).collect();
    assert!(!cases.is_empty());
    let wrong: Vec<String> = cases.iter().filter_map(|case| check(case).err()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
