//! The call of a program.

use std::ffi::OsString;
use std::path::PathBuf;

use super::limits::Limits;

/// A program that is to be run, with what it gets and what it may use.
#[derive(Clone, Debug)]
pub struct Call {
    /// The program.
    pub program: PathBuf,
    /// Arguments.
    pub args: Vec<OsString>,
    /// The folder where the program starts; meant to be fresh and its own.
    pub folder: PathBuf,
    /// The whole environment of the program.
    pub environment: Vec<(OsString, OsString)>,
    /// Bytes that the program reads on standard input.
    pub stdin: Vec<u8>,
    /// The limits of what the program may use.
    pub limits: Limits,
    /// Bytes that a right program may have to write to its folder.
    pub needed: u64,
}
