//! Arguments that several commands share: stages, a course, a size, a weight, formulas.

use std::path::PathBuf;

use clap::Parser;

use crate::rules::Formula;

/// The folder in which stages are looked up.
pub(super) const STAGES: &str = "cases/stages";

/// The rules to follow where courses differ.
#[derive(Debug, Parser)]
pub(super) struct CourseArg {
    /// The choices of the course [default: for a case the course.toml in the folder of its stages
    /// or beside it; else the lecture]
    #[arg(long, value_name = "FILE")]
    pub course: Option<PathBuf>,
}

/// Largest side of a picture in pixels.
const MAX_SIDE: u32 = 16384;

/// Parses the sides of a picture, such as `640x480`.
pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let sides =
        text.split_once(['x', '×']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match sides {
        Some((w, h)) if (1..=MAX_SIDE).contains(&w) && (1..=MAX_SIDE).contains(&h) => Ok((w, h)),
        _ => Err(format!("a size is two numbers from 1 to {MAX_SIDE}, such as 640x480")),
    }
}

/// Parses a weight from 0 to 1, as a number or a fraction such as `1/256`.
pub(super) fn threshold(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once('/') {
        Some((above, below)) => {
            number(above).zip(number(below)).map(|(above, below)| above / below)
        }
        None => number(text),
    };
    let wrong = || "this is a number from 0 to 1, such as 0.01 or 1/256".to_owned();
    value.filter(|value| (0.0..=1.0).contains(value)).ok_or_else(wrong)
}

/// Parses the name of a set of formulas.
pub(super) fn formula(text: &str) -> Result<Formula, String> {
    Formula::ALL
        .into_iter()
        .find(|f| f.name() == text)
        .ok_or_else(|| "plain, stable or robust".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_numbers_or_fractions_from_0_to_1() {
        for (text, value) in
            [("0", 0.0), ("1", 1.0), ("1/256", 1.0 / 256.0), (" 3 / 4 ", 0.75), ("1e-3", 1e-3)]
        {
            assert_eq!(threshold(text), Ok(value), "{text}");
        }
        for text in ["", "a", "-0.1", "1.5", "1/0", "0/0", "1/2/3", "nan", "inf"] {
            assert!(threshold(text).is_err(), "{text}");
        }
    }
}
