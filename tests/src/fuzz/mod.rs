//! Fuzzing: every parser of foreign bytes reads mutations of good files.
//!
//! | module | |
//! |---|---|
//! | [`mutate`] | changes good files at random |
//! | `scraps` | pieces of each format |
//! | [`seeds`] | the good files |
//! | [`parsers`] | the parsers, and what each promises |
//! | [`session`] | processes that read for a given time, within limits |

pub mod mutate;
pub mod parsers;
mod scraps;
pub mod seeds;
pub mod session;

use std::panic::catch_unwind;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::dice::Dice;

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

/// Reads the seeds and `n` mutations of them, drawn by `seed`, in this process.
///
/// # Panics
/// Where a seed is refused, a parser panics or a promise is broken; the message has the input.
pub fn read_some(parser: &Parser, n: u64, seed: u64) -> Counts {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let read = |bytes: &[u8]| {
        catch_unwind(|| (parser.read)(bytes, folder.path()))
            .unwrap_or_else(|_| panic!("{} panicked at\n{}", parser.name, bytes.escape_ascii()))
    };
    let seeds = (parser.seeds)();
    assert!(!seeds.is_empty(), "{} has no seeds", parser.name);
    for bytes in &seeds {
        assert_eq!(read(bytes), Read::Accepted, "{}: a seed\n{}", parser.name, bytes.escape_ascii());
    }
    let (mut dice, mut counts) = (Dice::new(seed), Counts::default());
    for _ in 0..n {
        counts.add(read(&mutate::mutated(parser, &seeds, &mut dice)));
    }
    counts
}
