//! Advice on which setting to pick: one for each question, and a headline for all of them.

use pages::figures::{figure, percent};

use super::answers::{self, deeper, faster, finer};
use super::report::{Choice, Question, QuestionRow, Report};
use crate::expect::variations::Precision;

/// Marks the pick of each question, and writes its sentences and the headline. If `varies_depth` is
/// set, another depth or cut-off than the scene's own may be picked.
///
/// After fewer than two rounds, nothing is picked: a single time has no spread.
pub(super) fn advise(report: &mut Report, varies_depth: bool) {
    if report.rounds < 2 {
        report.headline =
            "Figures without advice: the times of one round have no spread.".to_owned();
        return;
    }
    for n in 0..report.questions.len() {
        if let Some(at) = pick(&report.questions[n], varies_depth) {
            report.questions[n].rows[at].is_pick = true;
        }
        let (answer, facts) = answers::sentences(report, &report.questions[n]);
        (report.questions[n].answer, report.questions[n].facts) = (answer, facts);
    }
    report.headline = headline(report);
}

/// Returns the index of the row to pick. It is never slower than the scene's own setting, unless
/// the latter has an error and another depth may be picked.
fn pick(question: &Question, varies_depth: bool) -> Option<usize> {
    let own = question.own()?;
    let distance = |row: &QuestionRow| row.setting.max_depth.abs_diff(own.setting.max_depth);
    match question.about {
        Choice::Rounding => best(
            question,
            |row| row.error.changed == 0.0,
            |row| {
                let rank = row.setting.formula as i32 * 2;
                f64::from(rank + i32::from(row.setting.precision == Precision::F64))
            },
        ),
        Choice::Depth if varies_depth => best(
            question,
            |row| row.error.changed == 0.0,
            |row| -f64::from(distance(row)) - row.setting.threshold - row.setting.light_cutoff,
        ),
        Choice::Depth => question.rows.iter().position(|row| row.is_own),
        Choice::Sampling => best(
            question,
            |row| row.error.rms_levels <= own.error.rms_levels,
            |row| -row.error.rms_levels,
        ),
    }
}

/// Returns the index of the fastest row that is good and distinctly faster than the scene's own
/// setting, if the latter is good as well. Of the rows that are not distinctly slower than the
/// fastest, the one with the greatest rank counts. Without such a row, the result is the scene's
/// own setting.
fn best(
    question: &Question,
    is_good: impl Fn(&QuestionRow) -> bool,
    rank: impl Fn(&QuestionRow) -> f64,
) -> Option<usize> {
    let own = question.own()?;
    let candidates = || {
        question.rows.iter().enumerate().filter(|(_, row)| {
            is_good(row) && (!is_good(own) || row.time_ms.is_less_than(&own.time_ms))
        })
    };
    // The rows are sorted by time.
    let Some((_, fastest)) = candidates().next() else {
        return question.rows.iter().position(|row| row.is_own);
    };
    candidates()
        .filter(|(_, row)| !fastest.time_ms.is_less_than(&row.time_ms))
        .max_by(|(_, a), (_, b)| rank(a).total_cmp(&rank(b)))
        .map(|(at, _)| at)
}

/// Returns what accuracy costs and which setting to pick, in one sentence.
fn headline(report: &Report) -> String {
    let picks = report.questions.iter().filter_map(|question| {
        let pick = question.pick()?;
        Some((question.about, pick.setting))
    });
    let all = picks.fold(report.own, |all, (about, pick)| about.only(&all, &pick));
    let (free, priced): (Vec<_>, Vec<_>) =
        report.questions.iter().filter_map(price).partition(|(_, price)| price.is_none());
    let free: Vec<String> = free.into_iter().map(|(name, _)| name).collect();
    let free = match free.len() {
        0 => None,
        1 => Some(format!("{} costs no measurable time", free[0])),
        _ => Some(format!("{} cost no measurable time", free.join(" and "))),
    };
    let priced = priced.into_iter().filter_map(|(name, price)| Some(format!("{name} {}", price?)));
    let clauses: Vec<String> = free.into_iter().chain(priced).collect();
    let advice = if all == report.own {
        format!("Keep the scene as it stands ({all})")
    } else {
        format!("Pick {all}")
    };
    if clauses.is_empty() {
        return format!("{advice}.");
    }
    format!("{advice}: {}.", clauses.join(", "))
}

/// Returns what more accuracy in one question is called, and its price in words, or `None` instead
/// of a price that the spread of the times hides. `None` if more accuracy was not measured.
fn price(question: &Question) -> Option<(String, Option<String>)> {
    let (own, pick) = (question.own()?, question.pick()?);
    if !pick.is_own && pick.time_ms.is_less_than(&own.time_ms) {
        let share = percent(pick.of_own);
        let gain = match question.about {
            Choice::Rounding => "gives the same picture at this scale",
            Choice::Depth => "gives the same picture",
            Choice::Sampling => "has no greater error",
        };
        return Some((pick.name.clone(), Some(format!("{gain} in {share} of the time"))));
    }
    let (name, more, base) = match question.about {
        Choice::Rounding => {
            let base = faster(question, pick);
            ("exact rounding".to_owned(), pick, base.unwrap_or(pick))
        }
        Choice::Depth if own.error.changed == 0.0 => return None,
        Choice::Depth => deeper(question).map(|deep| (deep.name.clone(), deep, own))?,
        Choice::Sampling => {
            finer(question).map(|fine| (format!("sampling at {}", fine.name), fine, own))?
        }
    };
    if !base.time_ms.is_less_than(&more.time_ms) {
        return Some((name, None));
    }
    let ratio = more.time_ms.median / base.time_ms.median;
    let price = if ratio < 2.0 {
        format!("costs {} more time", percent(ratio - 1.0))
    } else {
        format!("costs {} times the time", figure(ratio))
    };
    Some((name, Some(price)))
}

#[cfg(test)]
mod tests;
