//! Guards for text that others wrote. Guarded text cannot move a cursor, turn the reading
//! direction, hide a part of itself, break a document, or give a command to the machine that reads
//! the log.
//!
//! **Hidden characters** become their codes, such as `\u{202e}`. Control and format characters,
//! code points without a character, private ones, and characters without ink are hidden.
//!
//! **Commands to a log.** The runner of GitHub obeys a line that begins, after white space, with
//! `::name …::`, and `##[name …]` anywhere in a line; Azure's agent obeys `##[…]` and `##vso[…]`,
//! TeamCity obeys `##teamcity[…]`. Their first `:` or `#` becomes its code, so that the text stays
//! readable and is obeyed by none of them.

use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// The number of characters that [`name`] keeps.
const MAX_NAME: usize = 100;

/// Returns `text` guarded for any report. Line breaks and tabs stay.
///
/// A document of another kind (HTML, XML, CSV) still needs its own escapes. Guarding twice gives
/// the same text as guarding once.
pub fn shown(text: &str) -> String {
    guarded(text, Colours::Coded)
}

/// Returns a whole output of our own, with foreign text in it, guarded for a stream.
///
/// Unlike [`shown`], this function keeps the escape codes that colour text. It is the last step
/// before the stream, because pieces that are harmless alone could form a command together.
pub fn printable(text: &str) -> String {
    guarded(text, Colours::Kept)
}

/// Returns bytes that need not be UTF-8 as one guarded line of at most 100 characters, for names.
///
/// A longer text ends in `…`. Line breaks and tabs become spaces; a code counts as one character.
pub fn name(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes).replace(['\n', '\t'], " ");
    let short: String = text.chars().take(MAX_NAME).collect();
    let cut = if short.len() < text.len() { "…" } else { "" };
    shown(&short) + cut
}

/// Returns the text of a cell of a CSV file. A text that begins with `=`, `+`, `-`, `@`, a tab or a
/// line break gets a `'` in front.
///
/// A spreadsheet takes such a text for a formula, which could send the other cells elsewhere. The
/// quotes of CSV are left to the writer.
pub fn csv_cell(text: &str) -> String {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']);
    if is_formula { format!("'{text}") } else { text.to_owned() }
}

/// Returns JSON text of the same value, guarded as [`shown`] guards text.
///
/// In JSON, hidden characters and commands occur only within strings, where `\u` codes are allowed.
pub fn json(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for (at, c) in text.char_indices() {
        if is_hidden(c) && !matches!(c, '\n' | '\t') || c == '#' && opens_command(&text[at + 1..]) {
            let units = c
                .encode_utf16(&mut [0; 2])
                .iter()
                .map(|unit| format!("\\u{unit:04x}"))
                .collect::<String>();
            out.push_str(&units);
        } else {
            out.push(c);
        }
    }
    out
}

/// Returns whether `c` is invisible, changes how other characters look, or is not allowed in XML.
/// Spaces of any width are visible; line breaks and tabs are hidden.
pub fn is_hidden(c: char) -> bool {
    use GeneralCategory::{
        Control, Format, LineSeparator, ParagraphSeparator, PrivateUse, Surrogate, Unassigned,
    };
    if c.is_ascii() {
        return c.is_ascii_control();
    }
    let is_of_a_hidden_kind = matches!(
        c.general_category(),
        Control | Format | LineSeparator | ParagraphSeparator | PrivateUse | Surrogate | Unassigned
    );
    is_of_a_hidden_kind || is_inkless(c)
}

/// Returns whether `c` is a letter, mark or symbol without ink: a filler, a joiner or a variation
/// selector.
fn is_inkless(c: char) -> bool {
    matches!(c, '\u{34f}' | '\u{115f}'..='\u{1160}' | '\u{17b4}'..='\u{17b5}')
        || matches!(c, '\u{180b}'..='\u{180f}' | '\u{2800}' | '\u{3164}')
        || matches!(c, '\u{fe00}'..='\u{fe0f}' | '\u{ffa0}' | '\u{e0100}'..='\u{e01ef}')
}

/// The treatment of escape codes for colour.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Colours {
    /// The codes of foreign text are escaped like any control character.
    Coded,
    /// The codes of our own text stay.
    Kept,
}

fn guarded(text: &str, colours: Colours) -> String {
    let mut out = String::with_capacity(text.len());
    let mut is_line_start = true;
    let mut n_kept = 0;
    for (at, c) in text.char_indices() {
        let behind = &text[at + c.len_utf8()..];
        if n_kept > 0 {
            n_kept -= 1;
            out.push(c);
            continue;
        }
        if c == '\u{1b}'
            && colours == Colours::Kept
            && let Some(n) = colour_code(behind)
        {
            n_kept = n;
            out.push(c);
            continue;
        }
        let is_command = match c {
            ':' => is_line_start && behind.starts_with(':'),
            '#' => opens_command(behind),
            _ => false,
        };
        if is_command || is_hidden(c) && !matches!(c, '\n' | '\t') {
            out.extend(c.escape_unicode());
            is_line_start = false;
        } else {
            out.push(c);
            is_line_start = c == '\n' || is_line_start && c.is_whitespace();
        }
    }
    out
}

/// Returns the length in bytes of a colour's escape code after its escape character: `[`, digits
/// and semicolons, `m`. `None` for any other text.
fn colour_code(behind: &str) -> Option<usize> {
    let numbers = behind.strip_prefix('[')?;
    let end = numbers.find(|c: char| !c.is_ascii_digit() && c != ';')?;
    numbers[end..].starts_with('m').then_some(1 + end + 1)
}

/// Returns whether a `#` before `behind` opens a command: `##[`, `##vso[`, `##teamcity[` and so on.
/// A kept escape character within the name does not break the command, since a reader may drop that
/// character.
fn opens_command(behind: &str) -> bool {
    let is_name = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-' | '\u{1b}');
    behind.strip_prefix('#').is_some_and(|rest| rest.trim_start_matches(is_name).starts_with('['))
}

#[cfg(test)]
mod tests;
