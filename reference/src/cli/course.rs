//! `reference course`.

use cases::course;

use super::args::CourseArgs;
use super::{Stop, print};

/// Carries out the command.
pub(super) fn run(args: &CourseArgs) -> Result<(), Stop> {
    print(course::markdown(&course::load(&args.course)?).as_bytes())
}
