//! Checks that a case can do its work. Correct tracers agree on its picture, mistakes show in it,
//! and a tracer without its stage does not produce it.

use cases::answer::{ImageAnswer, Mistake, Wrong, largest_cluster};
use cases::stage::Case;

/// The largest share of contested pixels; beyond it, too much of the picture is excused.
const MOST_CONTESTED: f64 = 0.03;
/// The largest share of the picture that a tracer without the stage may get right. Beyond it,
/// single pixels decide about the partial points. The public cases stay below 0.88.
const MOST_UNEARNED: f64 = 0.95;
/// The least size of a mistake's cluster, as a multiple of the largest cluster that passes.
const MARGIN: u32 = 2;

/// Returns the problems of the case. `wrong` holds the mistakes that are stored with its answer,
/// `mistakes` all known mistakes.
pub(super) fn problems(
    case: &Case,
    answer: &ImageAnswer,
    wrong: &[Wrong],
    mistakes: &[Mistake],
) -> Vec<String> {
    let found =
        [contested(case, answer), unearned(case, answer), blunt(case, answer, wrong, mistakes)];
    found.into_iter().flatten().collect()
}

fn unearned(case: &Case, answer: &ImageAnswer) -> Option<String> {
    let share = answer.limits.unearned;
    (share > MOST_UNEARNED).then(|| {
        let (percent, most) = (share * 100.0, MOST_UNEARNED * 100.0);
        format!(
            "{}: a tracer without this stage, or one colour, is already right on {percent:.1} % \
             of the picture, more than {most} %, so that there is nothing to give partial points \
             for (show what the stage adds larger; an effect that the programs of the course \
             simulate in every stage belongs in `always_simulated` of course.toml, not in \
             `allows` of an earlier stage)",
            case.id
        )
    })
}

fn contested(case: &Case, answer: &ImageAnswer) -> Option<String> {
    let share = answer.contested_share();
    (share > MOST_CONTESTED).then(|| {
        format!(
            "{}: correct tracers differ on {:.1} % of the pixels, more than {} % (show what grazes \
                larger, or less of it)",
            case.id,
            share * 100.0,
            MOST_CONTESTED * 100.0
        )
    })
}

/// Returns a problem if the weakest mistake in the rules that the case names does not show well
/// enough. A mistake that stays within the envelope is no mistake of this case.
fn blunt(
    case: &Case,
    answer: &ImageAnswer,
    wrong: &[Wrong],
    mistakes: &[Mistake],
) -> Option<String> {
    let rule_of =
        |id: &str| mistakes.iter().find(|mistake| mistake.id == id).map(|mistake| mistake.rule);
    let width = answer.expected.width();
    let n_pixels = answer.lo.len();
    let cluster = |wrong: &Wrong| largest_cluster(&wrong.mask(n_pixels), width);
    let targets = wrong.iter().filter_map(|wrong| Some((wrong, rule_of(&wrong.id)?)));
    let shown = targets
        .filter(|(_, rule)| case.rules.contains(rule))
        .map(|(wrong, rule)| (cluster(wrong), rule, &wrong.id));
    let (cluster, rule, id) = shown.filter(|(cluster, ..)| *cluster > 0).min()?;
    let wanted = MARGIN * answer.limits.cluster;
    (cluster < wanted).then(|| {
        format!(
            "{}: too blunt for rule {rule}: the mistake `{id}` leaves no more than {cluster} \
             wrong pixels side by side, at least {wanted} are wanted (show what it changes larger)",
            case.id
        )
    })
}

#[cfg(test)]
mod tests {
    use cases::film::Image;
    use cases::glam::DVec3;

    use super::*;

    const SIDE: usize = 10;

    fn case() -> Case {
        let stages = cases::stage::load_all(
            std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../cases/stages")),
            &cases::Course::default(),
        );
        let all = stages.expect("the public stages").into_iter().flat_map(|stage| stage.cases);
        let boxes =
            all.into_iter().find(|case| case.id.ends_with("/boxes")).expect("a case of this name");
        Case { rules: vec![5], ..boxes }
    }

    /// Returns an answer that lets clusters of 3 pass, with `n_contested` contested pixels.
    fn answer(n_contested: usize) -> ImageAnswer {
        let mut answer = ImageAnswer::exact(
            Image::from_fn(SIDE as u32, SIDE as u32, |_, _| DVec3::ZERO),
            1.0,
            3,
        );
        answer.limits.unearned = 0.2;
        answer.hi[..n_contested].fill([200; 3]);
        answer
    }

    /// Returns a mistake that changes the first `n` pixels of the first row.
    fn wrong(id: &str, n: usize) -> Wrong {
        Wrong::new(id, (0..SIDE * SIDE).map(|at| (at < n).then_some([255; 3])))
    }

    fn check(n_contested: usize, wrong: &[Wrong], expected: &[&str]) {
        let known = [("light_ignored", 5), ("other", 7)].map(|(id, rule)| Mistake {
            id: id.to_owned(),
            rule,
            says: String::new(),
            look_at: String::new(),
            field: String::new(),
        });
        compare(&problems(&case(), &answer(n_contested), wrong, &known), expected);
    }

    fn compare(found: &[String], expected: &[&str]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (problem, part) in found.iter().zip(expected) {
            assert!(
                problem.starts_with("01_ray_casting/boxes: ") && problem.contains(part),
                "{problem}"
            );
        }
    }

    #[test]
    fn a_tracer_without_the_stage_is_wrong_on_some_of_the_picture() {
        let said = "is already right on 100.0 % of the picture, more than 95 %";
        for (share, expected) in [(0.95, &[][..]), (1.0, &[said])] {
            let mut answer = answer(0);
            answer.limits.unearned = share;
            compare(&problems(&case(), &answer, &[], &[]), expected);
        }
    }

    #[test]
    fn right_tracers_agree_nearly_everywhere() {
        check(3, &[], &[]);
        check(4, &[], &["correct tracers differ on 4.0 % of the pixels, more than 3 %"]);
    }

    #[test]
    fn a_mistake_in_a_rule_of_the_case_leaves_twice_what_passes() {
        let blunt = "too blunt for rule 5: the mistake `light_ignored` leaves no more than 5 \
            wrong pixels side by side, at least 6";
        check(0, &[wrong("light_ignored", 6)], &[]);
        check(0, &[wrong("light_ignored", 5)], &[blunt]);
        check(4, &[wrong("light_ignored", 5)], &["4.0 %", blunt]);
        check(0, &[wrong("light_ignored", 0)], &[]);
        check(0, &[wrong("other", 5), wrong("unheard_of", 5)], &[]);
    }
}
