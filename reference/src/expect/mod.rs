//! The stored answers: what the files beside the cases must hold. Nothing here writes; `reference expect` does.

pub mod allowed;
mod checks;
mod mistakes;

use std::path::{Path, PathBuf};

use cases::answer::{self, ImageAnswer};
use cases::film::{self, Image};
use cases::stage::Case;

pub use checks::{of_check, of_checks};
pub use mistakes::mistakes;

use crate::render::{self, Options};
use crate::rules::Lecture;
use crate::world::World;

/// A channel may be off by this many 8-bit levels.
const SLACK: f64 = 1.0;
/// This share of the pixels may be out.
const OUT_SHARE: f64 = 0.005;

/// A file as it is to be stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Where.
    pub path: PathBuf,
    /// What.
    pub bytes: Vec<u8>,
}

impl Expected {
    /// Whether exactly this is stored.
    pub fn is_stored(&self) -> bool {
        std::fs::read(&self.path).is_ok_and(|stored| stored == self.bytes)
    }
}

/// The picture of a case, by the rules of the lecture, in f64.
pub fn picture(case: &Case) -> Image {
    let world = World::<f64>::new(&case.scene);
    render::render(&world, Lecture, &Options::of(&world), |_| {}).0
}

/// The answer file of a case, and the picture for people.
///
/// # Errors
/// What the encoders say.
pub fn of_case(stages: &Path, case: &Case) -> Result<Vec<Expected>, film::PictureError> {
    let expected = picture(case);
    let n_pixels = f64::from(expected.width()) * f64::from(expected.height());
    let png = film::encode(film::Kind::Png, &expected)?;
    let exr = ImageAnswer::exact(expected, SLACK, (n_pixels * OUT_SHARE) as u32).encode(&[])?;
    Ok(vec![
        Expected { path: answer::image_answer_path(stages, &case.id), bytes: exr },
        Expected { path: answer::expected_png_path(stages, &case.id), bytes: png },
    ])
}
