//! Tests that good files with random changes are read or refused, and that nothing else happens.

use std::path::Path;

use cases::scene;
use fastrand::Rng;

const SCRAPS: [&str; 16] = [
    "",
    "0",
    "-1",
    "nan",
    "inf",
    "1e999",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "= ",
    "\n",
    "é",
    "[[scene.objects]]\n",
    "group = [{}]\n",
];

/// Returns `text` with a digit changed, or with one to four stretches replaced by scraps or by
/// other stretches of itself.
fn mutated(text: &str, dice: &mut Rng) -> String {
    let mut bytes = text.as_bytes().to_vec();
    if dice.usize(..2) == 0 {
        let digits: Vec<usize> =
            (0..bytes.len()).filter(|at| bytes[*at].is_ascii_digit()).collect();
        bytes[digits[dice.usize(..digits.len())]] = b'0' + dice.usize(..10) as u8;
        return String::from_utf8_lossy(&bytes).into_owned();
    }
    for _ in 0..1 + dice.usize(..4) {
        let at = dice.usize(..bytes.len() + 1);
        let end = (at + dice.usize(..12)).min(bytes.len());
        let put = match dice.usize(..3) {
            0 => {
                let from = dice.usize(..text.len());
                &text.as_bytes()[from..(from + dice.usize(..60)).min(text.len())]
            }
            _ => SCRAPS[dice.usize(..SCRAPS.len())].as_bytes(),
        };
        bytes.splice(at..end, put.iter().copied());
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Reads 2,000 mutations. What holds for every scene must hold for those that are read. Problems
/// must say why and where a file is wrong.
fn check(text: &str, read: impl Fn(&str) -> Result<cases::Scene, cases::problem::Problems>) {
    let (mut n_read, mut n_refused) = (0, 0);
    let mut dice = Rng::with_seed(7);
    for _ in 0..2000 {
        let mutation = mutated(text, &mut dice);
        match read(&mutation) {
            Ok(scene) => {
                n_read += 1;
                scene::parse_json("again", &scene::json::to_string(&scene))
                    .unwrap_or_else(|problems| panic!("accepted, but {problems}\n{mutation}"));
            }
            Err(problems) => {
                n_refused += 1;
                assert!(problems.to_string().starts_with("error: "), "{problems}");
            }
        }
    }
    assert!(
        n_read > 50 && n_refused > 50,
        "{n_read} read, {n_refused} refused: the mutations are too wild or too tame"
    );
}

#[test]
fn mutated_scene_files_never_panic() {
    check(include_str!("good/everything.toml"), |text| {
        scene::parse("mutated", text, Path::new(""), &cases::Course::default())
    });
}

#[test]
fn mutated_json_never_panics() {
    let scene = scene::parse(
        "good",
        include_str!("good/everything.toml"),
        Path::new(""),
        &cases::Course::default(),
    )
    .unwrap();
    // Compact, so that changes hit numbers and keys rather than white space.
    let text = serde_json::to_string(&scene).unwrap();
    check(&text, |text| scene::parse_json("mutated", text));
}
