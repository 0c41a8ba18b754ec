//! Shows progress on standard error: as a bar on a terminal, as lines elsewhere.

use std::io::IsTerminal;

use indicatif::ProgressBar;
use pages::{bar, say};

use crate::grade::Progress;

/// The amount of output that the user wants.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Talk {
    /// Whether only the requested output is printed.
    pub(crate) is_quiet: bool,
    /// Whether more than usual is printed.
    pub(crate) is_verbose: bool,
}

/// A display of progress, which disappears when it is dropped.
pub(crate) struct Bar {
    bar: ProgressBar,
    says_lines: bool,
}

impl Bar {
    pub(crate) fn new(talk: &Talk) -> Self {
        let is_terminal = std::io::stderr().is_terminal();
        let bar = if is_terminal && !talk.is_quiet {
            ProgressBar::new_spinner()
        } else {
            ProgressBar::hidden()
        };
        bar.enable_steady_tick(std::time::Duration::from_millis(100));
        Self { bar, says_lines: !is_terminal && !talk.is_quiet }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar {
    fn phase(&self, what: &str) {
        self.bar.set_message(what.to_owned());
        if self.says_lines {
            say::err(what);
        }
    }

    fn begin(&self, n_checks: u64) {
        self.bar.set_length(n_checks);
        self.bar.set_style(bar::style("{msg} [{bar:30}] {pos}/{len}{left}").progress_chars("=> "));
        self.bar.set_position(0);
    }

    fn step(&self) {
        self.bar.inc(1);
    }
}
