//! Progress bars that show the remaining time once it can be estimated, and progress lines for
//! outputs that cannot show a bar.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressState, ProgressStyle};

/// Returns the style of a bar from `template`, in which `{left}` is the remaining time.
///
/// An invalid template gives the default bar.
pub fn style(template: &str) -> ProgressStyle {
    let style =
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    style.with_key("left", |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        let _ = out.write_str(&left(state.pos(), state.len().unwrap_or(0), state.eta()));
    })
}

/// Returns the remaining time from the estimate `guess`, such as `, 12 s left`. The text is empty
/// before the first step and after the last one.
pub fn left(done: u64, all: u64, guess: Duration) -> String {
    match guess.as_secs() {
        _ if done == 0 || done >= all => String::new(),
        0 => ", less than 1 s left".to_owned(),
        seconds @ 1..=119 => format!(", {seconds} s left"),
        seconds => format!(", {} min left", seconds.div_ceil(60)),
    }
}

/// The progress of long work as lines for a log.
#[derive(Debug)]
pub struct Lines {
    n: u64,
    unit: &'static str,
    start: Instant,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    done: u64,
    next: Instant,
}

impl Lines {
    /// The least time between two lines.
    const EVERY: Duration = Duration::from_secs(15);

    /// Starts work of `n` steps. A line calls the steps `unit`.
    pub fn new(n: u64, unit: &'static str) -> Self {
        let start = Instant::now();
        Self { n, unit, start, state: Mutex::new(State { done: 0, next: start + Self::EVERY }) }
    }

    /// Adds `n` steps and returns a line if one is due, 15 s after the last one. No line is due
    /// once all steps are done.
    pub fn add(&self, n: u64) -> Option<String> {
        self.add_at(n, Instant::now())
    }

    fn add_at(&self, n: u64, now: Instant) -> Option<String> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.done += n;
        if now < state.next || state.done >= self.n {
            return None;
        }
        state.next = now + Self::EVERY;
        let share_left = (self.n - state.done) as f64 / state.done.max(1) as f64;
        let guess = Duration::try_from_secs_f64((now - self.start).as_secs_f64() * share_left);
        Some(format!(
            "{} of {} {}{}",
            state.done,
            self.n,
            self.unit,
            left(state.done, self.n, guess.unwrap_or_default())
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_said_of_the_time_before_the_first_step() {
        let table = [
            (0, 57, 0, ""),
            (0, 57, 90, ""),
            (1, 57, 0, ", less than 1 s left"),
            (1, 57, 12, ", 12 s left"),
            (1, 57, 121, ", 3 min left"),
            (57, 57, 3, ""),
        ];
        for (done, all, seconds, expected) in table {
            assert_eq!(left(done, all, Duration::from_secs(seconds)), expected, "{done} of {all}");
        }
    }

    #[test]
    fn a_log_gets_a_line_now_and_then() {
        let lines = Lines::new(100, "answers");
        let after = |seconds| lines.start + Duration::from_secs(seconds);
        assert_eq!(lines.add_at(10, after(10)), None, "too early");
        assert_eq!(lines.add_at(10, after(20)).as_deref(), Some("20 of 100 answers, 80 s left"));
        assert_eq!(lines.add_at(20, after(30)), None, "there was a line 10 s ago");
        assert_eq!(lines.add_at(10, after(40)).as_deref(), Some("50 of 100 answers, 40 s left"));
        assert_eq!(lines.add_at(50, after(90)), None, "all is done");
    }
}
