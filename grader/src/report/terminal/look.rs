//! How the report looks: its detail, width and colours.

use anstyle::{AnsiColor, Style};

pub(super) const GOOD: Style = AnsiColor::Green.on_default();
pub(super) const BAD: Style = AnsiColor::Red.on_default();
pub(super) const ODD: Style = AnsiColor::Yellow.on_default();
pub(super) const BOLD: Style = Style::new().bold();

/// The amount of detail, and the width.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Adds warnings, the protection that was in force, what programs wrote on their error streams,
    /// what each check is about, and every check that did not pass.
    pub is_verbose: bool,
    /// Columns of a line.
    pub columns: usize,
}

/// Adds a line to `text`.
pub(super) fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// Adds the lines of `block` to `text`, indented.
pub(super) fn indented(text: &mut String, block: &str) {
    block.lines().for_each(|one| line(text, &format!("    {one}")));
}
