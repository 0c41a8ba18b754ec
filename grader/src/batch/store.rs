//! Stores results on disk, each published once and whole under a hash of everything it depends on.
//! A result without the seal of the grader does not count.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use crate::files;
use crate::graded::Graded;
use crate::leftovers::{self, Held, Left};
use crate::record::{Record, SCHEMA};
use crate::report::html;

use super::seal::Key;

/// The folder of results, for one epoch.
pub(super) struct Store {
    out: PathBuf,
    epoch: String,
    key: Key,
    /// The folder for files before they get their names, and for notes on the submissions that are
    /// being graded.
    work: Held,
    /// Ids of the submissions that were being graded when a run died, with the number of deaths
    /// while no other one was.
    suspects: BTreeMap<String, u32>,
}

/// A result of an earlier run, as it is found on the disk.
pub(super) enum Found {
    /// There is none.
    Nothing,
    /// The record, which has the seal of this grader.
    Record(Box<Record>),
    /// There is one, but without the seal of this grader: someone else has written it, the disk
    /// has spoilt it, or it was sealed with another key.
    Unsealed,
}

/// The files of a result.
const RECORD: &str = "record.json";
const REPORT: &str = "report.html";
const SEAL: &str = "seal";
/// The ending of a file that notes that a submission is being graded.
const DOING: &str = ".doing";
/// The ending of a file with the number of deaths of a suspect, which is kept until the submission
/// has a record.
const SUSPECT: &str = ".suspect";

impl Store {
    /// Creates the folders, and removes what killed runs left in them.
    pub(super) fn open(out: &Path, epoch: &str, key: Key) -> io::Result<Self> {
        for folder in ["results", "records", "reports"] {
            std::fs::create_dir_all(out.join(folder))?;
        }
        let work = Held::new(out, files::PARTS)?;
        let left = leftovers::left_behind(out, files::PARTS)?;
        let suspects = suspects(&left)?;
        // The suspects are noted again before the old notes go, in case this run dies as well.
        for (id, n_deaths) in &suspects {
            std::fs::write(work.path().join(format!("{id}{SUSPECT}")), n_deaths.to_string())?;
        }
        drop(left);
        files::clear_parts(out)?;
        files::clear_parts(&out.join("results"))?;
        Ok(Self { out: out.to_owned(), epoch: epoch.to_owned(), key, work, suspects })
    }

    /// Returns how often a run died while it graded this submission and no other, or `None` if none
    /// died while it graded this one.
    pub(super) fn deaths(&self, id: &str) -> Option<u32> {
        self.suspects.get(id).copied()
    }

    /// Notes that a submission is being graded, in case the run dies.
    pub(super) fn begin(&self, id: &str) -> io::Result<()> {
        std::fs::write(self.doing(id), "")
    }

    /// Notes that a submission is no longer being graded.
    pub(super) fn end(&self, id: &str) {
        let _ = std::fs::remove_file(self.doing(id)); // The whole folder goes when the run ends.
    }

    /// Removes the number of deaths of a submission, which has a record now.
    pub(super) fn clear(&self, id: &str) {
        // Most submissions have none.
        let _ = std::fs::remove_file(self.work.path().join(format!("{id}{SUSPECT}")));
    }

    fn doing(&self, id: &str) -> PathBuf {
        self.work.path().join(format!("{id}{DOING}"))
    }

    fn folder(&self, digest: &str, name: &str) -> PathBuf {
        let mut hasher = blake3::Hasher::new();
        for part in [&self.epoch, digest, name] {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part.as_bytes());
        }
        self.out.join("results").join(hasher.finalize().to_hex().as_str())
    }

    /// Returns the result of an earlier run, if its seal is right.
    pub(super) fn find(&self, digest: &str, name: &str) -> Found {
        let folder = self.folder(digest, name);
        if folder.symlink_metadata().is_err() {
            return Found::Nothing;
        }
        let record = self.sealed(&folder).filter(|record| record.submission.digest == digest);
        record.map_or(Found::Unsealed, |record| Found::Record(Box::new(record)))
    }

    /// Returns the record in `folder`, or `None` if a file is missing or the seal is not right.
    fn sealed(&self, folder: &Path) -> Option<Record> {
        let [record, report, seal] =
            [RECORD, REPORT, SEAL].map(|name| std::fs::read(folder.join(name)).ok());
        let (record, report) = (record?, report?);
        let found = blake3::Hash::from_hex(seal?).ok()?;
        // Hashes are compared in constant time.
        let is_right = found == self.seal(folder, &record, &report);
        let record: Record = serde_json::from_slice(&record).ok().filter(|_| is_right)?;
        (record.schema == SCHEMA).then_some(record)
    }

    /// Returns the seal of a result. It covers the name of the folder, so that no result can stand
    /// in for another.
    fn seal(&self, folder: &Path, record: &[u8], report: &[u8]) -> blake3::Hash {
        let name = folder.file_name().unwrap_or_default().as_encoded_bytes();
        self.key.seal(&[name, record, report])
    }

    /// Stores a record and its report, with their seal.
    ///
    /// A result that already has the same key is replaced if its seal is not right, and otherwise
    /// kept, since it is just as good. A submission that could not be read has no digest in its
    /// key, so its result is always replaced.
    pub(super) fn publish(&self, graded: &Graded) -> io::Result<()> {
        let Record { submission, .. } = &graded.record;
        let folder = self.folder(&submission.digest, &submission.path);
        let is_kept = !submission.digest.is_empty() && self.sealed(&folder).is_some();
        if folder.symlink_metadata().is_ok() && !is_kept {
            leftovers::remove(&folder)?;
        }
        files::publish_folder(&folder, |fresh| {
            let (report, record) = (fresh.join(REPORT), graded.record.to_json());
            html::write(&report, graded)?;
            let seal = self.seal(&folder, record.as_bytes(), &std::fs::read(&report)?);
            files::write(&fresh.join(SEAL), seal.to_hex().as_bytes())?;
            files::write(&fresh.join(RECORD), record.as_bytes())
        })
    }

    /// Makes a published record and its report available under the submission's id, where people
    /// look for them.
    pub(super) fn show(&self, id: &str, record: &Record) -> io::Result<()> {
        let report = self.folder(&record.submission.digest, &record.submission.path).join(REPORT);
        self.link(&report, &self.out.join("reports").join(format!("{id}.html")))?;
        files::write(
            &self.out.join("records").join(format!("{id}.json")),
            record.to_json().as_bytes(),
        )
    }

    /// Makes `to` a hard link to `from`, or a copy if the file system has no hard links.
    fn link(&self, from: &Path, to: &Path) -> io::Result<()> {
        let part = self.work.path().join(to.file_name().unwrap_or_default());
        if std::fs::hard_link(from, &part).is_err() {
            return files::write(to, &std::fs::read(from)?);
        }
        let renamed = std::fs::rename(&part, to);
        // A rename onto another hard link to the same file leaves both.
        let _ = std::fs::remove_file(&part);
        renamed
    }
}

/// Returns the submissions that were being graded when earlier runs died, from the folders that
/// these runs left. A submission that was graded alone gets one more death.
fn suspects(left: &[Left]) -> io::Result<BTreeMap<String, u32>> {
    let mut suspects = BTreeMap::new();
    for left in left {
        let files = files::below(&left.path)?;
        let ids = |ending| {
            let id = move |path: &PathBuf| {
                Some(path.file_name()?.to_str()?.strip_suffix(ending)?.to_owned())
            };
            files.iter().filter_map(move |path| Some((id(path)?, path)))
        };
        let known = ids(SUSPECT).map(|(id, path)| {
            let n_deaths =
                std::fs::read_to_string(path).ok().and_then(|text| text.trim().parse().ok());
            (id, n_deaths.unwrap_or(0))
        });
        let known: BTreeMap<String, u32> = known.collect();
        let is_alone = u32::from(ids(DOING).count() == 1);
        let doing = ids(DOING)
            .map(|(id, _)| (known.get(&id).unwrap_or(&0) + is_alone, id))
            .map(|(n, id)| (id, n));
        for (id, n_deaths) in known.clone().into_iter().chain(doing) {
            let most: &mut u32 = suspects.entry(id).or_default();
            *most = n_deaths.max(*most);
        }
    }
    Ok(suspects)
}
