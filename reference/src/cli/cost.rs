//! The command `reference cost`: selects what is measured, and writes the files.

use std::path::Path;

use cases::files::{self, is_stdout, is_stream};

use super::args::CostArgs;
use super::cost_session::{Session, of_functions, of_scene, put};
use super::output::{Talk, print_text};
use super::stop::Stop;
use super::{cost_check, cost_page, cost_store};
use crate::cost::forms::Forms;
use crate::cost::plot::{self, Place};

/// Runs the command.
pub(super) fn run(args: &CostArgs, talk: Talk) -> Result<(), Stop> {
    let outputs = outputs(args)?;
    args.page.as_deref().map_or(Ok(()), page_fits)?;
    if args.check {
        return cost_check::run();
    }
    let session = Session::start(args.threads, talk)?;
    if let Some(path) = &args.page {
        return cost_page::run(args, path, &session);
    }
    match &args.scene {
        _ if args.store => cost_store::run(args, &session),
        None => {
            let report = of_functions(args, &session)?;
            write(&report, &outputs, talk)?;
            session.end(report.rounds, args.rounds)
        }
        Some(named) => {
            let report = of_scene(named, args, &session)?;
            write(&report, &outputs, talk)?;
            session.end(report.rounds, args.rounds)
        }
    }
}

/// A file format of a report.
#[derive(Clone, Copy, Debug)]
enum Output {
    Json,
    Csv,
    Svg,
    Html,
}

impl Output {
    fn bytes(self, report: &impl Forms) -> Result<Vec<u8>, Stop> {
        match self {
            Self::Json => {
                serde_json::to_vec_pretty(report).map_err(Stop::machine("cannot encode the report"))
            }
            Self::Csv => report.csv().map_err(Stop::machine("cannot encode the report")),
            Self::Svg => Ok(plot::stack(&report.plots(), Place::File).into_bytes()),
            Self::Html => Ok(report.page().into_bytes()),
        }
    }
}

/// Returns the requested formats and their paths. At most one of them may go to the output stream.
fn outputs(args: &CostArgs) -> Result<Vec<(Output, &Path)>, Stop> {
    let all = [
        (Output::Json, &args.json),
        (Output::Csv, &args.csv),
        (Output::Svg, &args.svg),
        (Output::Html, &args.html),
    ];
    let requested: Vec<(Output, &Path)> =
        all.into_iter().filter_map(|(what, path)| Some((what, path.as_deref()?))).collect();
    if requested.iter().filter(|(_, path)| is_stdout(path)).count() > 1 {
        return Err(Stop::Usage(
            "only one of --json, --csv, --svg and --html can go to the output stream".to_owned(),
        ));
    }
    // A measurement takes minutes: a name that cannot be written is reported before it.
    requested.iter().try_for_each(|(_, path)| files::check(path))?;
    Ok(requested)
}

/// Checks that the page is no stream, since its pictures are written beside it.
fn page_fits(path: &Path) -> Result<(), Stop> {
    if is_stream(path) {
        let text = format!("{}: the page has pictures beside it: name a file", path.display());
        return Err(Stop::Usage(text));
    }
    Ok(files::check(path)?)
}

fn write(report: &impl Forms, outputs: &[(Output, &Path)], talk: Talk) -> Result<(), Stop> {
    for (what, path) in outputs {
        put(path, &what.bytes(report)?, talk)?;
    }
    if outputs.iter().any(|(_, path)| is_stdout(path)) {
        return Ok(());
    }
    print_text(&report.text())
}
