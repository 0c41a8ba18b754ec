//! Renders one picture: the scene goes in as a file, and the picture comes out as a file, which is
//! read as untrusted data.

use std::io::Read;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use cases::Effects;
use cases::film::{self, Image, PictureError};
use cases::scene::{self, Render, Scene};

use super::attempt::{Attempt, NEEDED, Task, attempt};
use super::{Candidate, Failure, Start};
use crate::blame::{self, Blame};
use crate::sandbox::{Finished, Limits, Outcome};
use crate::submission::{ReadError, open_regular};

/// The result of a call to render.
#[derive(Debug)]
pub struct Rendered {
    /// The picture, or why there is none.
    pub picture: Result<Image, NoPicture>,
    /// The end of the program.
    pub finished: Finished,
    /// The limits under which it ran.
    pub limits: Limits,
    /// The failure of the program, if it also left no file.
    failure: Option<Failure>,
}

/// The reason why there is no picture of the right size.
#[derive(Debug)]
pub enum NoPicture {
    /// There is no file.
    Missing,
    /// The header states another size; the text says which.
    Size(String),
    /// There is a file, but no picture in it; the text says what is there.
    Unreadable(String),
    /// The machine fails to read the file.
    Machine(String),
}

const SCENE: &str = "scene.json";
const OUT: &str = "out.png";
/// Largest size in bytes of a file that is read as a picture.
const MAX_BYTES: u64 = 64 << 20;
/// Bytes of a pixel in the largest of the usual formats, PFM.
const PIXEL_BYTES: u64 = 12;

/// Runs the program to render `scene` in a fresh folder.
pub fn render_case(candidate: &Candidate, scene: &Scene, limits: Limits) -> Rendered {
    let render = scene.render;
    let prepare = |folder: &Path| {
        let (input, output) = (folder.join(SCENE), folder.join(OUT));
        std::fs::write(&input, scene::json::to_string(scene))?;
        Ok(vec!["render".into(), input.into_os_string(), output.into_os_string()])
    };
    let needed = NEEDED + u64::from(render.width) * u64::from(render.height) * PIXEL_BYTES;
    let task = Task { limits, needed, stdin: &[], prepare: &prepare };
    let Attempt { output: picture, finished, failure } =
        attempt(candidate, &task, &|folder, finished| {
            let picture = read(&folder.join(OUT), render.width, render.height);
            let is_good = picture.is_ok() && is_over(finished);
            (picture, is_good)
        });
    let failure = failure.filter(|_| matches!(picture, Err(NoPicture::Missing)));
    Rendered { picture, finished, limits, failure }
}

/// Returns whether the program ended by itself.
fn is_over(finished: &Finished) -> bool {
    matches!(finished.outcome, Outcome::Exited(_) | Outcome::Signalled(_))
}

impl Rendered {
    /// Records in `start` how this process ended.
    pub fn tell(&self, start: &mut Start, candidate: &Candidate, scene: &Scene) {
        start.see(self.failure.as_ref(), || {
            render_case(candidate, &empty(scene), self.limits).failure
        });
    }
}

/// Returns a scene for a small picture of the same view, without effects, lights and objects.
fn empty(scene: &Scene) -> Scene {
    Scene {
        render: Render { width: 8, height: 6, ..scene.render },
        effects: Effects::NONE,
        lights: vec![],
        materials: vec![],
        meshes: vec![],
        objects: vec![],
        ..scene.clone()
    }
}

/// Reads the picture at `path`, which must be `width` × `height`.
///
/// # Errors
/// See [`NoPicture`]. A link is not followed; a pipe or a device is neither waited for nor read.
pub fn read(path: &Path, width: u32, height: u32) -> Result<Image, NoPicture> {
    match std::fs::symlink_metadata(path) {
        Err(why) if blame::of(&why) == Blame::Machine => {
            return Err(NoPicture::Machine(why.to_string()));
        }
        Err(_) => return Err(NoPicture::Missing),
        Ok(_) => {}
    }
    let bytes = bounded(path)?;
    film::read_exact(&bytes, width, height).map_err(|why| match why {
        PictureError::Size { .. } => NoPicture::Size(why.to_string()),
        other => NoPicture::Unreadable(other.to_string()),
    })
}

fn bounded(path: &Path) -> Result<Vec<u8>, NoPicture> {
    let failed = |why: ReadError| match blame::of(&why) {
        Blame::Machine => NoPicture::Machine(format!("the picture {why}")),
        Blame::File => NoPicture::Unreadable(format!("the picture {why}")),
    };
    let file = open_regular(path).map_err(failed)?;
    let found = file.metadata().map_err(|why| failed(why.into()))?;
    if found.nlink() != 1 {
        return Err(NoPicture::Unreadable(
            "the picture has a second name (a hard link)".to_owned(),
        ));
    }
    let mut bytes = vec![];
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|why| failed(why.into()))?;
    match bytes.len() as u64 > MAX_BYTES {
        true => Err(NoPicture::Unreadable("the file is too long for a picture".to_owned())),
        false => Ok(bytes),
    }
}
