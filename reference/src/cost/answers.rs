//! The sentences of a report: an answer to each question, and a sentence on each part of it that
//! was measured.

use pages::figures::{figure, percent};

use super::figures::{levels, three_digits};
use super::report::{Choice, Question, QuestionRow, Report};
use super::setting::{Formula, Setting, fraction};
use crate::expect::variations::Precision;

/// Returns the answer to a question whose pick is marked, and the sentences on its parts. Without a
/// row for the scene's own setting there are none.
pub(super) fn sentences(report: &Report, question: &Question) -> (String, Vec<String>) {
    let (Some(own), Some(pick)) = (question.own(), question.pick()) else {
        return (String::new(), Vec::new());
    };
    match question.about {
        Choice::Rounding => (
            rounding(question, own, pick),
            [precision(question, own), formulas(question, own), kernels(report, own)]
                .into_iter()
                .flatten()
                .collect(),
        ),
        Choice::Depth => (depth(question, own, pick), depth_facts(report, question, own)),
        Choice::Sampling => (sampling(question, own, pick), grids(question).into_iter().collect()),
    }
}

/// Returns the fastest row that is distinctly faster than `pick`.
pub(super) fn faster<'a>(question: &'a Question, pick: &QuestionRow) -> Option<&'a QuestionRow> {
    question.rows.iter().find(|row| row.time_ms.is_less_than(&pick.time_ms))
}

/// Returns the fastest row without an error that changes a pixel.
pub(super) fn deeper(question: &Question) -> Option<&QuestionRow> {
    question.rows.iter().find(|row| row.error.changed == 0.0)
}

/// Returns the fastest row with a smaller error than the scene's own setting, except for the one
/// that errors are against.
pub(super) fn finer(question: &Question) -> Option<&QuestionRow> {
    let most = question.own()?.error.rms_levels;
    question.rows.iter().find(|row| 0.0 < row.error.rms_levels && row.error.rms_levels < most)
}

/// Returns words for the time of `row` against that of `base`, such as `takes 12.0 % longer than
/// f64 plain`.
pub(super) fn longer(row: &QuestionRow, base: &QuestionRow) -> String {
    let ratio = row.time_ms.median / base.time_ms.median;
    let than = &base.name;
    if row.time_ms.is_less_than(&base.time_ms) {
        format!("takes {} less time than {than}", percent(1.0 - ratio))
    } else if !base.time_ms.is_less_than(&row.time_ms) {
        format!("takes as long as {than} within the spread of the times")
    } else if ratio < 2.0 {
        format!("takes {} longer than {than}", percent(ratio - 1.0))
    } else {
        format!("takes {} times as long as {than}", figure(ratio))
    }
}

/// Returns words for the pixels that an error changes.
fn changes(row: &QuestionRow) -> String {
    if row.error.changed == 0.0 {
        return "changes no pixel".to_owned();
    }
    format!(
        "changes {} of the pixels, the worst by {} levels",
        percent(row.error.changed),
        figure(row.error.max_levels)
    )
}

fn rounding(question: &Question, own: &QuestionRow, pick: &QuestionRow) -> String {
    if pick.is_own {
        return match faster(question, own) {
            Some(fast) => format!(
                "Keep {}: {} {}, but {}.",
                own.name,
                fast.name,
                longer(fast, own),
                changes(fast)
            ),
            None => format!(
                "Keep {}: no other precision or formula is faster beyond the spread of the times.",
                own.name
            ),
        };
    }
    format!(
        "Pick {}: it {} and changes no pixel of this picture; {}.",
        pick.name,
        longer(pick, own),
        risk(&pick.setting)
    )
}

/// Returns the risk of a cheaper precision or formula, as a clause.
fn risk(setting: &Setting) -> &'static str {
    match setting.formula {
        Formula::Robust => "another view, or objects far away, may show its coarser rounding",
        Formula::Plain | Formula::Stable => {
            "at another scale its fixed RAY_EPSILON may let surfaces shadow themselves or skip hits"
        }
    }
}

fn precision(question: &Question, own: &QuestionRow) -> Option<String> {
    let of = |precision| {
        let setting = Setting { precision, ..own.setting };
        question.rows.iter().find(|row| row.setting == setting)
    };
    let (single, double) = (of(Precision::F32)?, of(Precision::F64)?);
    Some(format!(
        "Precision: {} {} ({} against {} ms) and {}.",
        single.name,
        longer(single, double),
        figure(single.time_ms.median),
        figure(double.time_ms.median),
        changes(single)
    ))
}

fn formulas(question: &Question, own: &QuestionRow) -> Option<String> {
    let of = |row: &&QuestionRow| row.setting.precision == own.setting.precision;
    let rows: Vec<&QuestionRow> = question.rows.iter().filter(of).collect();
    let (fastest, others) = rows.split_first()?;
    if others.is_empty() {
        return None;
    }
    let each: Vec<String> = rows
        .iter()
        .map(|row| {
            let (name, ms) = (row.setting.formula.name(), figure(row.time_ms.median));
            format!("{name} takes {ms} ms and {}", changes(row))
        })
        .collect();
    let is_first = others.iter().all(|row| fastest.time_ms.is_less_than(&row.time_ms));
    let end = if is_first {
        format!("{} is the fastest", fastest.setting.formula.name())
    } else {
        "the spreads of the fastest overlap, so none of them is named the fastest".to_owned()
    };
    Some(format!("Formulas: {}; {end}.", each.join("; ")))
}

/// Returns the sentence on the kernels in which formulas are compared.
fn kernels(report: &Report, own: &QuestionRow) -> Option<String> {
    let as_rendered = report.row(&report.own)?;
    Some(format!(
        "Kernels: formulas are compared in kernels compiled alike, for all effects and without \
         packets of rays; a render takes {} ms in the kernel for its effects, {} ms in that one.",
        figure(as_rendered.time_ms.median),
        figure(own.time_ms.median)
    ))
}

fn depth(question: &Question, own: &QuestionRow, pick: &QuestionRow) -> String {
    if !pick.is_own {
        let same = if own.error.changed == 0.0 { "the same picture" } else { "the whole picture" };
        return format!("Pick {}: it gives {same} and {}.", pick.name, longer(pick, own));
    }
    match deeper(question).filter(|_| own.error.changed > 0.0) {
        None => format!("Keep {}: more changes no pixel.", own.name),
        Some(deep) => format!(
            "{} leaves out light, which {}; {} changes none and {}.",
            capital(&own.name),
            changes(own),
            deep.name,
            longer(deep, own)
        ),
    }
}

fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

fn depth_facts(report: &Report, question: &Question, own: &QuestionRow) -> Vec<String> {
    let light = |s: &Setting| s.light_cutoff;
    let threshold = |s: &Setting| s.threshold;
    [
        depths(question, own),
        cut("Threshold", question, own, threshold),
        cut("Light cut-off", question, own, light),
        proven(report, own),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns the sentence on the least depth that is deep enough.
fn depths(question: &Question, own: &QuestionRow) -> Option<String> {
    let is_depth = |row: &&QuestionRow| {
        row.setting == Setting { max_depth: row.setting.max_depth, ..own.setting }
    };
    let mut rows: Vec<&QuestionRow> = question.rows.iter().filter(is_depth).collect();
    rows.sort_by_key(|row| row.setting.max_depth);
    let (first, last) = (rows.first()?, rows.last()?);
    if first.setting.max_depth == last.setting.max_depth {
        return None;
    }
    let enough = rows.iter().find(|row| row.error.changed == 0.0).map_or(last, |row| row);
    Some(format!(
        "Depth: {} to {} takes {} to {} ms; {} {}.",
        first.setting.max_depth,
        last.setting.max_depth,
        figure(first.time_ms.median),
        figure(last.time_ms.median),
        enough.setting.max_depth,
        if enough.error.changed == 0.0 { "is enough" } else { "is not enough" },
    ))
}

/// Returns the sentence on a cut-off: the greatest one that changes no pixel, otherwise the least
/// one. `None` if no other than the scene's own was measured.
fn cut(
    what: &str,
    question: &Question,
    own: &QuestionRow,
    of: impl Fn(&Setting) -> f64,
) -> Option<String> {
    let is_cut = |row: &&QuestionRow| {
        let s = row.setting;
        s.max_depth == own.setting.max_depth && of(&s) > of(&own.setting)
    };
    let mut rows: Vec<&QuestionRow> = question.rows.iter().filter(is_cut).collect();
    rows.sort_by(|a, b| of(&a.setting).total_cmp(&of(&b.setting)));
    let harmless = rows.iter().rev().find(|row| row.changed_from_own == 0.0);
    let row = harmless.or(rows.first())?;
    let value = fraction(of(&row.setting));
    Some(match harmless {
        Some(row) => format!("{what}: up to {value} changes no pixel and {}.", longer(row, own)),
        None => format!(
            "{what}: {value} changes {} of the pixels and {}.",
            percent(row.changed_from_own),
            longer(row, own)
        ),
    })
}

/// Returns the bound on what the scene's own setting leaves out, if it is less than the whole range
/// of a picture.
fn proven(report: &Report, own: &QuestionRow) -> Option<String> {
    let row = report.row(&own.setting)?;
    if row.rays.reflected + row.rays.refracted == 0 {
        return None;
    }
    let most = levels(row.left_out_at_most?);
    (most < levels(1.0)).then(|| {
        if most == 0.0 {
            format!("Proven: {} leaves out no light.", own.name)
        } else {
            let most = figure(most);
            format!(
                "Proven: what {} leaves out darkens no pixel by more than {most} levels.",
                own.name
            )
        }
    })
}

fn sampling(question: &Question, own: &QuestionRow, pick: &QuestionRow) -> String {
    let error = |row: &QuestionRow| figure(row.error.rms_levels);
    if !pick.is_own {
        return format!(
            "Pick {}: it {} and has an error of {} levels, not {}.",
            pick.name,
            longer(pick, own),
            error(pick),
            error(own)
        );
    }
    match finer(question) {
        None => format!("Keep {}: more rays lower the error no further.", own.name),
        Some(fine) => format!(
            "Keep {}, or lower the error from {} to {} levels: {} {}.",
            own.name,
            error(own),
            error(fine),
            fine.name,
            longer(fine, own)
        ),
    }
}

/// Returns the sentence on the settings on the front, whose error is the root mean square, and on
/// the power by which it falls. `None` for fewer than two grids with an error.
fn grids(question: &Question) -> Option<String> {
    let rows: Vec<&QuestionRow> = question
        .rows
        .iter()
        .filter(|row| row.is_on_front && three_digits(row.error.rms_levels) > 0.0)
        .collect();
    let (first, last) = (rows.first()?, rows.last()?);
    if first.setting.samples == last.setting.samples {
        return None;
    }
    let step = |row: &&QuestionRow| {
        let (error, ms) = (figure(row.error.rms_levels), figure(row.time_ms.median));
        format!("{} has {error} levels in {ms} ms", row.name)
    };
    let ln = |x: f64| cases::maths::ln(x);
    let order = ln(first.error.rms_levels / last.error.rms_levels)
        / ln(f64::from(last.setting.samples) / f64::from(first.setting.samples));
    Some(format!(
        "Samples: {} (root mean square); the error falls as the rays a side to the power −{}.",
        rows.iter().map(step).collect::<Vec<_>>().join(", "),
        figure(order)
    ))
}
