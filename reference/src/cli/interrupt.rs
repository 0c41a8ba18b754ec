//! Catches Ctrl-C and SIGTERM during long work. The first signal requests that the work ends, a
//! second one ends the program.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};

use super::stop::Stop;

/// Whether the user has interrupted the program.
#[derive(Clone, Debug)]
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Catches both signals from now on.
    pub(super) fn catch() -> Result<Self, Stop> {
        let is_set = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            signal_hook::flag::register_conditional_default(signal, Arc::clone(&is_set))
                .and_then(|_| signal_hook::flag::register(signal, Arc::clone(&is_set)))
                .map_err(Stop::machine("cannot wait for Ctrl-C"))?;
        }
        Ok(Self(is_set))
    }

    /// Returns whether the work shall end.
    pub(super) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
