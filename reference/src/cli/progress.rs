//! Shows the progress of long work on standard error: a bar on a terminal, a line now and then
//! elsewhere.

use indicatif::{ProgressBar, ProgressDrawTarget};
use pages::bar::{self, Lines};
use pages::say;

use super::output::Talk;

/// Number of rays below which a picture is done before a bar could be read.
const LONG: u64 = 500_000;

/// A progress bar, which disappears when dropped.
pub(super) struct Bar {
    bar: ProgressBar,
    lines: Option<Lines>,
}

impl Bar {
    /// Starts a bar for a picture of `n_pixels` with `rays_each` eye rays per pixel.
    pub(super) fn rendering(n_pixels: u64, rays_each: u64, talk: Talk) -> Self {
        Self::new(
            n_pixels,
            "pixels",
            talk > Talk::Quiet && n_pixels.saturating_mul(rays_each) >= LONG,
        )
    }

    /// Starts a bar for `n` cases.
    pub(super) fn cases(n: u64, talk: Talk) -> Self {
        Self::new(n, "cases", talk > Talk::Quiet)
    }

    /// Starts a bar for a measurement whose pictures have `n` pictures' worth of rays, at one ray
    /// per pixel.
    pub(super) fn pictures(n: u64, talk: Talk) -> Self {
        Self::new(n, "pictures", talk > Talk::Quiet)
    }

    /// Starts a bar for `n` steps.
    pub(super) fn steps(n: u64, talk: Talk) -> Self {
        Self::new(n, "steps", talk > Talk::Quiet)
    }

    fn new(n: u64, unit: &'static str, is_shown: bool) -> Self {
        let target =
            if is_shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(n), target).with_message(unit);
        let bar = bar.with_style(bar::style("{bar:40} {percent}% of {len} {msg}{left}"));
        let is_log = is_shown && bar.is_hidden();
        Self { bar, lines: is_log.then(|| Lines::new(n, unit)) }
    }

    /// Advances the bar by `n`.
    pub(super) fn add(&self, n: u64) {
        self.bar.inc(n);
        if let Some(line) = self.lines.as_ref().and_then(|lines| lines.add(n)) {
            say::err(&line);
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
