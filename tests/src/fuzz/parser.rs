//! The interface of a parser, and its results on files.

use std::path::Path;

use serde::{Deserialize, Serialize};

/// A parser, with files that it reads without an error.
#[derive(Clone, Copy)]
pub struct Parser {
    /// The name of the parser on the command line.
    pub name: &'static str,
    /// Returns files that the parser accepts.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Pieces of the format, which mutations insert.
    pub scraps: &'static [&'static [u8]],
    /// Corrects the checksums of a mutated file, so that the parser sees what lies behind them.
    pub repair: fn(&mut [u8]),
    /// Reads a file. The parser may write files of its own into the folder. A broken promise is a
    /// panic.
    pub read: fn(&[u8], &Path) -> Read,
}

/// The result of a parser on a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Read {
    /// The parser read the file.
    Accepted,
    /// The parser refused the file with a message.
    Refused,
}

/// The number of mutations by result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// The number of mutations that the parser accepted.
    pub n_accepted: u64,
    /// The number of mutations that the parser refused.
    pub n_refused: u64,
}

impl Counts {
    /// Returns the number of all mutations.
    pub fn n(self) -> u64 {
        self.n_accepted + self.n_refused
    }

    /// Counts one more result.
    pub fn add(&mut self, read: Read) {
        match read {
            Read::Accepted => self.n_accepted += 1,
            Read::Refused => self.n_refused += 1,
        }
    }
}
