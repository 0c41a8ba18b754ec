//! This file makes an exam of one black picture.

use std::fs;
use std::path::Path;

use cases::answer::{ImageAnswer, image_answer_path};
use cases::film::Image;
use cases::glam::DVec3;

const STAGE: &str = "title = \"Dark\"\nabout = \"Nothing is there.\"\nallows = []\nneeds = []\nunit_points = 0\n";

const CASE: &str = "title = \"Dark\"\nabout = \"Nothing is there, so nothing is seen.\"\nrules = [2]\npoints = 2\n\
    [render]\nsize = [4, 3]\nmax_depth = 0\n\
    [scene.camera]\neye = [0, 0, 3]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
    [scene.materials]\nchalk = { kd = [1, 1, 1] }\n\
    [[scene.objects]]\nsphere = {}\nmaterial = \"chalk\"\n";

/// Writes the stage `01_ray_casting` with the case `dark` and its answer below `stages`.
pub(crate) fn dark_exam(stages: &Path) {
    let stage = stages.join("01_ray_casting");
    fs::create_dir_all(&stage).unwrap();
    fs::write(stage.join("stage.toml"), STAGE).unwrap();
    fs::write(stage.join("dark.toml"), CASE).unwrap();
    let answer = ImageAnswer::exact(Image::from_fn(4, 3, |_, _| DVec3::ZERO), 2.0, 0);
    fs::write(image_answer_path(stages, "01_ray_casting/dark"), answer.encode(&[]).unwrap()).unwrap();
}
