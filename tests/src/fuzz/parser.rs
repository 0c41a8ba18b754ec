//! What a parser is, and what it did with files.

use std::path::Path;

use serde::{Deserialize, Serialize};

/// A parser, and files that it reads without an error.
#[derive(Clone, Copy)]
pub struct Parser {
    /// The name on the command line.
    pub name: &'static str,
    /// Files that are read.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Pieces of the format, which mutations insert.
    pub scraps: &'static [&'static [u8]],
    /// Corrects the checksums of a mutated file, so that the parser sees what lies behind them.
    pub repair: fn(&mut [u8]),
    /// Reads a file; the folder is for files of its own. A broken promise is a panic.
    pub read: fn(&[u8], &Path) -> Read,
}

/// What a parser did with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Read {
    /// It read the file.
    Accepted,
    /// It refused the file with a message.
    Refused,
}

/// How many mutations were read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Mutations that the parser accepted.
    pub n_accepted: u64,
    /// Mutations that it refused.
    pub n_refused: u64,
}

impl Counts {
    /// Returns how many there are.
    pub fn n(self) -> u64 {
        self.n_accepted + self.n_refused
    }

    /// Counts one more.
    pub fn add(&mut self, read: Read) {
        match read {
            Read::Accepted => self.n_accepted += 1,
            Read::Refused => self.n_refused += 1,
        }
    }
}
