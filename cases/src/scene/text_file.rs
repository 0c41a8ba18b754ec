//! Reading files whose size is demanded before any of it is held in memory.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The bytes of the regular file at `path`, at most `limit`; `Err` says why not, in a few words.
pub(crate) fn bytes(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    // Asked before opening: to open a FIFO is to wait for whoever writes to it.
    let about = std::fs::metadata(path).map_err(|why| match why.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => format!("it cannot be read: {why}"),
    })?;
    if !about.is_file() {
        return Err(if about.is_dir() { "it is a folder" } else { "it is not a regular file" }.to_owned());
    }
    let too_large = |n: u64| format!("it has {n} bytes; at most {limit} are read");
    if about.len() > limit {
        return Err(too_large(about.len()));
    }
    let mut bytes = vec![];
    let read = File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes));
    match read {
        Err(why) => Err(format!("it cannot be read: {why}")),
        Ok(_) if bytes.len() as u64 > limit => Err(too_large(bytes.len() as u64)),
        Ok(_) => Ok(bytes),
    }
}

/// The text of the file at `path`, demanded to be UTF-8.
pub(crate) fn text(path: &Path, limit: u64) -> Result<String, String> {
    let wrong_byte = |at: usize| format!("it is not a text: byte {at} is not UTF-8");
    String::from_utf8(bytes(path, limit)?).map_err(|why| wrong_byte(why.utf8_error().valid_up_to()))
}
