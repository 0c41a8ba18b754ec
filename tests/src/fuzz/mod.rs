//! Fuzzing: every parser of foreign bytes reads mutations of good files.
//!
//! | module | |
//! |---|---|
//! | [`mutate`] | changes good files at random |
//! | `parser` | the interface of a parser, and its results on files |
//! | `scraps` | pieces of each format |
//! | [`seeds`] | the good files |
//! | [`parsers`] | the parsers, and their promises |
//! | [`session`] | processes that read for a given time, within limits |

pub mod mutate;
mod parser;
pub mod parsers;
mod scraps;
pub mod seeds;
pub mod session;

use std::panic::catch_unwind;

pub use parser::{Counts, Parser, Read};

use crate::dice::Dice;

/// Reads the seeds and `n` mutations of them, drawn by `seed`, in this process.
///
/// # Panics
/// Panics with the input if a seed is refused, a parser panics or a promise is broken.
pub fn read_some(parser: &Parser, n: u64, seed: u64) -> Counts {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let read = |bytes: &[u8]| {
        catch_unwind(|| (parser.read)(bytes, folder.path()))
            .unwrap_or_else(|_| panic!("{} panicked at\n{}", parser.name, bytes.escape_ascii()))
    };
    let seeds = (parser.seeds)();
    assert!(!seeds.is_empty(), "{} has no seeds", parser.name);
    for bytes in &seeds {
        assert_eq!(
            read(bytes),
            Read::Accepted,
            "{}: a seed\n{}",
            parser.name,
            bytes.escape_ascii()
        );
    }
    let (mut dice, mut counts) = (Dice::new(seed), Counts::default());
    for _ in 0..n {
        counts.add(read(&mutate::mutated(parser, &seeds, &mut dice)));
    }
    counts
}
