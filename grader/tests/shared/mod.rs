//! Makes exams of black pictures.
#![allow(dead_code)] // Each test file uses a part of this.

use std::fs;
use std::path::Path;

use cases::Course;
use cases::answer::{Digest, ImageAnswer, image_answer_path, mistakes_path, mistakes_to_string};
use cases::film::Image;
use cases::glam::DVec3;
use cases::stage::{Base, load_case};

pub(crate) const STAGE: &str =
    "title = \"Dark\"\nabout = \"Nothing is there.\"\nallows = []\nneeds = []\nunit_points = 0\n";

pub(crate) const CASE: &str = "title = \"Dark\"\n\
    about = \"Nothing is there, so nothing is seen.\"\nrules = [2]\npoints = 2\n\
    [render]\nsize = [4, 3]\nmax_depth = 0\n\
    [scene.camera]\neye = [0, 0, 3]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
    [scene.materials]\nchalk = { kd = [1, 1, 1] }\n\
    [[scene.objects]]\nsphere = {}\nmaterial = \"chalk\"\n";

/// Writes the stage `01_ray_casting` with the case `dark` and its answer below `stages`.
pub(crate) fn dark_exam(stages: &Path) {
    add_dark_case(stages, "dark");
}

/// Adds the case `name` and its answer to the stage `01_ray_casting`.
pub(crate) fn add_dark_case(stages: &Path, name: &str) {
    let stage = stages.join("01_ray_casting");
    fs::create_dir_all(&stage).unwrap();
    fs::write(stage.join("stage.toml"), STAGE).unwrap();
    fs::write(stage.join(name).with_extension("toml"), CASE).unwrap();
    expect(stages, name);
}

/// Writes the answers to the case `name` as it is now: a black picture, and an empty list of
/// mistakes.
pub(crate) fn expect(stages: &Path, name: &str) {
    let course = Course::default();
    let case = load_case(&stages.join("01_ray_casting").join(name).with_extension("toml"), &course)
        .unwrap();
    let answer = ImageAnswer::exact(Image::from_fn(4, 3, |_, _| DVec3::ZERO), 2.0, 0);
    let bytes = answer.encode(&Digest::of_case(&course, Base::Background, &case), &[]).unwrap();
    fs::write(image_answer_path(stages, &case.id), bytes).unwrap();
    let mistakes = mistakes_to_string(&Digest::of_mistakes(&course), &[]).unwrap();
    fs::write(mistakes_path(stages), mistakes).unwrap();
}
