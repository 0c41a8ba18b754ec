//! Verdicts on pictures made by hand: by clusters and counts, weights and contested pixels.

use cases::answer::Limits;

use super::*;
use crate::record::Verdict;

/// Returns a grey picture of 10 × 10 pixels with some pixels replaced.
fn grey(changes: &[(u32, u32, DVec3)]) -> Image {
    Image::from_fn(10, 10, |i, j| {
        let change = changes.iter().find(|(x, y, _)| (*x, *y) == (i, j));
        change.map_or(DVec3::splat(128.0 / 255.0), |(_, _, colour)| *colour)
    })
}

/// Returns the answer of the grey picture with these limits, where half of the points are unearned.
fn answer(cluster: u32, count: u32) -> ImageAnswer {
    let exact = ImageAnswer::exact(grey(&[]), 2.0, 0);
    ImageAnswer { limits: Limits { cluster, count, unearned: 0.5, ..exact.limits }, ..exact }
}

/// Returns black pixels where the rows of text have a `#`.
fn black(rows: &[&str]) -> Vec<(u32, u32, DVec3)> {
    let row = |(y, row): (usize, &&str)| {
        let at = row
            .chars()
            .enumerate()
            .filter(|(_, c)| *c == '#')
            .map(|(x, _)| x as u32)
            .collect::<Vec<u32>>();
        at.into_iter().map(move |x| (x, y as u32, DVec3::ZERO))
    };
    rows.iter().enumerate().flat_map(row).collect()
}

/// Judges the grey picture with these changes, and checks the verdict, the share, and the message.
fn check(
    changes: &[(u32, u32, DVec3)],
    answer: &ImageAnswer,
    expected: (Verdict, u32, Option<&str>),
) {
    let judgement = picture(&grey(changes), answer);
    let message = judgement.finding.as_ref().map(|finding| finding.message.as_str());
    assert_eq!((judgement.verdict, judgement.share, message), expected, "{changes:?}");
    let share = judgement.finding.as_ref().and_then(|finding| finding.share).unwrap_or(0);
    assert_eq!(share, judgement.share, "the finding says what the judgement says");
}

const RIGHT: (Verdict, u32, Option<&str>) = (Verdict::Pass, 0, None);

#[test]
fn a_pixel_is_out_beyond_the_slack_only() {
    let off = |levels: f64| vec![(1, 2, DVec3::new(128.0, 128.0 + levels, 128.0) / 255.0)];
    check(&off(1.99), &answer(0, 0), RIGHT);
    let message = "1 pixel of 100 differs (columns 1 to 1, rows 2 to 2), most at (1, 2): \
                   yours 128 130 128, expected 128 128 128";
    check(&off(2.01), &answer(0, 0), (Verdict::Partial, 900, Some(message)));
    check(&off(90.0), &answer(1, 1), RIGHT);
}

#[test]
fn both_the_largest_cluster_and_the_count_are_limited() {
    let apart = black(&["#.#.#.#", "", "#.#.#.#"]);
    let touching = black(&["##..", "..#.", "...#"]);
    check(&apart, &answer(1, 8), RIGHT);
    let message = "8 pixels of 100 differ (columns 0 to 6, rows 0 to 2), most at (0, 0): \
                   yours 0 0 0, expected 128 128 128";
    check(&apart, &answer(1, 7), (Verdict::Partial, 840, Some(message)));
    check(&touching, &answer(4, 8), RIGHT);
    let message = "4 pixels of 100 differ, 4 of them side by side (columns 0 to 3, rows 0 to 2), \
        most at (0, 0): \
                   yours 0 0 0, expected 128 128 128";
    check(&touching, &answer(3, 8), (Verdict::Partial, 900, Some(message)));
}

#[test]
fn a_part_of_the_points_is_earned_by_weight() {
    let mut heavy = answer(0, 0);
    heavy.weight = (0..100).map(|n| if n < 10 { 200 } else { 0 }).collect();
    let message = "9 pixels of 100 differ, 5 of them side by side (columns 0 to 4, rows 0 to 9), \
        most at (0, 0): \
                   yours 0 0 0, expected 128 128 128";
    let four = [(0, 9), (1, 9), (2, 9), (3, 9)].map(|(x, y)| (x, y, DVec3::ZERO));
    let changes = [black(&["#####"]), four.to_vec()].concat();
    let message_of = |share: u32| {
        (if share > 0 { Verdict::Partial } else { Verdict::Fail }, share, Some(message))
    };
    check(&changes, &heavy, message_of(0));
    heavy.limits.unearned = 0.2;
    check(&changes, &heavy, message_of(375));
    heavy.limits.unearned = 1.0;
    check(&changes, &heavy, message_of(0));
}

#[test]
fn what_is_not_finite_is_out_even_where_clamping_would_hide_it() {
    let white = ImageAnswer::exact(Image::from_fn(10, 10, |_, _| DVec3::ONE), 2.0, 99);
    let infinite = Image::from_fn(10, 10, |_, _| DVec3::INFINITY);
    assert_eq!(picture(&infinite, &white).verdict, Verdict::Fail);
    let bright = Image::from_fn(10, 10, |_, _| DVec3::splat(7.0));
    assert_eq!(picture(&bright, &white), Judgement::PASS);
    let message = "2 pixels of 100 differ (columns 0 to 9, rows 0 to 9), most at (0, 0): \
                   yours NaN NaN NaN, expected 128 128 128";
    let changes = [(0, 0, DVec3::NAN), (9, 9, DVec3::ZERO)];
    check(&changes, &answer(0, 0), (Verdict::Partial, 900, Some(message)));
}

#[test]
fn a_picture_of_one_colour_earns_nothing_and_is_called_so() {
    let all = black(&["##########"; 10]);
    let message = "100 pixels of 100 differ, most at (0, 0): yours 0 0 0, expected 128 128 128; \
                   yours is one colour all over, which earns nothing";
    check(&all, &answer(3, 3), (Verdict::Fail, 0, Some(message)));
    let mut nearly = answer(0, 0);
    nearly.expected = grey(&[(5, 5, DVec3::ZERO)]);
    (nearly.lo[55], nearly.hi[55]) = ([0; 3], [0; 3]);
    let message = "1 pixel of 100 differs (columns 5 to 5, rows 5 to 5), most at (5, 5): yours \
        128 128 128, expected 0 0 0; \
                   yours is one colour all over, which earns nothing";
    check(&[], &nearly, (Verdict::Fail, 0, Some(message)));
    check(&[], &answer(0, 0), RIGHT);
}

/// Returns an answer in which the first row may be anything from 31 to 212.
fn contested() -> ImageAnswer {
    let mut answer = answer(1, 1);
    for n in 0..10 {
        (answer.lo[n], answer.hi[n]) = ([31; 3], [212; 3]);
    }
    answer
}

#[test]
fn what_differs_on_contested_pixels_only_is_for_a_person_to_look_at() {
    let message = "3 pixels of 100 differ, 2 of them side by side (columns 0 to 3, rows 0 to 0), \
        most at (0, 0): \
                   yours 0 0 0, expected 128 128 128, allowed 31 31 31 to 212 212 212; but \
                   correct tracers differ on all of these pixels (and on 10.0 % of the picture), \
                   so it counts as right, and a person should look at it";
    check(&black(&["##.#"]), &contested(), (Verdict::Pass, 0, Some(message)));
    let judgement = picture(&grey(&black(&["##.#"])), &contested());
    let finding = judgement.finding.unwrap();
    let numbers =
        (finding.kind, finding.wrong_pixels, finding.wrong_contested, finding.largest_cluster);
    assert_eq!(numbers, (FindingKind::Contested, Some(3), Some(3), Some(2)));
}

#[test]
fn one_pixel_more_is_no_longer_excused() {
    let message = "4 pixels of 100 differ, 3 of them side by side (columns 0 to 3, rows 0 to 1), \
        most at (1, 1): \
                   yours 0 0 0, expected 128 128 128; on 3 of them correct tracers differ too (on \
                   10.0 % of the picture)";
    check(&black(&["##.#", ".#"]), &contested(), (Verdict::Partial, 900, Some(message)));
}

#[test]
fn rasters_differ_as_pictures_do() {
    let light = |i: u32, j: u32| DVec3::splat(f64::from(i + 8 * j) / 255.0);
    let levels = |image: &Image| {
        let channels = image.pixels().iter().flat_map(|pixel| pixel.to_array());
        channels.map(byte).collect::<Vec<u8>>()
    };
    let one = Image::from_fn(8, 6, light);
    let step = |i: u32, j: u32| DVec3::Y * [0.0, 1.0, 2.0, 5.0][(i * j % 4) as usize] / 255.0;
    let other = Image::from_fn(8, 6, |i, j| light(i, j) + step(i, j));
    for slack in [0.5, 1.5, 2.5, 4.5, 5.5] {
        let expected = compare(&other, &ImageAnswer::exact(one.clone(), slack, 0));
        let mut compared = RowsCompared::new(8, slack);
        let (yours, right) = (levels(&other), levels(&one));
        compared.take(&yours[..48], &right[..48]);
        compared.take(&yours[48..], &right[48..]);
        let found = compared.finish();
        assert_eq!(found.difference, expected, "slack {slack}");
        let most = expected.worst.map_or(0.0, |_| 5.0);
        assert_eq!((found.by, found.n_not_finite), (most, 0), "slack {slack}");
    }
}

#[test]
fn what_rasters_differ_by_is_said_with_the_digits_that_tell_something() {
    let mut compared = RowsCompared::new(3, 0.0);
    compared.take_words(
        &[257.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1e12],
        &[258.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    let message = "2 pixels of 3 differ (columns 0 to 2, rows 0 to 0), most at (2, 0) by 3.89e9 \
        levels: \
                   first 0 0 -3.89e9, second 0 0 0";
    assert_eq!(compared.finish().text, message);
    let mut compared = RowsCompared::new(1, 0.0);
    compared.take_words(&[257.0, 128.5, 0.0], &[258.0, 128.5, 0.0]);
    let message =
        "1 pixel of 1 differs, most at (0, 0) by 3.89e-3 levels: first 1 0.5 0, second 1.004 0.5 0";
    assert_eq!(compared.finish().text, message);
    let mut compared = RowsCompared::new(1, 255.0);
    compared.take_words(&[f64::NAN, 0.0, f64::INFINITY], &[f64::NAN, 0.0, f64::INFINITY]);
    let message = "1 pixel of 1 differs, most at (0, 0): first NaN 0 inf, second NaN 0 inf; \
                   1 of them hold NaN or infinity, which differ from everything";
    assert_eq!(compared.finish().text, message);
}
