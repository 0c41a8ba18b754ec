//! Builds a report from the measurements of a sweep.

use cases::Scene;
use cases::front::on_front;
use pages::plain;

use super::advice;
use super::figures::three_digits;
use super::measure::Measured;
use super::report::{Choice, EffectRow, Machine, Question, QuestionRow, Report, SettingRow};
use super::setting::Setting;
use super::sweep::{About, Sweep};
use crate::rules::Rules;
use crate::trace::cutoff::Limits;

impl Report {
    /// Returns the report of `measured`, for `scene` by `rules`. `n_rounds` is the number of rounds
    /// that were requested; with fewer, the report is marked as cut short.
    pub fn new(
        name: &str,
        scene: &Scene,
        rules: &Rules,
        machine: Machine,
        sweep: &Sweep,
        measured: &[Measured],
        n_rounds: usize,
    ) -> Self {
        let rounds = measured.first().map_or(0, |row| row.times_s.len());
        let accuracy: Vec<&Measured> =
            measured.iter().filter(|one| one.about == About::Accuracy).collect();
        let limits = Limits::of(scene, rules, sweep.own.effects);
        let questions = Choice::ALL.into_iter().map(|about| question(about, sweep, &accuracy));
        let mut report = Self {
            schema: 2,
            scene: one_line(name),
            width: scene.render.width,
            height: scene.render.height,
            machine,
            rounds,
            own: sweep.own,
            is_cut_short: rounds < n_rounds,
            headline: String::new(),
            questions: questions.filter(|question| question.rows.len() > 1).collect(),
            rows: accuracy.iter().map(|one| row(one, &limits)).collect(),
            effects: effects(sweep, measured),
            facts: Vec::new(),
        };
        advice::advise(&mut report, sweep.varies_depth);
        report
    }
}

/// Returns the question, without advice. It has one row if no other setting was measured for it.
///
/// Formulas are compared in kernels that are compiled alike, the scene's own among them.
fn question(about: Choice, sweep: &Sweep, accuracy: &[&Measured]) -> Question {
    let own = Setting { alike: about == Choice::Rounding, ..sweep.own };
    let own_ms = accuracy.iter().find(|one| one.setting == own).map(|one| one.time_ms().median);
    let row = |(n, one): (usize, &&Measured)| {
        let setting = one.setting;
        let compared = match about {
            Choice::Rounding => &one.rounding,
            Choice::Depth => &one.depth,
            Choice::Sampling => &one.sampling,
        };
        let compared = compared.as_ref().filter(|_| about.only(&own, &setting) == setting)?;
        let time_ms = one.time_ms();
        Some(QuestionRow {
            name: about.name(&setting),
            setting,
            row: n,
            time_ms,
            of_own: time_ms.median / own_ms.unwrap_or(f64::NAN),
            error: compared.error,
            changed_from_own: one.error.changed,
            is_on_front: false,
            is_own: setting == own,
            is_pick: false,
            picture: compared.picture.clone(),
        })
    };
    let mut rows: Vec<QuestionRow> = accuracy.iter().enumerate().filter_map(row).collect();
    rows.sort_by(|a, b| a.time_ms.median.total_cmp(&b.time_ms.median));
    let points: Vec<(f64, f64)> =
        rows.iter().map(|row| (row.time_ms.median, three_digits(row.error.rms_levels))).collect();
    for (row, is_on_front) in rows.iter_mut().zip(on_front(&points)) {
        row.is_on_front = is_on_front;
    }
    let against: Setting = match about {
        Choice::Rounding => own.by_exact_numbers(),
        Choice::Depth => sweep.deepest,
        Choice::Sampling => sweep.truth,
    };
    Question { about, against: against.to_string(), answer: String::new(), facts: vec![], rows }
}

fn row(one: &Measured, limits: &Limits) -> SettingRow {
    SettingRow {
        name: one.setting.to_string(),
        setting: one.setting,
        time_ms: one.time_ms(),
        rays: one.stats.rays,
        bytes: one.bytes,
        left_out_at_most: limits.of_picture(&one.stats),
        rounding: one.rounding.as_ref().map(|compared| compared.error),
        depth: one.depth.as_ref().map(|compared| compared.error),
        sampling: one.sampling.as_ref().map(|compared| compared.error),
    }
}

/// Returns the rows of effects, compared with the scene's own setting.
fn effects(sweep: &Sweep, measured: &[Measured]) -> Vec<EffectRow> {
    let own = measured.iter().find(|one| one.about == About::Accuracy && one.setting == sweep.own);
    let own_ms = own.map_or(f64::NAN, |own| own.time_ms().median);
    let row = |one: &Measured| {
        let (name, without) = match one.about {
            About::Accuracy => return None,
            About::Without(effect) => (format!("without {effect}"), Some(effect)),
            About::Everything => ("with all effects".to_owned(), None),
            About::WithoutTrees => ("without trees".to_owned(), None),
        };
        let time_ms = one.time_ms();
        let more_ms = time_ms.median - own_ms;
        let is_without_trees = one.about == About::WithoutTrees;
        let (rays, error) = (one.stats.rays, one.error);
        Some(EffectRow { name, without, is_without_trees, time_ms, more_ms, rays, error })
    };
    measured.iter().filter_map(row).collect()
}

/// Returns the name of a scene as reports show it: guarded, with line breaks and tabs as codes, so
/// that no name adds a line to a report.
fn one_line(name: &str) -> String {
    plain::shown(name).replace('\n', "\\u{a}").replace('\t', "\\u{9}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_adds_no_line() {
        assert_eq!(one_line("ball.toml"), "ball.toml");
        assert_eq!(one_line("a\n## b\tc"), "a\\u{a}## b\\u{9}c");
        assert!(!one_line("a\r\u{2028}\u{202e}b").contains(['\r', '\u{2028}', '\u{202e}']));
    }
}
