//! The files of a folder that nobody can be trusted with: no link followed, everything counted.

use std::fs::{File, OpenOptions};
use std::io::Read;
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

/// Folders that hold what tools made of the rest.
const SKIPPED: [&str; 6] = ["target", ".git", "__MACOSX", "node_modules", ".venv", "__pycache__"];
/// Files and folders that are listed at most.
const MAX_ENTRIES: usize = 2000;
const MAX_DEPTH: usize = 12;

/// What lies below a folder.
#[derive(Debug, Default)]
pub(super) struct Listing {
    /// Regular files, relative to the folder, in order.
    pub(super) files: Vec<PathBuf>,
    /// What was not listed, and why.
    pub(super) ignored: Vec<String>,
}

/// Lists `folder`; `None` where it holds more than can be listed.
pub(super) fn list(folder: &Path) -> Option<Listing> {
    let mut listing = Listing::default();
    walk(folder, Path::new(""), 0, &mut listing).then(|| {
        listing.files.sort();
        listing.ignored.sort();
        listing
    })
}

fn walk(folder: &Path, below: &Path, depth: usize, listing: &mut Listing) -> bool {
    let Ok(entries) = std::fs::read_dir(folder.join(below)) else {
        listing.ignored.push(format!("{}: cannot be read", shown(below)));
        return true;
    };
    for entry in entries.flatten() {
        let path = below.join(entry.file_name());
        let kind = entry.file_type().ok();
        match kind {
            Some(kind) if kind.is_dir() && SKIPPED.iter().any(|name| entry.file_name() == *name) => {}
            Some(kind) if kind.is_dir() && depth < MAX_DEPTH => {
                if !walk(folder, &path, depth + 1, listing) {
                    return false;
                }
            }
            Some(kind) if kind.is_file() => listing.files.push(path),
            _ => {
                listing.ignored.push(format!("{}: neither a file nor a folder (links are not followed)", shown(&path)))
            }
        }
        if listing.files.len() + listing.ignored.len() > MAX_ENTRIES {
            return false;
        }
    }
    true
}

/// A path as it is shown to people, with `/` between names.
pub(super) fn shown(path: &Path) -> String {
    crate::plain::name(path.as_os_str().as_encoded_bytes())
}

/// Opens a regular file without following a link or waiting for a pipe.
///
/// # Errors
/// Says in plain words what is there instead.
pub fn open_regular(path: &Path) -> Result<File, String> {
    let flags = libc::O_NOFOLLOW | libc::O_NONBLOCK;
    let file =
        OpenOptions::new().read(true).custom_flags(flags).open(path).map_err(|why| match why.raw_os_error() {
            Some(libc::ELOOP) => "is a link; put the file itself there".to_owned(),
            _ => format!("cannot be read: {why}"),
        })?;
    match file.metadata() {
        Ok(found) if found.is_file() => Ok(file),
        Ok(_) => Err("is no regular file".to_owned()),
        Err(why) => Err(format!("cannot be read: {why}")),
    }
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// Says in plain words what is wrong with it.
pub(super) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let mut bytes = vec![];
    open_regular(path)?.take(limit + 1).read_to_end(&mut bytes).map_err(|why| format!("cannot be read: {why}"))?;
    if bytes.len() as u64 > limit { Err(format!("is larger than {limit} bytes")) } else { Ok(bytes) }
}

/// The text of a regular file of at most `limit` bytes.
///
/// # Errors
/// Says in plain words what is wrong with it.
pub fn read_text(path: &Path, limit: u64) -> Result<String, String> {
    String::from_utf8(read_bytes(path, limit)?).map_err(|why| {
        let valid = &why.as_bytes()[..why.utf8_error().valid_up_to()];
        let line = valid.iter().filter(|byte| **byte == b'\n').count() + 1;
        format!("is not UTF-8 text (line {line}); save it as UTF-8 in your editor")
    })
}
