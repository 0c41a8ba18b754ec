//! What commands print on the output stream, and how much they say on the error stream.

use pages::say;

use super::stop::Stop;

/// How much a command says on the error stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Talk {
    /// Errors alone.
    Quiet,
    /// What was written.
    Normal,
    /// Also what was done on the way.
    Verbose,
}

/// Writes bytes to the output stream as they are; a reader that has gone away is no error.
pub(super) fn print(bytes: &[u8]) -> Result<(), Stop> {
    say::raw(bytes).map_err(|why| unprintable(&why))
}

/// Prints text for people to the output stream; a reader that has gone away is no error.
pub(super) fn print_text(text: &str) -> Result<(), Stop> {
    say::out(text).map_err(|why| unprintable(&why))
}

fn unprintable(why: &std::io::Error) -> Stop {
    Stop::Machine(format!("cannot write to the output stream: {why}"))
}

/// Prints a value as JSON to the output stream.
pub(super) fn print_json<T: serde::Serialize>(value: &T) -> Result<(), Stop> {
    let text = serde_json::to_string_pretty(value).map_err(|why| Stop::Machine(why.to_string()))?;
    print(format!("{text}\n").as_bytes())
}
