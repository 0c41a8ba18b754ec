//! The judge is judged: right programs written differently lose nothing, programs with a single bug lose points where the bug is.
//!
//! A fixed third of `tests/mutants`, every third by name; `MUTANTS=all` takes them all, and so does `cargo run -p tests --bin judge`.

use tests::bars;
use tests::lab::{Lab, cores};
use tests::variants::{self, Variant};

fn third(variants: Vec<Variant>) -> Vec<Variant> {
    match std::env::var_os("MUTANTS") {
        Some(which) if which == "all" => variants,
        _ => variants.into_iter().step_by(3).collect(),
    }
}

#[test]
fn the_judge_meets_its_bars() {
    let lab = Lab::open(None).unwrap_or_else(|why| panic!("{why}"));
    let variants = third(variants::all().unwrap_or_else(|why| panic!("{why}")));
    let trials = lab.try_all(&variants, cores(), &|_| {}).unwrap_or_else(|faults| panic!("{}", faults.join("\n")));
    let faults = bars::faults(&trials);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_edit_fits_and_every_function_has_bugs() {
    let variants = variants::all().unwrap_or_else(|why| panic!("{why}"));
    let unfit: Vec<String> = variants.iter().filter_map(|variant| variant.make().err()).collect();
    assert!(unfit.is_empty(), "{}", unfit.join("\n"));
    let n_right = variants.iter().filter(|variant| variant.is_right()).count();
    assert!(n_right >= 25, "{n_right} right ways to write it");
    assert!(variants.len() - n_right >= 120, "{} bugs", variants.len() - n_right);
}
