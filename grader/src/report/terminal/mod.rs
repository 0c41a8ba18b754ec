//! The report for a terminal: the errors with their places and causes, then a table of stages, and
//! the next step.
//!
//! | file | holds |
//! |---|---|
//! | `groups.rs` | the checks that did not pass, grouped by cause |
//! | `checks.rs` | the lines on the groups |
//! | `table.rs` | the table, and the next step |
//! | `look.rs` | detail, width, colours, and functions that add lines |

use pages::lines::{count, folded};

use super::{mistakes, words};
use crate::plain::{printable, shown};
use crate::record::{Diagnosis, Record};

mod checks;
mod groups;
mod look;
mod table;
#[cfg(test)]
mod tests;

pub use look::Look;

use look::{BAD, BOLD, ODD, indented, line};

/// The number of lines of the compiler's errors that are shown. The first ones matter.
const MOST_ERRORS: usize = 60;

/// Returns the report as text with colours. The printing code strips them from outputs without
/// colours.
pub fn render(record: &Record, look: Look) -> String {
    let mut text = String::new();
    build(record, look, &mut text);
    checks::write(record, look, &mut text);
    if !text.is_empty() {
        text.push('\n');
    }
    if record.interrupted {
        line(
            &mut text,
            &format!(
                "{BAD}Interrupted{BAD:#}: not everything was run, so the points are not final."
            ),
        );
    }
    table::write(record, look, &mut text);
    record.diagnoses.iter().for_each(|one| diagnosis(record, one, &mut text));
    for credit in mistakes::credits(record) {
        line(&mut text, &format!("{BOLD}Counted as right{BOLD:#}  {credit}"));
    }
    if let Some(rest) = &record.unexplained {
        line(&mut text, &format!("{BOLD}Unexplained{BOLD:#}  {}", mistakes::rest(record, rest)));
    }
    table::next(record, &mut text);
    // A no-break space keeps a rule and its number on one line.
    let text = text.replace("[rule ", "[rule\u{a0}");
    printable(&folded(&text, look.columns).replace("[rule\u{a0}", "[rule "))
}

/// Writes the likely mistake, the place to look at, and the number of failures that it explains.
fn diagnosis(record: &Record, diagnosis: &Diagnosis, text: &mut String) {
    let mut lead = mistakes::lead(diagnosis.confidence);
    for mistake in &diagnosis.mistakes {
        let rule = mistakes::rule(mistake.rule);
        let number = rule.map_or(String::new(), |_| format!(" [rule {}]", mistake.rule));
        line(text, &format!("{BOLD}{lead}{BOLD:#}  {}{number}", shown(&mistake.says)));
        let place = mistakes::place(mistake).map(|place| format!("look at {place}"));
        let see = rule.map(|rule| format!("see {}", rule.link()));
        let hints: Vec<String> = place.into_iter().chain(see).collect();
        if !hints.is_empty() {
            line(text, &format!("    {}", hints.join("; ")));
        }
        lead = "or";
    }
    line(text, &format!("    It explains {}.", mistakes::extent(record, diagnosis)));
}

/// Writes the files that were left aside, the compiler's warnings, and the reason if there is no
/// program.
fn build(record: &Record, look: Look, text: &mut String) {
    for ignored in &record.build.ignored {
        line(text, &format!("{ODD}left aside{ODD:#}  {}", shown(ignored)));
    }
    let warnings = &record.build.warnings;
    if look.is_verbose {
        warnings.iter().for_each(|warning| line(text, &format!("{}\n", shown(warning))));
    } else if !warnings.is_empty() {
        let n = count(warnings.len(), "warning");
        line(text, &format!("{ODD}the compiler gives {n}{ODD:#} (-v shows them)"));
    }
    if let Some(finding) = &record.build.finding {
        line(text, &format!("{BAD}{}{BAD:#}", words::finding(finding.kind)));
        let message = shown(&finding.message);
        let most = if look.is_verbose { usize::MAX } else { MOST_ERRORS };
        indented(text, &message.lines().take(most).collect::<Vec<_>>().join("\n"));
        let n_more = message.lines().count().saturating_sub(most);
        if n_more > 0 {
            indented(text, &format!("({} (-v shows all))", count(n_more, "more line")));
        }
    }
}
