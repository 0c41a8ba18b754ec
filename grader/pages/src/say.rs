//! The only module that prints. No output panics if its reader is gone, as in `grader lint | head`.

use std::error::Error;
use std::io::{self, Write};

use anstream::{AutoStream, ColorChoice};

use crate::plain;

/// Prints text to the output stream, guarded by [`plain::printable`], and adds a line break if the
/// text does not end with one.
///
/// Colours are removed if the stream is not a terminal or the user wants none.
///
/// # Errors
/// Returns the error of the stream. A reader that is gone is no error.
pub fn out(text: &str) -> io::Result<()> {
    let stream = io::stdout();
    raw(finished(text, AutoStream::choice(&stream)).as_bytes())
}

/// Prints text to the error stream, like [`out`]. An error is dropped, because no stream is left to
/// report it on.
pub fn err(text: &str) {
    let stream = io::stderr();
    let text = finished(text, AutoStream::choice(&stream));
    let mut stream = stream.lock();
    let _ = stream.write_all(text.as_bytes()).and_then(|()| stream.flush());
}

/// Writes bytes of our own (a picture, a man page, JSON) to the output stream unchanged.
///
/// # Errors
/// Returns the error of the stream. A reader that is gone is no error.
pub fn raw(bytes: &[u8]) -> io::Result<()> {
    let mut stream = io::stdout().lock();
    match stream.write_all(bytes).and_then(|()| stream.flush()) {
        Err(why) if why.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        outcome => outcome,
    }
}

/// Returns the message of an error, followed by those of its causes, each after a colon.
///
/// The messages of some errors contain those of their causes, or are repeated at the beginning of
/// them. No words are printed twice.
pub fn chain(error: &(dyn Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut next = error.source();
    while let Some(cause) = next {
        let words = cause.to_string();
        if words.starts_with(&text) {
            text = words;
        } else if !text.contains(&words) {
            text += ": ";
            text += &words;
        }
        next = cause.source();
    }
    text
}

/// Returns the messages of errors with their causes, a paragraph each.
pub fn paragraphs<E: Error + 'static>(errors: &[E]) -> String {
    errors.iter().map(|error| chain(error)).collect::<Vec<_>>().join("\n")
}

/// Returns text as it goes to a stream. Colours are removed before the text is guarded, because
/// they could split a command.
fn finished(text: &str, colours: ColorChoice) -> String {
    let plain = match colours {
        ColorChoice::Never => plain::printable(&anstream::adapter::strip_str(text).to_string()),
        _ => plain::printable(text),
    };
    if plain.is_empty() || plain.ends_with('\n') { plain } else { plain + "\n" }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An error with a message, and perhaps with a cause.
    #[derive(Debug)]
    struct Outer {
        message: &'static str,
        cause: Option<Box<Outer>>,
    }

    impl std::fmt::Display for Outer {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str(self.message)
        }
    }

    impl Error for Outer {
        fn source(&self) -> Option<&(dyn Error + 'static)> {
            self.cause.as_deref().map(|cause| cause as &(dyn Error + 'static))
        }
    }

    #[test]
    fn a_chain_names_every_cause_once() {
        let error = |message, cause: Option<Outer>| Outer { message, cause: cause.map(Box::new) };
        let full = || error("the disk is full", None);
        assert_eq!(chain(&full()), "the disk is full");
        let written = error("cannot write it", Some(full()));
        assert_eq!(chain(&written), "cannot write it: the disk is full");
        let stated = error("cannot write it: the disk is full", Some(full()));
        let graded = error("nothing was graded", Some(stated));
        assert_eq!(chain(&graded), "nothing was graded: cannot write it: the disk is full");
        let stated = error("cannot write it: the disk is full; try again", Some(full()));
        let again = error("cannot write it", Some(stated));
        assert_eq!(chain(&again), "cannot write it: the disk is full; try again");
    }

    #[test]
    fn text_ends_its_line_and_gives_no_command() {
        let table = [
            ("", ColorChoice::Never, ""),
            ("a", ColorChoice::Never, "a\n"),
            ("a\n", ColorChoice::Never, "a\n"),
            ("\u{1b}[31ma\u{1b}[0m", ColorChoice::Never, "a\n"),
            ("\u{1b}[31ma\u{1b}[0m", ColorChoice::Always, "\u{1b}[31ma\u{1b}[0m\n"),
            ("#\u{1b}[31m#[error]", ColorChoice::Never, "\\u{23}#[error]\n"),
            ("\u{1b}[31m::error::", ColorChoice::Always, "\u{1b}[31m\\u{3a}:error::\n"),
        ];
        for (text, colours, expected) in table {
            assert_eq!(finished(text, colours), expected, "{text:?}");
        }
    }
}
