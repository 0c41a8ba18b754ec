//! Prints to the output stream, and defines how much is printed to the error stream.

use pages::say;

use super::stop::Stop;

/// The amount of messages on the error stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Talk {
    /// Only errors.
    Quiet,
    /// Errors, warnings, progress and the files that were written.
    Normal,
    /// Each step as well.
    Verbose,
}

/// Writes bytes to the output stream unchanged. A reader that has gone away is no error.
pub(super) fn print(bytes: &[u8]) -> Result<(), Stop> {
    say::raw(bytes).map_err(Stop::machine("cannot write to the output stream"))
}

/// Prints text for people to the output stream. A reader that has gone away is no error.
pub(super) fn print_text(text: &str) -> Result<(), Stop> {
    say::out(text).map_err(Stop::machine("cannot write to the output stream"))
}

/// Prints a value as JSON to the output stream.
pub(super) fn print_json<T: serde::Serialize>(value: &T) -> Result<(), Stop> {
    let text =
        serde_json::to_string_pretty(value).map_err(Stop::machine("cannot encode the report"))?;
    print(format!("{text}\n").as_bytes())
}
