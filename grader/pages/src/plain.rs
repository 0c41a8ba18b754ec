//! Guards for text that others wrote. No guarded text moves a cursor, turns the reading direction,
//! hides a part of itself, breaks a document, or gives a command to the machine that reads the log.
//!
//! **Hidden characters** become their codes, such as `\u{202e}`. Hidden are control and format
//! characters, code points that stand for no character, private ones, and those that take no ink.
//!
//! **Commands to a log.** The runner of GitHub obeys a line that begins, after white space, with
//! `::name …::`, and `##[name …]` anywhere in a line; Azure's agent obeys `##[…]` and `##vso[…]`,
//! TeamCity obeys `##teamcity[…]`. Their first `:` or `#` becomes its code, so that the text stays
//! readable and is obeyed by none of them.

use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// Characters that [`name`] keeps.
const MAX_NAME: usize = 100;

/// Returns `text` guarded for any report; line breaks and tabs stay.
///
/// What goes into a document of another kind (HTML, XML, CSV) still has to be escaped for it.
/// Guarding twice gives the same as guarding once.
pub fn shown(text: &str) -> String {
    guarded(text, Colours::Coded)
}

/// Returns a whole output of our own, with foreign text in it, guarded for a stream.
///
/// Unlike [`shown`], this keeps the escape codes that colour text. It is the last step before the
/// stream, so that pieces which are harmless alone cannot form a command together.
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

/// Returns JSON text of the same value that is guarded as [`shown`] guards text.
///
/// In JSON, hidden characters and commands can stand in strings alone, where `\u` codes are
/// allowed.
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

/// Returns whether `c` does not show as itself: it would be invisible, change how others show, or
/// not be allowed in XML. Spaces of any width show as what they are; line breaks and tabs are
/// hidden.
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

/// Letters, marks and symbols that take no ink: fillers, joiners, selectors of a variant.
fn is_inkless(c: char) -> bool {
    matches!(c, '\u{34f}' | '\u{115f}'..='\u{1160}' | '\u{17b4}'..='\u{17b5}')
        || matches!(c, '\u{180b}'..='\u{180f}' | '\u{2800}' | '\u{3164}')
        || matches!(c, '\u{fe00}'..='\u{fe0f}' | '\u{ffa0}' | '\u{e0100}'..='\u{e01ef}')
}

/// Whether escape codes for colour may pass.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Colours {
    /// Foreign colours are coded like any control character.
    Coded,
    /// Our own colours stay.
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

/// Bytes of a colour's escape code behind its escape character: `[`, digits and semicolons, `m`.
fn colour_code(behind: &str) -> Option<usize> {
    let numbers = behind.strip_prefix('[')?;
    let end = numbers.find(|c: char| !c.is_ascii_digit() && c != ';')?;
    numbers[end..].starts_with('m').then_some(1 + end + 1)
}

/// Whether a `#` before `behind` opens a command: `##[`, `##vso[`, `##teamcity[` and the like. A
/// kept escape character does not part it, since a reader may drop that.
fn opens_command(behind: &str) -> bool {
    let is_name = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-' | '\u{1b}');
    behind.strip_prefix('#').is_some_and(|rest| rest.trim_start_matches(is_name).starts_with('['))
}

#[cfg(test)]
mod tests;
