//! Results on disk: published once, whole, under the hash of all they depend on.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::files;
use crate::grade::Graded;
use crate::record::{Record, SCHEMA};
use crate::report::html;

/// What was not published for so long will not be: one submission takes minutes.
const ABANDONED: Duration = Duration::from_secs(24 * 60 * 60);

/// The folder of results, for one epoch.
pub(super) struct Store {
    out: PathBuf,
    epoch: String,
}

impl Store {
    /// Makes the folders, and clears what a run that was killed left in them.
    pub(super) fn open(out: &Path, epoch: &str) -> io::Result<Self> {
        for folder in ["results", "records", "reports"] {
            std::fs::create_dir_all(out.join(folder))?;
        }
        files::clear_parts(&out.join("results"), ABANDONED)?;
        Ok(Self { out: out.to_owned(), epoch: epoch.to_owned() })
    }

    fn folder(&self, digest: &str, name: &str) -> PathBuf {
        let mut hasher = blake3::Hasher::new();
        for part in [&self.epoch, digest, name] {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part.as_bytes());
        }
        self.out.join("results").join(hasher.finalize().to_hex().as_str())
    }

    /// The record of an earlier run, if there is one; a broken one counts for nothing.
    pub(super) fn find(&self, digest: &str, name: &str) -> Option<Record> {
        let folder = self.folder(digest, name);
        let bytes = std::fs::read(folder.join("record.json")).ok()?;
        let record: Record = serde_json::from_slice(&bytes).ok()?;
        let is_whole = record.schema == SCHEMA && folder.join("report.html").is_file();
        (is_whole && record.submission.digest == digest).then_some(record)
    }

    /// Stores a record and its report. What is under the same key already can only be broken, or just as good; but what
    /// could not be read has no digest to tell it by, so there the new one counts.
    pub(super) fn publish(&self, graded: &Graded) -> io::Result<()> {
        let Record { submission, .. } = &graded.record;
        let folder = self.folder(&submission.digest, &submission.path);
        let is_told_apart = !submission.digest.is_empty();
        if folder.exists() && !(is_told_apart && self.find(&submission.digest, &submission.path).is_some()) {
            std::fs::remove_dir_all(&folder)?;
        }
        files::publish_folder(&folder, |fresh| {
            html::write(&fresh.join("report.html"), graded)?;
            files::write(&fresh.join("record.json"), graded.record.to_json().as_bytes())
        })
    }

    /// Puts a published record and its report where people look for them.
    pub(super) fn show(&self, id: &str, record: &Record) -> io::Result<()> {
        let report = self.folder(&record.submission.digest, &record.submission.path).join("report.html");
        link(&report, &self.out.join("reports").join(format!("{id}.html")))?;
        files::write(&self.out.join("records").join(format!("{id}.json")), record.to_json().as_bytes())
    }
}

/// Makes `to` a second name of `from`, or a copy where the file system has no second names.
fn link(from: &Path, to: &Path) -> io::Result<()> {
    let part = to.with_extension(format!("part-{}", std::process::id()));
    let _ = std::fs::remove_file(&part); // left by a process of the same number that was killed
    if std::fs::hard_link(from, &part).is_err() {
        return files::write(to, &std::fs::read(from)?);
    }
    let renamed = std::fs::rename(&part, to);
    let _ = std::fs::remove_file(&part); // a rename onto a name of the same file leaves both
    renamed
}
