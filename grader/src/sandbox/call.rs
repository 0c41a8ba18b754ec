//! The call of a program.

use std::ffi::OsString;
use std::path::PathBuf;

use super::access::Access;
use super::layers::Layers;
use super::limits::Limits;

/// A program to run, with its input and its limits.
#[derive(Clone, Debug)]
pub struct Call {
    /// The program.
    pub program: PathBuf,
    /// The arguments.
    pub args: Vec<OsString>,
    /// The folder in which the program starts, which should be fresh and used by no other program.
    pub folder: PathBuf,
    /// Whether the program gets a copy of the files of `folder` in memory, of the size that the
    /// limits state, where there are namespaces. [`Finished`](super::Finished) leads to it.
    pub in_memory: bool,
    /// The whole environment of the program.
    pub environment: Vec<(OsString, OsString)>,
    /// Bytes that the program reads on standard input.
    pub stdin: Vec<u8>,
    /// The limits of the program.
    pub limits: Limits,
    /// The layers of protection.
    pub layers: Layers,
    /// What exists for the program, besides its folder and the programs and libraries of the
    /// system. It matters where `layers` has namespaces or Landlock.
    pub access: Vec<Access>,
    /// Bytes that a correct program may have to write to its folder.
    pub needed: u64,
}
