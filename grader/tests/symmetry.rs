//! Checks that two pictures in any pair of formats give the same figures in either order.

#[path = "shared/forms.rs"]
mod forms;

use std::io::Cursor;

use cases::film::{Image, Quantiser, Rows, WORDS_IN_BYTE, byte};
use cases::glam::DVec3;
use fastrand::Rng;
use forms::Form;
use grader::judge::{Comparison, RowsCompared};

const FORMS: [Form; 5] = [Form::Png, Form::DeepPng, Form::Pfm, Form::Exr, Form::HalfExr];

/// Returns the 16-bit levels that a file of this format stores for `light`, or `None` for half
/// floats, which have no simple formula.
fn words(form: Form, light: f64) -> Option<f64> {
    match form {
        Form::Png => Some(f64::from(byte(light)) * WORDS_IN_BYTE),
        Form::DeepPng => Some(f64::from(Quantiser::Rounding.word(light))),
        Form::Pfm | Form::Exr => Some(f64::from(light as f32) * f64::from(u16::MAX)),
        Form::HalfExr => None,
    }
}

fn compare(one: &[u8], other: &[u8], slack: f64) -> Comparison {
    let [mut one, mut other] = [one, other].map(|bytes| Rows::open(Cursor::new(bytes)).unwrap());
    let (width, height) = one.size();
    let n = (width * height * 3) as usize;
    let mut compared = RowsCompared::new(width, slack);
    if one.has_bytes() && other.has_bytes() {
        let (mut a, mut b) = (vec![0; n], vec![0; n]);
        one.bytes(&mut a).and_then(|()| other.bytes(&mut b)).unwrap();
        compared.take(&a, &b);
    } else {
        let (mut a, mut b) = (vec![0.0; n], vec![0.0; n]);
        one.words(&mut a).and_then(|()| other.words(&mut b)).unwrap();
        compared.take_words(&a, &b);
    }
    compared.finish()
}

/// Returns light that is hard to compare: on a level or between two, out of bounds, or not finite.
fn light(dice: &mut Rng) -> f64 {
    match dice.usize(..12) {
        0..=3 => f64::from(dice.u8(..)) / 255.0,
        4..=6 => f64::from(dice.u16(..)) / 65535.0,
        7 => (f64::from(dice.u8(..)) + 0.5) / 255.0,
        8 => -(dice.usize(..3) as f64) / 2.0,
        9 => 1.0 + dice.usize(..9) as f64,
        10 => dice.usize(..1 << 24) as f64 / f64::from(1 << 24),
        _ => [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 1e30][dice.usize(..5)],
    }
}

/// Makes two pictures of the same size that differ in some pixels.
fn pair(dice: &mut Rng) -> [Image; 2] {
    let (width, height) = (1 + dice.usize(..7) as u32, 1 + dice.usize(..5) as u32);
    let one =
        Image::from_fn(width, height, |_, _| DVec3::from_array([(); 3].map(|()| light(dice))));
    let other = Image::from_fn(width, height, |i, j| match dice.usize(..3) {
        0 => DVec3::from_array([(); 3].map(|()| light(dice))),
        1 => one.pixel(i, j) + DVec3::Y * dice.usize(..4) as f64 / 255.0,
        _ => one.pixel(i, j),
    });
    [one, other]
}

#[test]
fn it_makes_no_difference_which_picture_comes_first() {
    let mut dice = Rng::with_seed(3);
    let (mut n_agree, mut n_differ) = (0, 0);
    for _ in 0..200 {
        let images = pair(&mut dice);
        let slack = [0.0, 0.5, 1.0, 3.0, 3.25, 254.0][dice.usize(..6)];
        for a in FORMS {
            for b in FORMS {
                let [one, other] = [a.bytes(&images[0]), b.bytes(&images[1])];
                let (there, back) = (compare(&one, &other, slack), compare(&other, &one, slack));
                let figures = |one: &Comparison| (one.difference.clone(), one.by, one.n_not_finite);
                assert_eq!(figures(&there), figures(&back), "{a:?} and {b:?}, slack {slack}");
                let roles = there
                    .text
                    .replace("first", "third")
                    .replace("second", "first")
                    .replace("third", "second");
                assert_eq!(swapped(&roles), back.text);
                let found = there.difference.n_out;
                if let Some(expected) = n_out(&images, [a, b], slack) {
                    assert_eq!(found, expected, "{a:?} and {b:?}, slack {slack}: {}", there.text);
                }
                (n_agree, n_differ) =
                    (n_agree + u32::from(found == 0), n_differ + u32::from(found > 0));
            }
        }
    }
    assert!(n_agree > 50 && n_differ > 1000, "{n_agree} agree, {n_differ} differ");
}

/// Returns the text with the part "first …" in front of the part "second …".
fn swapped(text: &str) -> String {
    let Some((before, rest)) = text.split_once(": second ") else { return text.to_owned() };
    let (second, rest) = rest.split_once(", first ").unwrap();
    let (first, after) = rest
        .split_once(';')
        .map_or((rest, String::new()), |(first, after)| (first, format!(";{after}")));
    format!("{before}: first {first}, second {second}{after}")
}

/// Counts the pixels that are out, from the light that the files store. Returns `None` for half
/// floats.
fn n_out(images: &[Image; 2], forms: [Form; 2], slack: f64) -> Option<u32> {
    let mut n = 0;
    for (one, other) in images[0].pixels().iter().zip(images[1].pixels()) {
        let mut is_out = false;
        for at in 0..3 {
            let (a, b) = (words(forms[0], one[at])?, words(forms[1], other[at])?);
            let is_in = a.is_finite() && b.is_finite() && (a - b).abs() <= slack * WORDS_IN_BYTE;
            is_out |= !is_in;
        }
        n += u32::from(is_out);
    }
    Some(n)
}

#[test]
fn bytes_are_compared_as_words_are() {
    let mut dice = Rng::with_seed(4);
    for _ in 0..500 {
        let (n, slack) = (3 * 5 * 4, dice.usize(..5) as f64 / 2.0);
        let one: Vec<u8> = (0..n).map(|_| dice.u8(..)).collect();
        let other: Vec<u8> =
            one.iter().map(|level| level.saturating_add(dice.usize(..4) as u8 / 2)).collect();
        let words = |bytes: &[u8]| {
            bytes.iter().map(|level| f64::from(*level) * WORDS_IN_BYTE).collect::<Vec<f64>>()
        };
        let (mut by_bytes, mut by_words) =
            (RowsCompared::new(5, slack), RowsCompared::new(5, slack));
        by_bytes.take(&one, &other);
        by_words.take_words(&words(&one), &words(&other));
        assert_eq!(by_bytes.finish(), by_words.finish());
    }
}
