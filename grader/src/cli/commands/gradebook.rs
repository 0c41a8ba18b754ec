//! `grader gradebook`.

use std::collections::BTreeSet;
use std::path::Path;

use cases::files;
use cases::problem::Problems;
use pages::{lines, say};

use crate::batch::ROLL;
use crate::cli::collecting::read;
use crate::cli::exit::{Done, Outcome};
use crate::cli::gradebook::{Action, Export, Gradebook};
use crate::cli::progress::Talk;
use crate::collect::roll::{Roll, SCHEMA};
use crate::collect::table::Table;
use crate::grade::GradeError;
use crate::input;
use crate::record::Record;
use crate::report::gradebook::{self, Format};
use crate::report::gradescope;

pub(crate) fn run(arguments: &Gradebook, talk: &Talk) -> Outcome {
    match &arguments.action {
        Action::Export(export) => self::export(export, talk),
    }
}

fn export(arguments: &Export, talk: &Talk) -> Outcome {
    let Export { format, into, out, .. } = arguments;
    let usage = |text: &str| Err(GradeError::Usage(text.to_owned()));
    let notes = match (format, into) {
        (Format::Csv | Format::Gradescope, Some(_)) => {
            return usage("this format writes files of its own: leave --into out");
        }
        (Format::Canvas | Format::Moodle, None) => {
            return usage("name the file that the platform exported with --into FILE");
        }
        (Format::Gradescope, None) => vec![results(arguments)?],
        (Format::Csv, None) => {
            files::check(out)?;
            files::write(out, gradebook::plain(&roll(arguments)?).as_bytes())?;
            vec![]
        }
        (Format::Canvas | Format::Moodle, Some(into)) => {
            files::check(out)?;
            let roll = roll(arguments)?;
            let table = Table::parse(&input::shown(into), &read(into)?)?;
            let filled = gradebook::fill(&table, &roll, *format, arguments.column.as_deref())?;
            files::write(out, &filled.bytes)?;
            filled.notes
        }
    };
    if !talk.is_quiet {
        notes.iter().for_each(|note| say::err(note));
    }
    Ok(Done::Passed)
}

/// Writes the results of each submission that counts for a student, and returns their number.
fn results(arguments: &Export) -> Result<String, GradeError> {
    let roll = roll(arguments)?;
    let graded = roll.members.iter().filter(|one| one.earned.is_some());
    let ids: BTreeSet<&String> = graded.filter_map(|one| one.submission.as_ref()).collect();
    std::fs::create_dir_all(&arguments.out).map_err(|why| {
        GradeError::Usage(format!("cannot make the folder {}: {why}", arguments.out.display()))
    })?;
    for id in &ids {
        let path = arguments.results.join("records").join(format!("{id}.json"));
        let record: Record = serde_json::from_slice(&read(&path)?)
            .map_err(|why| unusable(&path, why.to_string()))?;
        let out = arguments.out.join(format!("{id}.json"));
        files::write(&out, gradescope::to_string(&record).as_bytes())?;
    }
    Ok(format!("{} written", lines::count(ids.len(), "file")))
}

/// Returns the error of a stored file that cannot be used.
fn unusable(path: &Path, why: String) -> GradeError {
    let help = "run the batch again with this grader".to_owned();
    Problems::of_file(path.display().to_string(), why, Some(help)).into()
}

/// Reads the roll that a batch stored.
fn roll(arguments: &Export) -> Result<Roll, GradeError> {
    let path = arguments.results.join(ROLL);
    if !path.is_file() {
        let text = format!(
            "{} holds no {ROLL}: run `grader batch` with --roster first",
            arguments.results.display()
        );
        return Err(GradeError::Usage(text));
    }
    let roll: Roll =
        serde_json::from_slice(&read(&path)?).map_err(|why| unusable(&path, why.to_string()))?;
    if roll.schema != SCHEMA {
        return Err(unusable(&path, format!("it has the schema {}, not {SCHEMA}", roll.schema)));
    }
    Ok(roll)
}
