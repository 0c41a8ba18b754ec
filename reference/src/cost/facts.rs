//! The sentences of a report on what belongs to no question: trees, the start of new rays, threads.

use pages::figures::{figure, percent};

use super::report::Report;
use super::starts::StartRow;
use super::threads::{self, ThreadRow};

/// Returns the sentences on what was measured. After fewer than two rounds there are none, because
/// a single time has no spread.
pub fn of(report: &Report, starts: &[StartRow], threads: &[ThreadRow]) -> Vec<String> {
    if report.rounds < 2 {
        return Vec::new();
    }
    [trees(report), ways(starts), threads::sentence(threads)].into_iter().flatten().collect()
}

/// Returns the sentence on trees, if the scene was rendered without them.
fn trees(report: &Report) -> Option<String> {
    let own = report.row(&report.own)?;
    let row = report.effects.iter().find(|row| row.is_without_trees)?;
    let ratio = row.time_ms.median / own.time_ms.median;
    Some(if own.time_ms.is_less_than(&row.time_ms) {
        let more = if ratio < 2.0 {
            format!("{} more time", percent(ratio - 1.0))
        } else {
            format!("{} times the time", figure(ratio))
        };
        format!("Trees: without them, a render takes {more}.")
    } else if row.time_ms.is_less_than(&own.time_ms) {
        format!("Trees: without them, a render takes {} less time.", percent(1.0 - ratio))
    } else {
        "Trees: without them, a render takes as long within the spread of the times.".to_owned()
    })
}

/// Returns the sentence on the ways in which new rays leave surfaces.
fn ways(starts: &[StartRow]) -> Option<String> {
    let way = |row: &StartRow| {
        let says = row.safe_sizes();
        format!("{} ({} ms)", says.trim_end_matches('.'), figure(row.time_ms.median))
    };
    let all: Vec<String> = starts.iter().map(way).collect();
    (!all.is_empty()).then(|| {
        format!(
            "Start of new rays, with all lengths of the scene times a power of ten: {}.",
            all.join("; ")
        )
    })
}
