//! The look of the report: its detail, width and colours.

use anstyle::{AnsiColor, Style};

pub(super) const GOOD: Style = AnsiColor::Green.on_default();
pub(super) const BAD: Style = AnsiColor::Red.on_default();
pub(super) const ODD: Style = AnsiColor::Yellow.on_default();
pub(super) const BOLD: Style = Style::new().bold();

/// The amount of detail and the width of a report.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Adds warnings, the protection that was in force, the error streams of programs, the
    /// description of each check, and every check that did not pass.
    pub is_verbose: bool,
    /// The number of columns of a line.
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
