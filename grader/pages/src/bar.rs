//! Progress bars that say how long something will take only once they can know.

use std::time::Duration;

use indicatif::{ProgressState, ProgressStyle};

/// Returns a style for bars by `template`, where `{left}` stands for the time that is left.
///
/// A template that cannot be understood gives the usual bar.
pub fn style(template: &str) -> ProgressStyle {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    style.with_key("left", |state: &ProgressState, out: &mut dyn std::fmt::Write| {
        let _ = out.write_str(&left(state.pos(), state.len().unwrap_or(0), state.eta()));
    })
}

/// The time that is left, such as `, 12 s left`; empty before the first step and after the last one.
fn left(done: u64, all: u64, guess: Duration) -> String {
    match guess.as_secs() {
        _ if done == 0 || done >= all => String::new(),
        0 => ", less than 1 s left".to_owned(),
        seconds @ 1..=119 => format!(", {seconds} s left"),
        seconds => format!(", {} min left", seconds.div_ceil(60)),
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
}
