//! One picture: the scene goes in as a file, a picture comes out as a file, which is read as what it is: a stranger's.

use std::io::Read;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use cases::film::{self, Image, PictureError};
use cases::scene::{self, Scene};

use super::{Candidate, run};
use crate::sandbox::{Finished, Folder};
use crate::submission::open_regular;

/// What came of `render`.
#[derive(Debug)]
pub struct Shot {
    /// The picture, or why there is none.
    pub picture: Result<Image, NoPicture>,
    /// How the program ended.
    pub finished: Finished,
}

/// Why there is no picture of the right size.
#[derive(Debug)]
pub enum NoPicture {
    /// There is no file.
    Missing,
    /// The header says another size.
    Size(String),
    /// There is a file, but no picture in it; says what is there.
    Unreadable(String),
}

const SCENE: &str = "scene.json";
const OUT: &str = "out.png";
/// Bytes of the largest file that is read as a picture.
const MAX_BYTES: u64 = 64 << 20;

/// Has the program render `scene` in a fresh folder.
///
/// # Errors
/// A folder that cannot be made: the machine's fault.
pub fn shoot(candidate: &Candidate, scene: &Scene) -> std::io::Result<Shot> {
    let folder = Folder::new()?;
    let (input, output) = (folder.path().join(SCENE), folder.path().join(OUT));
    std::fs::write(&input, scene::json::to_string(scene))?;
    let args = ["render".into(), input.into_os_string(), output.clone().into_os_string()];
    let finished = run(candidate.program, &args, folder.path(), vec![], candidate.allowance.picture);
    let picture = read(&output, scene.render.width, scene.render.height);
    Ok(Shot { picture, finished })
}

/// Reads the picture at `path`, demanded to be of this size.
///
/// # Errors
/// [`NoPicture`]; a link, a pipe or a device in its place is not opened.
pub fn read(path: &Path, width: u32, height: u32) -> Result<Image, NoPicture> {
    if std::fs::symlink_metadata(path).is_err() {
        return Err(NoPicture::Missing);
    }
    let bytes = bounded(path).map_err(NoPicture::Unreadable)?;
    film::read_exact(&bytes, width, height).map_err(|why| match why {
        PictureError::Size { .. } => NoPicture::Size(why.to_string()),
        other => NoPicture::Unreadable(other.to_string()),
    })
}

fn bounded(path: &Path) -> Result<Vec<u8>, String> {
    let file = open_regular(path).map_err(|why| format!("the picture {why}"))?;
    let found = file.metadata().map_err(|why| why.to_string())?;
    if found.nlink() != 1 {
        return Err("the picture has a second name (a hard link)".to_owned());
    }
    let mut bytes = vec![];
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|why| why.to_string())?;
    let is_too_long = bytes.len() as u64 > MAX_BYTES;
    if is_too_long { Err("the file is too long for a picture".to_owned()) } else { Ok(bytes) }
}
