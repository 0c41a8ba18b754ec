//! The command `reference cost --check`: reports which stored figures are stale.

use std::path::Path;

use cases::files::{ReadError, digest_in, read_text};
use cases::front::{fronts_from_str, fronts_path};

use super::cost_session::measured_on;
use super::output::print_text;
use super::stop::Stop;
use super::values::STAGES;

/// The pages with measured figures, relative to the workspace.
const PAGES: [&str; 2] = ["docs/accuracy.md", "docs/performance.md"];
/// Largest size in bytes of a file with figures.
const MAX_BYTES: u64 = 64 << 20;

/// Runs the command in the workspace that is the current folder.
pub(super) fn run() -> Result<(), Stop> {
    let Some(now) = measured_on(Path::new("."))? else {
        return Err(Stop::Usage(
            "there are no sources of the reference here\n\
                help: run this in the folder that contains reference/src"
                .to_owned(),
        ));
    };
    let mut out = String::new();
    let fronts = fronts_path(Path::new(STAGES));
    for path in PAGES.map(Path::new).into_iter().chain([fronts.as_path()]) {
        out += &match digest_of(path)? {
            Some(digest) if digest == now => format!("{}: up to date\n", path.display()),
            Some(digest) => format!(
                "{}: STALE, measured on {digest}, but the code and cases are {now}; `.ci/measure` \
                    renews it\n",
                path.display()
            ),
            None => format!(
                "{}: STALE, since it is missing or has no digest; `.ci/measure` renews it\n",
                path.display()
            ),
        };
    }
    print_text(&out)
}

/// Returns the digest of the code and cases that the figures in `path` were measured on. `None` if
/// there is none.
fn digest_of(path: &Path) -> Result<Option<String>, Stop> {
    let unusable = |why: String| Stop::Usage(format!("{}: {why}", path.display()));
    let text = match read_text(path, MAX_BYTES) {
        Ok(text) => text,
        Err(ReadError::Missing) => return Ok(None),
        Err(why) => return Err(unusable(why.to_string())),
    };
    if path.extension().is_some_and(|extension| extension == "json") {
        return Ok(fronts_from_str(&text).map_err(|why| unusable(why.to_string()))?.measured_on);
    }
    Ok(digest_in(&text).map(str::to_owned))
}
